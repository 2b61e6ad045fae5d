"""What each option of `slide` does: the table behind test_every_option.py.

A row changes one option of a small scene and says how a number among the results answers, and names the scenes in
which the option has no effect and is refused. Expectations are the physics' or the option's own meaning, never earlier
output.
"""

from dataclasses import dataclass, field

import numpy as np
from scenes import SIDE

YOUNG, POISSON, DENSITY = 45e9, 0.25, 1800
C22 = YOUNG * (1 - POISSON) / ((1 + POISSON) * (1 - 2 * POISSON))
C66 = YOUNG / (2 * (1 + POISSON))

# A block pressed down within 2 us on a surface that drags it along +x: the bottom slips all the time.
SCENE = {
    "mesh_file": "block.msh",
    "material_block_young": YOUNG, "material_block_poisson": POISSON, "material_block_density": DENSITY,
    "surface_boundary": "bottom", "surface_speed": 2,
    "friction_law": "regularized", "friction_coefficient": 0.5, "friction_time": 0.6e-6,
    "boundary_top_x": "fixed", "boundary_top_y": -1.4e-6, "boundary_top_ramp": 2e-6,
    "time_end": 4e-6, "time_step": 2e-8,  # 200 steps
    "history_every": 5, "history_points": f"{SIDE / 2},0,{SIDE / 2},{SIDE}", "contact_every": 20,
}
FREE = {name: None for name in SCENE if name.startswith(("surface_", "friction_", "contact_"))}  # without a surface
UNNAMED = {name: None for name in SCENE if name.startswith("material_")}
ISOTROPIC = {"material_block_young": None, "material_block_poisson": None}
FOUR_TIMES = ",".join(str(4 * c) for c in (C22, C22, C22 - 2 * C66, C66, 0, 0))
LENGTH = {"friction_time": None, "friction_length": 1.2e-6}
BY_SLIP_RATE = {**LENGTH, "friction_rate": "slip", "friction_rate_reference": 0.2}
FRICTIONLESS = {"friction_law": "none", "friction_coefficient": None, "friction_time": None}
COULOMB = {"friction_law": "coulomb", "friction_time": None}
FALLING = {"friction_law": "exponential", "friction_kinetic": 0.5, "friction_slip_rate": 2}
SINE = {"initial_sine_amplitude": 0.1, "initial_sine_wavelength": SIDE}
PLATE = {"boundary_top_y": "rigid", "boundary_top_force": 1e4}
LOADED = {"boundary_top_y": None, "boundary_top_pressure": 1e6}


# How a number answers.
def more(before, after):
    return np.all(after > before)


def less(before, after):
    return np.all(after < before)


def same(before, after):
    return np.array_equal(before, after)


def becomes(value, tolerance=1e-9):
    """The value, which the number did not have before."""
    def check(before, after):
        scale = tolerance * max(np.abs(value).max(), 1e-300)
        return np.allclose(after, value, rtol=0, atol=scale) and not np.allclose(before, value, rtol=0, atol=scale)
    return check


def grows(factor, tolerance=1e-9):
    """By a factor, which may be negative."""
    return lambda before, after: np.allclose(after, factor * before, rtol=tolerance, atol=0) and np.any(before != 0)


def differs(least, most):
    """Somewhere, by between these parts of the largest value."""
    return lambda before, after: least < np.abs(after - before).max() / np.abs(before).max() < most


# The numbers: functions of a run (see test_every_option.py).
def has(file):
    return lambda run: int(file in run.files)


def last(name):
    return lambda run: run.history[name][-1]


def first(name):
    return lambda run: run.history[name][0]


def mean(name):
    return lambda run: run.history[name].mean()


def arrival(run):
    """When the push of the top has reached the surface."""
    force = run.history["surface/normal_force"]
    return run.history["time"][np.argmax(force > 0.01 * force.max())]


def strain_energy(stress, modulus):
    return 0.5 * stress**2 / modulus * SIDE**2


def quantities(run):
    return len({name.rsplit("/", 1)[1] for name in run.fields if name.startswith("frames/")} &
               {"u", "v", "stress", "strain", "von_mises", "principal_high", "principal_low", "damping_work"})


def frames(run):
    return len({name.split("/")[1] for name in run.fields if name.startswith("frames/")})


