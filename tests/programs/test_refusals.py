"""Mistakes in a scene: one sentence naming the option or the mesh entity, exit code 2 on every rank, no file touched.

SLIPSCALE_RANKS says on how many ranks.
"""

import os
import shutil
import unittest
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field

from running import InScratch, arguments_of, snapshot, yaml_of
from scenes import block

RANKS = int(os.environ.get("SLIPSCALE_RANKS", "1"))
AT_ONCE = 2  # starting and ending a parallel job is mostly waiting

SCENE = {
    "mesh_file": "composite.msh",
    "material_matrix_young": 30e9, "material_matrix_poisson": 0.25, "material_matrix_density": 1800,
    "material_inclusion_young": 80e9, "material_inclusion_poisson": 0.25, "material_inclusion_density": 1800,
    "surface_boundary": "bottom", "surface_height": 0, "surface_speed": 2,
    "friction_law": "regularized", "friction_coefficient": 0.5, "friction_length": 1.2e-6,
    "boundary_top_x": "fixed", "boundary_top_y": -1e-6, "boundary_top_ramp": 40e-6,
    "time_end": 1e-6,
}

MESHES = {
    "composite.msh": {"regions": ("matrix", "inclusion")},
    "torus.msh": {"regions": ("matrix", "inclusion"), "periodic": True},
    "old_torus.msh": {"regions": ("matrix", "inclusion"), "periodic": True, "form": "msh2"},
    "old.msh": {"regions": ("matrix", "inclusion"), "form": "msh2"},
    "solid.msh": {"depth": 1e-3, "divisions": 2},
    "nameless.msh": {"names": False},
    "narrow.msh": {"regions": ("matrix", "inclusion"), "periodic": True, "divisions": 2},
}


@dataclass
class Mistake:
    """Words that the sentence must have, and how the scene is spoiled."""

    words: list
    changes: dict = field(default_factory=dict)  # of the scene; None leaves an option out
    arguments: list = field(default_factory=list)  # put behind the scene
    yaml: str = ""  # put below the scene in the file


def value(option, wrong, *words):
    """A value that the option does not take; the sentence must name both."""
    return Mistake([f"-{option} ", str(wrong), *words], {option: wrong})


def missing(option, *words):
    return Mistake([f"-{option} ", "needed here but not given", *words], {option: None})


NO_SURFACE = {name: None for name in SCENE if name.startswith(("surface_", "friction_"))}
STIFFNESS = {"material_matrix_young": None, "material_matrix_poisson": None}

