"""Small blocks that slide, for dense_modes.py, `modes` and `slide`: meshes by `morphology`, options as flat dicts.

The environment says where the programs are: SLIPSCALE_MORPHOLOGY, SLIPSCALE_SLIDE.
"""

import os
import subprocess
import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[2] / "runs"), str(Path(__file__).parents[1] / "programs")]

SIDE, DIVISIONS = 5e-3, 10  # m; cells along a side
STEP, EVERY = 10e-9, 20  # s; steps between rows of contact.h5

MESHES = {
    "plain": {"shape": "none", "structured": True, "cell": "quadrilateral"},
    "periodic": {"shape": "none", "structured": True, "cell": "quadrilateral", "periodic": "x"},
    "triangles": {"shape": "none", "structured": True, "cell": "triangle"},
    "discs": {"shape": "disc", "fraction": 0.25, "diameter": 1.2e-3, "gap": 0.4e-3, "clearance": 0.4e-3, "seed": 2},
}
ONE = {"material_all_young": 45e9, "material_all_poisson": 0.25, "material_all_density": 1800}
TWO = {"material_matrix_young": 30e9, "material_matrix_poisson": 0.25, "material_matrix_density": 1800,
       "material_inclusion_young": 80e9, "material_inclusion_poisson": 0.25, "material_inclusion_density": 2200}
# Orthotropic, axes turned by 25 degrees.
TURNED = {"material_all_stiffness": "80.1e9,48.3e9,21.7e9,23.4e9,9.8e9,5.2e9", "material_all_density": 1800}

# Pressed down slowly, as a step would shake the block; then as long as its vibration is small it is linear.
SLIDING = {"surface_boundary": "bottom", "surface_speed": 2, "friction_law": "regularized", "friction_coefficient": 0.4,
           "friction_time": 0.6e-6, "boundary_top_x": "fixed", "boundary_top_y": -1.3888888888888889e-6,
           "boundary_top_ramp": 200e-6, "damping_stiffness": 2e-9, "time_step": STEP, "time_end": 400e-6}
# The exact uniform state at the start and a seed: every node is closed.
UNIFORM = {**SLIDING, "boundary_top_y": "fixed", "boundary_top_ramp": None, "initial_pressure": 15e6, "surface_speed": 20,
           "initial_shear": 7.5e6, "friction_coefficient": 0.5, "friction_time": 0.3e-6, "initial_sine_amplitude": 1e-6, "initial_sine_wavelength": SIDE, "time_end": 150e-6}

SCENES = {  # name: (mesh, options)
    "partly open": ("plain", {**SLIDING, **ONE}),
    "closed, periodic": ("periodic", {**UNIFORM, **ONE}),
    "composite, partly open": ("discs", {**SLIDING, **TWO, "time_step": 5e-9, "friction_coefficient": 0.35}),
    "anisotropic, P1": ("triangles", {**SLIDING, **TURNED, "friction_coefficient": 0.2}),
    "beta2 .8, mass damping": ("plain", {**SLIDING, **ONE, "time_beta2": 0.8, "damping_mass": 1e4, "time_end": 300e-6}),
    "surface to the left": ("plain", {**SLIDING, **ONE, "surface_speed": -2}),
    # So fast that T, a little different at each slip rate, stays the same to the digits asked for.
    "rate: slip": ("plain", {**SLIDING, **ONE, "surface_speed": 400, "friction_time": None, "friction_rate": "slip",
                             "friction_length": 300e-6, "friction_rate_reference": 100, "time_end": 300e-6}),
}


def words(options):
    return [word for name, value in options.items() if value is not None for word in ("-" + name, str(value))]


def run(program, options):
    """A program of slipscale by name, which must succeed; what it said."""
    done = subprocess.run([os.environ[f"SLIPSCALE_{program.upper()}"], *words(options)], stdin=subprocess.DEVNULL,
                          capture_output=True, text=True, timeout=300)
    if done.returncode:
        raise RuntimeError(f"{program}: {done.stdout}{done.stderr}")
    return done.stdout


def mesh(folder, name, divisions=DIVISIONS):
    """The path of one of MESHES, made in `folder` when it is first asked for."""
    made = Path(folder) / f"{name}-{divisions}"
    if not (made / "mesh.msh").is_file():
        run("morphology", {"block_width": SIDE, "block_height": SIDE, "size": SIDE / divisions, **MESHES[name],
                           "output_folder": made})
    return made / "mesh.msh"


def scene(folder, name, divisions=DIVISIONS):
    """Options of one of SCENES with its mesh."""
    kind, options = SCENES[name]
    return {"mesh_file": mesh(folder, kind, divisions), **{key: value for key, value in options.items()
                                                           if value is not None}}