FIBRE = {"mesh_file": "two.msh", "material_fibre_young": YOUNG, "material_fibre_poisson": POISSON,
         "material_fibre_density": DENSITY}
FOLLOWED = {**FIBRE, "interfaces_region": "fibre"}
NO_REGION = "without -interfaces_region"
STRENGTHS = {"interfaces_normal_strength": 1e6, "interfaces_shear_strength": 1e6}
INDEX = lambda run: run.interfaces["index"].sum()
SAMPLES = {"statistics_from": 1e-6, "statistics_to": 3e-6, "statistics_every": 5}  # steps 50, 55, ..., 150
NO_WINDOW = "without -statistics_from"
QUANTILE = lambda run: run.statistics["statistics/stress/quantile_high"].sum()
M_X = lambda run: run.history["points/0/v"][0, 0]
TOP_X = lambda run: run.history["points/1/u"][-1, 0]
DRAG = mean("surface/tangential_force")
LOAD = mean("boundary/top/normal_force")
STEPS = lambda run: run.summary["steps"]
NODES = lambda run: run.facts["nodes"]
SPEED = lambda run: np.array(run.facts["wave_speeds_block"])


@dataclass
class Answer:
    """To `changes` of SCENE (with `base` on it before and after), in one number of the results."""

    changes: dict
    number: object
    expectation: object
    base: dict = field(default_factory=dict)
    ranks: int = 1


@dataclass
class Idle:
    """Changes of SCENE under which the option has no effect, and words of the refusal."""

    changes: dict
    words: str


@dataclass
class Row:
    answers: list
    idle: list  # ALWAYS, or scenes


def needs_surface(value):
    return Idle({**FREE, "OPTION": value}, "without -surface_boundary")


def needs_memory(value):
    return [needs_surface(value), Idle({**COULOMB, "OPTION": value}, "with -friction_law coulomb"),
            Idle({**FRICTIONLESS, "OPTION": value}, "with -friction_law none")]


def needs_falling(value):
    return needs_memory(value) + [Idle({"OPTION": value}, "with -friction_law regularized")]


ALWAYS = []  # acts in every scene
ALL_NAMED = "since every region has a material of its own"
HELD = "where the motion along it is prescribed"
NOT_STRAIGHT = "on a side that is not kept straight"