MISTAKES = {
    # Names
    "region misspelt": Mistake(["region 'matirx'", "did you mean -material_matrix_young?", "matrix, inclusion"],
                               {"material_matrix_young": None, "material_matirx_young": 30e9}),
    "region unknown": Mistake(["region 'steel'", "the mesh has matrix, inclusion"], {"material_steel_young": 1e9}),
    "boundary misspelt": Mistake(["boundary 'tpo'", "did you mean -boundary_top_pressure?"],
                                 {"boundary_tpo_pressure": 1e6}),
    "boundary unknown": Mistake(["boundary 'ceiling'", "bottom, top, left, right"], {"boundary_ceiling_pressure": 1e6}),
    "contact boundary unknown": Mistake(["-surface_boundary", "no boundary 'floor'", "bottom, top, left, right"],
                                        {"surface_boundary": "floor"}),
    "measured boundary unknown": Mistake(["-history_boundary", "no boundary 'roof'"], {"history_boundary": "roof"}),
    "option unknown": Mistake(["-wind_speed is not an option of slide"], {"wind_speed": 3}),
    "option misspelt": Mistake(["-fricton_coefficient is not an option", "did you mean -friction_coefficient?"],
                               {"fricton_coefficient": 0.3}),
    "option in capitals": Mistake(["differs in capitals", "write -friction_coefficient"],
                                 {"friction_coefficient": None, "Friction_Coefficient": 0.3}),
    "option misspelt in the file": Mistake(["-friction_coeficient is not an option",
                                            "did you mean -friction_coefficient?"],
                                           yaml="friction: {coeficient: 0.3}\n"),
    # Materials
    "no material": Mistake(["region 'inclusion' has no material", "-material_inclusion_young"],
                           {f"material_inclusion_{key}": None for key in ("young", "poisson", "density")}),
    "no density": missing("material_matrix_density", "kg/m3"),
    "nu one half": value("material_matrix_poisson", 0.5, "> -1 and < 0.5"),
    "nu minus one": value("material_matrix_poisson", -1, "> -1 and < 0.5"),
    "density negative": value("material_inclusion_density", -1800, "> 0", "kg/m3"),
    "young zero": value("material_matrix_young", 0, "> 0", "Pa"),
    "stiffness not positive definite": Mistake(["-material_matrix_stiffness", "not positive definite"],
                                               {**STIFFNESS, "material_matrix_stiffness": "5e10,5e10,9e10,2e10,0,0"}),
    "five numbers of stiffness": Mistake(["-material_matrix_stiffness", "six numbers", "5 are given"],
                                         {**STIFFNESS, "material_matrix_stiffness": "5e10,5e10,1e10,2e10,0"}),
    "young and stiffness": Mistake(["-material_matrix_young contradicts -material_matrix_stiffness"],
                                   {"material_matrix_stiffness": "5e10,5e10,1e10,2e10,0,0"}),
    "material file missing": Mistake(["-material_file", "cannot read 'absent.yaml'"],
                                     {**{name: None for name in SCENE if name.startswith("material_")},
                                      "material_file": "absent.yaml"}),
    # The step
    "step zero": value("time_step", 0, "> 0"),
    "step negative": value("time_step", -1e-9, "> 0"),
    "step above the limit": Mistake(["-time_step is 1e-06 s", "stable step", "use at most", "e-08 or auto"],
                                    {"time_step": 1e-6}),
    "step too small to count": Mistake(["-time_end", "steps of 1e-310 s"], {"time_step": 1e-310}),
    "step nonsense": value("time_step", "quick", "auto"),
    "no end": missing("time_end", "> 0"),
    "end infinite": value("time_end", "inf"),
    "more steps than can be counted": Mistake(["-time_end", "1e+30 s", "steps"], {"time_end": 1e30}),
    "beta2 below": value("time_beta2", 0.4, "[0.5, 1]"),
    "beta2 above": value("time_beta2", 1.2, "[0.5, 1]"),
    "safety zero": value("time_safety", 0, "> 0 and <= 1"),
    "safety above": value("time_safety", 1.5, "> 0 and <= 1"),
    # Contact and friction
    "no coefficient": missing("friction_coefficient"),
    "coefficient negative": value("friction_coefficient", -0.5, ">= 0"),
    "coefficient no number": value("friction_coefficient", "0,5", "decimal point"),
    "law nonsense": value("friction_law", "coulom", "none, coulomb, regularized or exponential", "did you mean coulomb?"),
    "speed zero": Mistake(["-surface_speed is 0", "give -friction_time"], {"surface_speed": 0}),
    "time and length": Mistake(["-friction_time contradicts -friction_length"], {"friction_time": 6e-7}),
    "time with the slip rate": Mistake(["-friction_time", "-friction_rate slip"],
                                       {"friction_time": 6e-7, "friction_length": None, "friction_rate": "slip"}),
    "no reference rate": Mistake(["-friction_rate_reference", "not given"], {"friction_rate": "slip"}),
    "friction without a surface": Mistake(["-friction_coefficient", "without -surface_boundary"],
                                          {**NO_SURFACE, "friction_coefficient": 0.5}),
    "threshold without a surface": Mistake(["-friction_threshold", "without -surface_boundary"],
                                           {**NO_SURFACE, "friction_threshold": "regularized"}),
    "body starts below the surface": Mistake(["-surface_height is 1e-05 m", "body reaches down to 0 m", "-initial_gap"],
                                             {"surface_height": 1e-5}),
    "contact boundary held": Mistake(["-boundary_bottom_y", "-surface_boundary", "make it free"],
                                     {"boundary_bottom_y": "fixed"}),
    # Conditions
    "condition on the seam": Mistake(["-boundary_left_", "boundary 'left'", "periodic seam"],
                                     {"mesh_file": "torus.msh", "boundary_left_x": "fixed"}),
    "surface on the seam": Mistake(["-surface_boundary", "'left'", "periodic seam"],
                                   {"mesh_file": "torus.msh", "surface_boundary": "left"}),
    "corner pulled two ways": Mistake(["'top'", "'left'", "different displacements along x", "_x equal to the other"],
                                      {"boundary_left_x": 1e-6}),
    "condition nonsense": value("boundary_top_x", "clamped", "free, fixed or a number"),
    "uniform state of a composite": Mistake(["-initial_pressure", "materials of the regions differ"],
                                            {"initial_pressure": 1e6}),
    "sine without wavelength": Mistake(["-initial_sine_wavelength", "not given"], {"initial_sine_amplitude": 0.1}),
    "velocity of one number": Mistake(["-initial_velocity", "two numbers"], {"initial_velocity": 1}),
    "gravity of three numbers": Mistake(["-body_acceleration", "two numbers"], {"body_acceleration": "0,0,9.81"}),
    # Records
    "odd count of points": Mistake(["-history_points", "odd count"], {"history_points": "0,0,1e-3"}),
    "point outside": Mistake(["-history_points", "(0.1, 0) m lies outside the body", "move the point"],
                             {"history_points": "1e-3,1e-3,0.1,0"}),
    "points no numbers": Mistake(["-history_points", "'x' is no number"], {"history_points": "0,x"}),
    "frames after the end": Mistake(["-fields_times", "2e-06 s lies outside the run"], {"fields_times": "0,2e-6"}),
    "frames before the start": Mistake(["-fields_times", "-1e-06 s lies outside the run"], {"fields_times": "-1e-6,0"}),
    "frames far after the end": Mistake(["-fields_times", "1e+30 s lies outside the run"], {"fields_times": "1e30"}),
    "frames twice": Mistake(["-fields_every contradicts -fields_times"], {"fields_every": 5, "fields_times": "0"}),
    "quantities nonsense": Mistake(["-fields_quantities", "'power'", "u, v, stress, strain, von_mises, principal and damping_work"],
                                   {"fields_every": 5, "fields_quantities": "u,power"}),
    "contact rows between steps": Mistake(["-contact_every is 2.5", "whole number"], {"contact_every": 2.5}),
    "rows within a step": Mistake(["-history_interval is 1e-12 s", "less than the step", "give at least that"],
                                  {"history_every": None, "history_interval": 1e-12}),
    "rows every zero steps": value("history_every", 0, ">= 1"),
    "folder is a file": Mistake(["-output_folder 'composite.msh'", "give a folder"],
                                {"output_folder": "composite.msh"}),
    "folder in a file": Mistake(["-output_folder 'composite.msh/out'", "cannot be created"],
                                {"output_folder": "composite.msh/out"}),
    "folder that nobody can make": Mistake(["-output_folder '/proc/slipscale'", "cannot be created"],
                                           {"output_folder": "/proc/slipscale"}),
    # Meshes
    "no mesh": missing("mesh_file"),
    "mesh missing": Mistake(["-mesh_file", "cannot read 'absent.msh'"], {"mesh_file": "absent.msh"}),
    "mesh is a folder": Mistake(["-mesh_file", "cannot read '.'"], {"mesh_file": "."}),
    "mesh is no mesh": Mistake(["-mesh_file", "'prose.msh' is not a gmsh mesh"], {"mesh_file": "prose.msh"}),
    "mesh truncated": Mistake(["'truncated.msh'"], {"mesh_file": "truncated.msh"}),
    "mesh solid": Mistake(["'solid.msh' has 3-dimensional cells", "plane"], {"mesh_file": "solid.msh"}),
    "mesh without names": Mistake(["'nameless.msh' names no region", "Physical Surface"],
                                  {"mesh_file": "nameless.msh"}),
    "mesh periodic in MSH 2": Mistake(["'old_torus.msh'", "MSH 2", "lose its periodicity", "gmsh -2 -format msh41"],
                                      {"mesh_file": "old_torus.msh"}),
    "mesh too narrow": Mistake(["'narrow.msh'", "fewer than three cells"], {"mesh_file": "narrow.msh"}),
    "mesh in MSH 2": Mistake(["'old.msh' is written as MSH 2.2", "convert it with gmsh -0 old.msh -format msh41 -o "],
                             {"mesh_file": "old.msh"}),
    "mesh of two bodies": Mistake(["'unglued.msh'", "coincide but are not one", "Coherence"],
                                  {"mesh_file": "unglued.msh"}),
    "refined beyond measure": Mistake(["-mesh_refine 31", "refine less"], {"mesh_refine": 31}),
    "partitioner nonsense": value("mesh_partitioner", "scissors", "metis, simple or ptscotch"),
    "storage nonsense": value("stiffness_storage", "half", "double or single"),
    # Spelling of the command line and of the file
    "equals sign": Mistake(["--time_beta2=0.5", "write -time_beta2 0.5"], arguments=["--time_beta2=0.5"]),
    "stray word": Mistake(["'stray' belongs to no option"], arguments=["stray"]),
    "history of PETSc": Mistake(["-history is not an option of slide", "did you mean -history_"],
                                arguments=["-history"]),
    "value missing": Mistake(["-time_beta2 has no value"], arguments=["-time_beta2"]),
    "value missing in the file": Mistake(["-time_beta2 has no value"], yaml="time: {beta2: }\n"),
    "file missing": Mistake(["cannot read 'absent.yaml'"], arguments=["-options_file_yaml", "absent.yaml"]),
    "file is no YAML": Mistake(["scene.yaml is not valid YAML near line"], yaml="time: {beta2: 0.5\n"),
    "file gives it twice": Mistake(["scene.yaml", "time_end is given twice"], yaml="time: {end: 1}\n"),
}


