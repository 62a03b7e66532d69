"""A drive whose speed holds."""

# Stiff shafts and a heavy motor: the speed holds, and nothing but the meshes yields.
STEADY = {
    "mesh.damping.law": "viscous",
    "mesh.damping.damping_ratio": 1.0,
    "drive.speed_control.bandwidth": 50.0,
    "drive.input.inertia": 2.0,
    "drive.output.inertia": 5e-3,
    **{
        f"drive.{side}.{name}": value
        for side in ("input", "output")
        for name, value in (("coupling_stiffness", 1e7), ("coupling_damping", 1e3))
    },
}
