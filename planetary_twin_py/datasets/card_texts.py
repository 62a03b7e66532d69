"""Sentences on what a data set is, which its card, its datasheet and its metadata share."""

from __future__ import annotations

from .plan import DatasetPlan

USES = (
    "Develop and compare methods of condition monitoring for planetary gearboxes.",
    "Study what a method finds over severity, load, speed, noise and path: each is in a column.",
    "Compare a faulty record with the healthy one of the same pair_id, which has the same "
    "specimen, load and speed.",
)
LIMITS = (
    "All records are simulated. A method that works on them has not been shown to work on a "
    "machine.",
    "Levels are those of no real housing: the gain of the path is drawn or given. Ratios of lines "
    "of one sensor follow from the model.",
    "The path from the teeth to a sensor has no resonances of a housing but those that the sensor "
    "states; other stages, shafts, couplings and machines beside the gearbox are silent.",
    "Noise is white and stationary. There are no impacts from outside, no electrical hum, no loose "
    "or drifting sensors.",
    "A fault does not grow within a record unless its fields say so, and a specimen has the same "
    "fault in all records of one state.",
    "Labels are exact and states are equally frequent, unlike those of any fleet.",
)


def description_of(plan: DatasetPlan) -> str:
    """A paragraph on the data set."""
    spec, gears = plan.spec, plan.scene.gearset
    teeth = gears.teeth
    counted = (
        f"{spec.records} simulated records of {spec.duration:g} s: {spec.specimens} specimens of a "
        f"planetary gearbox with {teeth.sun}/{teeth.planet}/{teeth.ring} teeth and "
        f"{gears.planets} planets (scene {plan.scene.name}), in the states "
        f"{', '.join(plan.labels)}."
    )
    return f"{spec.description.strip()} {counted}".strip()


def unmodelled(plan: DatasetPlan) -> list[str]:
    """Sentences on what the scene of the data set leaves out."""
    scene, drawn = plan.scene, {draw.field.split(".")[0] for draw in plan.drawn}
    found = []
    if not scene.moving_axes:
        found.append(
            f"Dynamics are {scene.dynamics}: axes are held, so there are no displacements of sun, "
            "carrier or planets, and no modes of bearings and shafts."
        )
    if not {"errors", "mesh"} & drawn:
        found.append("Specimens have the same gears: no error of a gear or a pin is drawn.")
    if "sensors" not in drawn:
        found.append("Specimens have the same path and the same sensors.")
    if all(course.steady for _, course in plan.points):
        found.append("Speed and torque are constant within a record.")
    return found