OF_A_RUN = ("run.yaml", "summary.yaml", "history.h5", "contact.h5", "fields.h5", "fields.xdmf")


def unglued(mesh):
    """The text of a mesh whose two layers do not share the nodes between them: the upper ones get their own."""
    lines = mesh.split("\n")
    begin, end = lines.index("$Nodes") + 1, lines.index("$EndNodes")
    blocks, count, least, largest = map(int, lines[begin].split())
    middle, k = {}, begin + 1
    while k < end:
        size = int(lines[k].split()[3])
        for tag, x in zip(lines[k + 1:k + 1 + size], lines[k + 1 + size:k + 1 + 2 * size]):
            if abs(float(x.split()[1]) / 2.5e-3 - 1) < 1e-6:
                middle[tag] = (str(largest + len(middle) + 1), x)
        k += 1 + 2 * size
    more = [f"2 2 0 {len(middle)}", *(tag for tag, _ in middle.values()), *(x for _, x in middle.values())]
    lines[begin] = f"{blocks + 1} {count + len(middle)} {least} {largest + len(middle)}"
    k = lines.index("$Elements") + 2
    while not lines[k].startswith("$"):
        dimension, entity, _, size = map(int, lines[k].split())
        for at in range(k + 1, k + 1 + size):
            if (dimension, entity) in ((2, 2), (1, 201), (1, 301)):  # surface and sides of the upper layer
                tag, *nodes = lines[at].split()
                lines[at] = " ".join([tag, *(middle.get(node, (node,))[0] for node in nodes)])
        k += 1 + size
    return "\n".join(lines[:end] + more + lines[end:])


