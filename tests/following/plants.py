"""Plants whose true values are known, with followers of their readings."""

from functools import cache

import numpy as np

import planetary_twin_py as pt
from planetary_twin_py.following.balance.follower import BalanceFollower
from planetary_twin_py.following.loss_map import loss_map
from planetary_twin_py.following.teeth.follower import TeethFollower
from planetary_twin_py.plant.hidden import Hidden
from planetary_twin_py.plant.readings import Plant, simulate_readings
from planetary_twin_py.plant.sampled import simulate_samples

RATE, COUNTS = 20_000.0, 2**20
LAWS = {  # of plants; the follower has the first
    "the same": {},
    "another film": {"lubrication.film": "dowson_toyoda"},
    "another friction": {
        "lubrication.boundary": "greenwood_tripp", "lubrication.lambda_ratio": "prescribed",
    },
    "with bearings": {"losses.planet_bearing": {"mean_diameter": 0.012}},
}  # fmt: skip
TEETH_LAWS = {
    "the same": {},
    "viscous damping": {"mesh.damping.law": "viscous", "mesh.damping.damping_ratio": 0.07},
    "involute": {"mesh.stiffness": "involute"},
    "another friction": {
        "lubrication.boundary": "load_sharing", "lubrication.lambda_ratio": "computed",
    },
    "runout": {"mesh.runout": {"sun": 5e-6, "planet": 3e-6, "ring": 5e-6}, "backlash": 2e-5},
}  # fmt: skip


@cache
def paper():
    """Scene `paper` with the friction laws of the follower."""
    laws = {"lubrication.boundary": "load_sharing", "lubrication.lambda_ratio": "computed"}
    return pt.load_scene("paper").replace(**laws)


def torque_errors(seed, noise=1.0):
    """Errors of both torque sensors, class 0.1 with 100 and 250 N m."""
    chance = np.random.default_rng([seed, 17])
    sensors = {}
    for name, full in (("input_torque", 100.0), ("output_torque", 250.0)):
        zero, gain = chance.standard_normal(2)
        sensors[name] = {
            "noise": noise * 1e-3 * full, "zero": 5e-4 * full * zero, "gain": 1e-3 * gain,
        }  # fmt: skip
    return sensors | {"speed_noise": 0.02}


def played(kind, laws, duration, seed=0, changes=(), sensors=None):
    """Plant and readings of a duty."""
    sensors = torque_errors(seed) | (sensors or {})
    hidden = Hidden.model_validate(
        {"scene": laws, "duty": {"kind": kind}, "sensors": sensors, "changes": changes,
         "seed": seed}
    )  # fmt: skip
    plant = Plant(paper(), hidden, duration)
    return plant, *simulate_readings(plant)


def balance_of(kind, laws, duration, seed=0, changes=()):
    """Plant and follower of its torque balance."""
    plant, time, columns = played(kind, laws, duration, seed, changes)
    follower = BalanceFollower(paper())
    follower.add(time, columns)
    return plant, follower


def friction_level(plant):
    """True friction level of a plant before any change: its loss over that of the scene."""
    scene = paper()
    point = scene.operating_point
    at = point.input_torque, point.input_speed, point.oil_temperature
    true, nominal = loss_map(plant.true_scene)(*at), loss_map(scene)(*at)
    return (true.teeth + true.rest - nominal.rest) / nominal.teeth


def hunted(laws, changes, duration, seed=0, encoders=None, wander=0.02):
    """Play a plant with encoders: yields it and its follower after every hunting period."""
    hidden = Hidden.model_validate(
        {"scene": laws, "duty": {"torque_wander": wander}, "changes": changes, "seed": seed,
         "sensors": {"encoders": {"rate": RATE, "lost": 0.003} | (encoders or {})}}
    )  # fmt: skip
    plant = Plant(pt.load_scene("paper"), hidden, duration)
    follower = TeethFollower(plant.scene, (COUNTS, COUNTS), 1.0 / RATE)
    noise = np.random.default_rng([seed, 5])

    def torque(begin, end):
        """Mean of 84 readings with 0.1 N m of noise."""
        true = plant.course.torque_at(np.linspace(begin, end, 50)).mean()
        return float(true) + 0.011 * noise.standard_normal()

    for packets in simulate_samples(plant, "encoders"):
        follower.add(packets.sample, packets.values)
        blocks = follower.blocks
        follower.judge(np.inf, torque)
        if follower.blocks != blocks:
            yield plant, follower
    follower.finish()
    follower.judge(np.inf, torque)
    yield plant, follower


def toothed(laws, changes, duration, seed=0, encoders=None, wander=0.02):
    """Plant with encoders, and follower of its teeth at the end of the run."""
    *_, last = hunted(laws, changes, duration, seed, encoders, wander)
    return last


def crack(gear, tooth, loss, **more):
    """A cracked tooth as a scene has it."""
    return {"kind": "crack", "gear": gear, "tooth": tooth, "stiffness_loss": loss, **more}
