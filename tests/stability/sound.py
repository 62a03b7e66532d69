"""What every hard case must be: finite, dissipative, closed in energy, and worth its steps."""

import numpy as np

import planetary_twin_py as pt

PAPER = pt.load_scene("paper")
# One stiffness whatever is in contact, nothing but springs: statics are known in closed form.
UNIFORM = PAPER.replace(
    **{"mesh.double_pair_ratio": 1.0, "mesh.ramp": 0.0, "mesh.damping.law": "viscous"}
)
PLAIN = UNIFORM.replace(**{"lubrication.friction": False})
LEAST = 1e-30  # [J]
LAWS = ("viscous", "natural_frequency", "meshing_frequency", "printed_meshing_frequency")


def base_radius(scene, teeth):
    """Of a gear [m]."""
    gears = scene.gearset
    return 0.5 * gears.module * teeth * np.cos(gears.pressure_angle)


def static_force(scene):
    """That every mesh of the scene `paper` carries [N]: the torque at the sun, on all planets."""
    radius = base_radius(scene, scene.gearset.teeth.sun)
    return scene.operating_point.input_torque / (radius * scene.gearset.planets)


def static_torsion(scene):
    """Angle by which the motor's torque winds up its shaft [rad]."""
    return scene.operating_point.input_torque / scene.drive.input.coupling_stiffness


def behind_the_sun(scene):
    """Inertia that the sun's teeth accelerate, as the sun feels it [kg m^2]."""
    mass, teeth, drive = scene.gearset.equivalent_mass, scene.gearset.teeth, scene.drive
    pitch = 0.5 * scene.gearset.module * teeth.sun
    rims = (scene.gearset.planets * mass.planet + mass.ring) * pitch**2
    return rims + drive.output.inertia * (teeth.sun / teeth.ring) ** 2


def per_mesh(scene, sun_planet, planet_ring):
    """A value of each kind of mesh, in the order of the results."""
    return np.repeat([sun_planet, planet_ring], scene.gearset.planets)


def stiffnesses(scene):
    """Of one tooth pair of every mesh [N/m]."""
    return per_mesh(scene, scene.mesh.sun_planet_stiffness, scene.mesh.planet_ring_stiffness)


def turnover(energy):
    """Energy that passes through the train, or into and out of its springs and masses [J]."""
    return sum(map(abs, energy.machines)) + abs(energy.kinetic) + abs(energy.elastic)


def assert_finite(run):
    for values in (run.dte, run.mesh_force, run.angle, run.speed, run.power_loss):
        assert np.isfinite(values).all()


def assert_closed(run, scene, share=1e-4):
    """Energy in is energy out, kept or lost, up to `share` of what is turned over.

    At standstill and without load hardly anything is: there the measure is what the shafts store,
    and what rounding leaves of the energy of rotation.
    """
    point, motor = scene.operating_point, scene.drive.input
    stored = (abs(point.input_torque) + point.torque_ripple) ** 2 / (2.0 * motor.coupling_stiffness)
    spinning = 0.5 * motor.inertia * np.abs(run.speed[:, 0]).max() ** 2
    allowed = share * turnover(run.energy) + 1e-8 * stored + 1e-14 * spinning + LEAST
    assert abs(run.energy.residual) <= allowed
    assert run.energy.friction >= -allowed
    assert run.energy.damping >= -allowed
    assert (run.power_loss >= 0.0).all()


def sound_run(scene, duration, sample_rate=20_000.0, tolerance=1e-6):
    """A run that is finite, closed in energy and has not taken steps without end."""
    run = pt.simulate(scene, duration, sample_rate, tolerance=tolerance)
    assert_finite(run)
    assert_closed(run, scene)
    return run