class Refusals(InScratch):
    def setUp(self):
        super().setUp()
        self.meshes = self.folder / "meshes"
        self.meshes.mkdir()
        for name, choice in MESHES.items():
            block(self.meshes / name, **choice)
        whole = (self.meshes / "composite.msh").read_bytes()
        (self.meshes / "unglued.msh").write_text(unglued(whole.decode()))
        (self.meshes / "truncated.msh").write_bytes(whole[:len(whole) // 2])
        (self.meshes / "prose.msh").write_text("A mesh has nodes and cells.\n")

    def test_mistakes(self):
        with ThreadPoolExecutor(AT_ONCE) as pool:
            made = {name: pool.submit(self.make, mistake, self.folder / str(count), (count + RANKS) % 2 == 0)
                    for count, (name, mistake) in enumerate(MISTAKES.items())}
            for name, mistake in MISTAKES.items():
                with self.subTest(name):
                    self.check(mistake, *made[name].result())

    def make(self, mistake, folder, older_run):
        """Runs the spoiled scene in its own folder: what was said, and what the folder held before and after.

        An older run may be in the output folder or not: each mistake meets both, on one rank or on two.
        """
        shutil.copytree(self.meshes, folder)
        (folder / "scene.yaml").write_text(yaml_of(SCENE) + mistake.yaml)
        if older_run:
            (folder / "out").mkdir()
            for file in (*OF_A_RUN, "notes.txt"):
                (folder / "out" / file).write_text("of an older run")
        before = snapshot(folder)
        scene = ["-options_file_yaml", "scene.yaml"] if mistake.yaml else arguments_of({**SCENE, **mistake.changes})
        outcome = self.slide(*scene, *mistake.arguments, ranks=RANKS, folder=folder)
        return outcome, before, snapshot(folder)

    def check(self, mistake, outcome, before, after):
        self.assert_refused("slide", outcome, mistake.words, RANKS)
        self.assertEqual(before, after, "files were touched")

    def test_the_scene_without_mistakes(self):
        self.run_scene({**SCENE, "mesh_file": "meshes/composite.msh"}, ranks=RANKS)


if __name__ == "__main__":
    unittest.main()