# `OPTION` among the changes stands for the option itself; `<region>` and `<boundary>` are `block` and `top`.
ROWS = {
    "mesh_file": Row([Answer({"OPTION": "fine.msh"}, NODES, grows(289 / 81))], ALWAYS),
    # How a mesh is cut changes the cost and not one bit of the result.
    "mesh_partitioner": Row([Answer({"OPTION": "simple"}, DRAG, same, ranks=2),
                             Answer({"OPTION": "simple"}, lambda run: run.edge_cut, more, ranks=2)], ALWAYS),
    "mesh_refine": Row([Answer({"OPTION": 1}, NODES, grows(289 / 81))], ALWAYS),
    # Opened, the seam has its nodes twice.
    "mesh_periodic": Row([Answer({"OPTION": "false"}, NODES, grows(81 / 72), base={"mesh_file": "ring.msh"})],
                         [Idle({"OPTION": "false"}, "'block.msh' is not periodic")]),

    "material_<region>_young": Row([Answer({"OPTION": 4 * YOUNG}, SPEED, grows(2, 1e-5)),
                                    Answer({"OPTION": 4 * YOUNG}, arrival, less)],
                                   [Idle({"material_all_young": YOUNG}, ALL_NAMED)]),
    "material_<region>_poisson": Row([Answer({"OPTION": 0.45}, arrival, less)],
                                     [Idle({"material_all_poisson": POISSON}, ALL_NAMED)]),
    "material_<region>_density": Row([Answer({"OPTION": 4 * DENSITY}, SPEED, grows(0.5, 1e-5)),
                                      Answer({"OPTION": 4 * DENSITY}, arrival, more)],
                                     [Idle({"material_all_density": DENSITY}, ALL_NAMED)]),
    "material_<region>_stiffness": Row([Answer({**ISOTROPIC, "OPTION": FOUR_TIMES}, SPEED, grows(2, 1e-5)),
                                        Answer({**ISOTROPIC, "OPTION": FOUR_TIMES}, arrival, less)],
                                       [Idle({"material_all_stiffness": FOUR_TIMES}, ALL_NAMED)]),
    "material_<region>_file": Row([Answer({**UNNAMED, "OPTION": "four_times.yaml"}, arrival, less)],
                                  [Idle({"material_all_file": "four_times.yaml"}, ALL_NAMED)]),
    "material_file": Row([Answer({**UNNAMED, "OPTION": "four_times.yaml"}, arrival, less)],
                         [Idle({"OPTION": "four_times.yaml"}, ALL_NAMED)]),

    # What formulas make: test_formulas.py.
    "parameters_<parameter>": Row([Answer({"OPTION": 4}, last("energy/surface_drive"), more,
                                          base={"surface_speed": "v", "OPTION": 2})],
                                  [Idle({"OPTION": 2}, "has no effect in this scene")]),
    "body_acceleration": Row([Answer({"OPTION": "0,-1e6"}, mean("surface/normal_force"), more)], ALWAYS),
    "damping_mass": Row([Answer({"OPTION": 1e5}, last("energy/damping"), more)], ALWAYS),
    "damping_stiffness": Row([Answer({"OPTION": 2e-9}, last("energy/damping"), more)], ALWAYS),
    "time_step": Row([Answer({"OPTION": 1e-8}, STEPS, grows(2))], ALWAYS),
    "time_safety": Row([Answer({"OPTION": 0.45}, STEPS, grows(2, 0.05), base={"time_step": None})],
                       [Idle({"OPTION": 0.5}, "with -time_step 2e-08")]),
    "time_end": Row([Answer({"OPTION": 8e-6}, last("time"), grows(2))], ALWAYS),
    "time_beta2": Row([Answer({"OPTION": 0.8}, last("energy/scheme_dissipation"), more)], ALWAYS),
    "stiffness_storage": Row([Answer({"OPTION": "single"}, lambda run: run.history["points/0/u"],
                                     differs(1e-12, 1e-5))], ALWAYS),
    "stiffness_kernel": Row([Answer({"OPTION": "pairs"}, lambda run: run.history["points/0/u"], same)], ALWAYS),
    "stiffness_instructions": Row([Answer({"OPTION": "base"}, lambda run: run.history["points/0/u"], same)], ALWAYS),

    "boundary_<boundary>_x": Row([Answer({"OPTION": "free"}, TOP_X, more),
                                  Answer({"OPTION": 1e-7}, TOP_X, becomes(1e-7))], ALWAYS),
    "boundary_<boundary>_y": Row([Answer({"OPTION": -2.8e-6}, LOAD, more)], ALWAYS),
    "boundary_<boundary>_pressure": Row([Answer({"OPTION": 2e6}, last("energy/loads"), more,
                                                base={**LOADED, "history_every": 10})],
                                        [Idle({"OPTION": 1e6}, HELD)]),
    "boundary_<boundary>_shear": Row([Answer({"OPTION": 1e6}, TOP_X, more, base={"boundary_top_x": None})],
                                     [Idle({"OPTION": 1e6}, HELD)]),
    "boundary_<boundary>_ramp": Row([Answer({"OPTION": 4e-6}, LOAD, less)],
                                    [Idle({"boundary_top_y": "fixed"},
                                          "where no displacement, pressure, shear or force is imposed")]),
    # Kept straight, the top carries what presses it; a heavier plate has not come as far.
    "boundary_<boundary>_force": Row([Answer({"OPTION": 2e4}, LOAD, more, base=PLATE)],
                                     [Idle({"OPTION": 1e4}, NOT_STRAIGHT)]),
    "boundary_<boundary>_mass": Row([Answer({"OPTION": 1}, last("energy/loads"), less, base=PLATE)],
                                    [Idle({"OPTION": 1}, NOT_STRAIGHT)]),

    # What it does: test_open_end.py.
    "boundary_<boundary>_absorbing": Row(
        [Answer({"OPTION": "true"}, last("energy/radiated"), more, base={**LOADED, "boundary_top_x": None})],
        [Idle({"OPTION": "true"}, "on a side whose motion is prescribed")]),

    "initial_velocity": Row([Answer({"OPTION": "0,-0.5"}, mean("surface/normal_force"), more)], ALWAYS),
    "initial_displacement": Row([Answer({"OPTION": "0,-1e-7", "surface_height": -1e-6}, first("energy/strain"), same),
                                 Answer({"OPTION": "1e-7*y/H,0"}, first("energy/strain"),
                                        becomes(strain_energy(1e-7 / SIDE * C66, C66)))], ALWAYS),
    # Interpolated: test_initial_file.py. The table holds a shear, the run rises from rest.
    "initial_file": Row([Answer({"OPTION": "sheared.csv"}, first("energy/strain"),
                                becomes(strain_energy(1e-7 / SIDE * C66, C66)))], ALWAYS),
    "initial_time": Row([Answer({"OPTION": 0}, first("energy/kinetic"), less, base={"initial_file": "rising"})],
                        [Idle({"OPTION": 0}, "without -initial_file"),
                         Idle({"initial_file": "sheared.csv", "OPTION": 0}, "with a table")]),
    "initial_rotation": Row([Answer({"OPTION": 40}, M_X, becomes(20 * SIDE))], ALWAYS),
    "initial_sine_amplitude": Row([Answer({"OPTION": 0.2}, M_X, becomes(-0.2), base=SINE)], ALWAYS),
    "initial_sine_wavelength": Row([Answer({"OPTION": 1.5 * SIDE}, M_X, becomes(0.1 * np.cos(2 * np.pi / 3)),
                                           base=SINE)],
                                   [Idle({"OPTION": SIDE}, "without -initial_sine_amplitude")]),
    "initial_gap": Row([Answer({"OPTION": 1e-7}, arrival, more)], [needs_surface(1e-6)]),
    "initial_pressure": Row([Answer({"OPTION": 1e6}, first("energy/strain"), becomes(strain_energy(1e6, C22)))],
                            ALWAYS),
    "initial_shear": Row([Answer({"OPTION": 1e6}, first("energy/strain"), becomes(strain_energy(1e6, C66)))], ALWAYS),

    "surface_boundary": Row([Answer({name: SCENE[name] for name in FREE},
                                    lambda run: int("contact.h5" in run.files), more, base=FREE)], ALWAYS),
    "surface_height": Row([Answer({"OPTION": -5e-7}, LOAD, less)], [needs_surface(-1e-6)]),
    # The block and its mesh are symmetric.
    "surface_speed": Row([Answer({"OPTION": -2}, DRAG, grows(-1)),
                          Answer({"OPTION": 4}, last("energy/surface_drive"), more)], [needs_surface(2)]),
    "surface_speed_ramp": Row([Answer({"OPTION": 1e-5}, last("energy/surface_drive"), less)],
                              [needs_surface(1e-6),
                               Idle({"surface_speed": 0, "OPTION": 1e-6}, "with -surface_speed 0")]),

    # While the pressure rises, a regularised traction lags behind mu p, and the more so the longer the memory.
    "friction_law": Row([Answer(COULOMB, DRAG, more), Answer(FRICTIONLESS, DRAG, becomes(0))], [needs_surface("none")]),
    "friction_coefficient": Row([Answer({"OPTION": 0.25}, DRAG, less)],
                                [needs_surface(0.5), Idle({**FRICTIONLESS, "OPTION": 0.5}, "with -friction_law none")]),
    # The faster the slip, the nearer to the kinetic coefficient.
    "friction_kinetic": Row([Answer({"OPTION": 0.2}, DRAG, less, base=FALLING)], needs_falling(0.2)),
    "friction_slip_rate": Row([Answer({"OPTION": 20}, DRAG, more, base={**FALLING, "friction_kinetic": 0.2})],
                              needs_falling(2)),
    "friction_<region>_kinetic": Row([Answer({"OPTION": 0.2}, DRAG, less, base=FALLING)], needs_falling(0.2)),
    "friction_<region>_slip_rate": Row([Answer({"OPTION": 20}, DRAG, more, base={**FALLING, "friction_kinetic": 0.2})],
                                       needs_falling(2)),
    "friction_length": Row([Answer({"OPTION": 1.2e-5}, DRAG, less, base=LENGTH)],
                           needs_memory(1e-6) +
                           [Idle({"OPTION": 1e-6}, "-friction_time contradicts -friction_length")]),
    "friction_time": Row([Answer({"OPTION": 6e-6}, DRAG, less)],
                         needs_memory(1e-6) + [Idle({**BY_SLIP_RATE, "OPTION": 1e-6}, "with -friction_rate slip")]),
    # Each where it touches: test_phases.py.
    "friction_<region>_coefficient": Row([Answer({"OPTION": 0.25}, DRAG, less)],
                                         [needs_surface(0.5), Idle({**FRICTIONLESS, "OPTION": 0.5}, "with -friction_law none")]),
    "friction_<region>_length": Row([Answer({"OPTION": 1.2e-5}, DRAG, less, base=LENGTH)],
                                    needs_memory(1e-6) + [Idle({"friction_block_time": 1e-6, "OPTION": 1e-6},
                                                               "contradicts")]),
    "friction_<region>_time": Row([Answer({"OPTION": 6e-6}, DRAG, less)],
                                  needs_memory(1e-6) + [Idle({**BY_SLIP_RATE, "OPTION": 1e-6}, "with -friction_rate slip")]),
    "friction_rate": Row([Answer({"OPTION": "slip", "friction_rate_reference": 20}, DRAG, more, base=LENGTH)],
                         needs_memory("surface")),
    "friction_rate_reference": Row([Answer({"OPTION": 20}, DRAG, more, base=BY_SLIP_RATE)],
                                   needs_memory(1) + [Idle({"OPTION": 1}, "with -friction_rate surface")]),
    # On a slow surface the strength that lags gives way where mu p would not.
    "friction_threshold": Row([Answer({"OPTION": "regularized"}, mean("contact/stick"), less,
                                      base={"surface_speed": 0.02})], needs_memory("regularized")),

    "history_boundary": Row([Answer({"OPTION": "left"},
                                    lambda run: int("boundary/left/normal_force" in run.history), more)], ALWAYS),
    "history_every": Row([Answer({"OPTION": 10}, lambda run: len(run.history["time"]), becomes(21))], ALWAYS),
    "history_points": Row([Answer({"OPTION": "0,0,1e-3,1e-3,2e-3,1e-3"}, lambda run: int("points/2/u" in run.history),
                                  more)], ALWAYS),
    # That the rows balance with the forces: test_momentum.py.
    "history_momentum": Row([Answer({"OPTION": "true"}, lambda run: int("momentum/linear" in run.history), more)], ALWAYS),
    "history_interval": Row([Answer({"history_every": None, "OPTION": 2e-7}, lambda run: len(run.history["time"]),
                                    becomes(21))],
                            [Idle({"OPTION": 2e-7}, "-history_every contradicts -history_interval")]),
    "contact_interval": Row([Answer({"contact_every": None, "OPTION": 2e-7}, lambda run: len(run.contact["time"]),
                                    becomes(21))],
                            [Idle({**FREE, "OPTION": 2e-7}, "without -surface_boundary"),
                             Idle({"OPTION": 2e-7}, "-contact_every contradicts -contact_interval")]),
    "fields_interval": Row([Answer({"OPTION": 1e-6}, frames, becomes(5))],
                           [Idle({"fields_times": "1e-6", "OPTION": 1e-6},
                                 "-fields_interval contradicts -fields_times"),
                            Idle({"fields_every": 5, "OPTION": 1e-6}, "-fields_every contradicts -fields_interval")]),
    "contact_every": Row([Answer({"OPTION": 10}, lambda run: len(run.contact["time"]), becomes(21))],
                         [needs_surface(10)]),
    # That they add up: test_sums.py.
    "contact_sums": Row([Answer({"OPTION": "false"}, lambda run: int("sums/friction_work" in run.contact), less)],
                        [needs_surface("true")]),
    "fields_every": Row([Answer({"OPTION": 50}, frames, becomes(5))],
                        [Idle({"fields_times": "1e-6", "OPTION": 50}, "-fields_every contradicts -fields_times")]),
    "fields_times": Row([Answer({"OPTION": "1e-6,3e-6"}, frames, becomes(2))], ALWAYS),
    "fields_box": Row([Answer({"OPTION": f"0,0,{SIDE / 2},{SIDE / 4}"}, lambda run: len(run.fields["mesh/region"]),
                              becomes(8), base={"fields_every": 50})],
                      [Idle({"OPTION": "0,0,1e-3,1e-3"}, "without -fields_every, -fields_interval or -fields_times")]),
    "fields_quantities": Row([Answer({"OPTION": "u,v"}, quantities, becomes(2), base={"fields_every": 50}),
                              Answer({"OPTION": "u,v,stress,strain"}, quantities, becomes(4),
                                     base={"fields_every": 50}),
                              Answer({"OPTION": "u,von_mises,principal"}, quantities, becomes(4),
                                     base={"fields_every": 50}),
                              Answer({"OPTION": "u,damping_work"}, quantities, becomes(2),
                                     base={"fields_every": 50, "damping_stiffness": 2e-9})],
                             [Idle({"OPTION": "u,v"}, "without -fields_every, -fields_interval or -fields_times")]),
    # Of which the numbers are looked at in test_interfaces.py.
    "interfaces_region": Row([Answer({"OPTION": "fibre"}, has("interfaces.h5"), more, base=FIBRE)],
                             [Idle({"OPTION": "block"}, "the only region of the mesh")]),
    "interfaces_every": Row([Answer({"OPTION": 50}, lambda run: len(run.interfaces["time"]), becomes(5), base=FOLLOWED)],
                            [Idle({"OPTION": 50}, NO_REGION)]),
    "interfaces_interval": Row([Answer({"OPTION": 1e-6}, lambda run: len(run.interfaces["time"]), becomes(5), base=FOLLOWED)],
                               [Idle({"OPTION": 1e-6}, NO_REGION)]),
    # Pulled at its top: pressed, no interface is under tension.
    "interfaces_normal_strength": Row([Answer({"OPTION": 5e5}, INDEX, more,
                                              base={**FOLLOWED, **STRENGTHS, "boundary_top_y": 1.4e-6})],
                                      [Idle({"OPTION": 1e6}, NO_REGION)]),
    "interfaces_shear_strength": Row([Answer({"OPTION": 5e5}, INDEX, more, base={**FOLLOWED, **STRENGTHS})],
                                     [Idle({"OPTION": 1e6}, NO_REGION)]),
    "statistics_from": Row([Answer({"OPTION": 2e-6}, lambda run: run.samples, becomes(11), base=SAMPLES),
                            Answer({"OPTION": 1e-6}, lambda run: int("statistics.h5" in run.files), more)], ALWAYS),
    "statistics_to": Row([Answer({"OPTION": 2e-6}, lambda run: run.samples, becomes(11), base=SAMPLES)],
                         [Idle({"OPTION": 1e-6}, NO_WINDOW)]),
    "statistics_every": Row([Answer({"OPTION": 10}, lambda run: run.samples, becomes(11), base=SAMPLES)],
                            [Idle({"OPTION": 10}, NO_WINDOW)]),
    "statistics_quantile": Row([Answer({"OPTION": 0.9}, QUANTILE, less, base=SAMPLES)],
                               [Idle({"OPTION": 0.9}, NO_WINDOW)]),
    "statistics_damping": Row([Answer({"OPTION": "true"}, lambda run: int("statistics/damping_power" in run.statistics), more,
                                      base={**SAMPLES, "damping_stiffness": 2e-9})],
                              [Idle({"OPTION": "true"}, NO_WINDOW),
                               Idle({**SAMPLES, "OPTION": "true"}, "nothing damps the body")]),
    "output_folder": Row([Answer({"OPTION": "out/deeper"}, lambda run: int("deeper/summary.yaml" in run.files), more)],
                         ALWAYS),
    # For people in front of a terminal: test_progress_is_for_terminals.
    # A run of 200 steps leaves one at its end.
    "checkpoint_every": Row([Answer({"OPTION": 50}, has("checkpoint_older.h5"), more)], ALWAYS),
    "checkpoint_minutes": Row([Answer({"OPTION": 0}, has("checkpoint.h5"), less)], ALWAYS),
    "time_wall": Row([Answer({"OPTION": 60}, DRAG, same)], ALWAYS),  # what it does: test_restart.py

    "progress": Row([Answer({"OPTION": "none"}, DRAG, same)], ALWAYS),
    # A place for information; the only option that promises to do nothing.
    "run_<entry>": Row([Answer({"run_note": "mine"}, DRAG, same)], ALWAYS),
}
