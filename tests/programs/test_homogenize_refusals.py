"""Mistakes in a run of `homogenize`: one sentence that names the option or the mesh entity, the fault and the cure,
exit code 2 on every rank, no file touched.

SLIPSCALE_RANKS says on how many ranks.
"""

import unittest

from homogenising import FILES, ONE_REGION, RUN, Homogenising, hollow
from mistakes import RANKS, Mistake, Mistaken
from scenes import block


def value(option, wrong, *words):
    """A value that the option does not take; the sentence must name both."""
    return Mistake([f"-{option} ", str(wrong), *words], {option: wrong})


def missing(option, *words):
    return Mistake([f"-{option} ", "needed here but not given", *words], {option: None})


def mesh(file, *words, **changes):
    return Mistake([f"'{file}'", *words], {"mesh_file": file, **changes})


def hollow_mesh(file, boundary, *words):
    return mesh(file, *words, cell_boundary=boundary, **(ONE_REGION if "hole" in file else {}))


def choice(option, wrong, *words, **changes):
    """A value that PETSc does not take."""
    return Mistake(["-cell_snes_, -cell_ksp_ and -cell_pc_", *words, "give another value"], {option: wrong, **changes})


def unread(option, given, **changes):
    return Mistake([f"-{option} was given but neither homogenize nor PETSc has read it", "correct its name"],
                   {option: given, **changes})


STIFFNESS = {"material_matrix_young": None, "material_matrix_poisson": None}
WEAK = {"cell_ksp_type": "cg", "cell_pc_type": "none"}
FACTORISE = "-cell_pc_type cholesky -cell_ksp_type preonly"
LAYERS = {"material_all_young": 1e9, "material_all_poisson": 0.3, "material_all_density": 1,
          **{name: None for name in RUN if name.startswith("material_")}}
OPEN_SIDES = ("-cell_boundary periodic", "outer edges", "take -cell_boundary kubc or subc")
PARTS = ("2 parts that share no node", "keep one part, or mesh what is between them")

MISTAKES = {
    # Meshes
    "no mesh": missing("mesh_file", "gmsh mesh"),
    "mesh missing": mesh("absent.msh", "-mesh_file", "cannot read", "give the path"),
    "mesh is a folder": mesh(".", "-mesh_file", "cannot read"),
    "mesh is prose": mesh("prose.msh", "is not a gmsh mesh", "gmsh -2 -format msh41"),
    "mesh is binary junk": mesh("junk.msh", "is not a gmsh mesh", "gmsh -2 -format msh41"),
    "mesh periodic in MSH 2": mesh("old_torus.msh", "MSH 2", "gmsh -2 -format msh41", **LAYERS),
    "mesh without names": mesh("nameless.msh", "names no region", "Physical Surface", **LAYERS),
    "two cells across": mesh("narrow.msh", "fewer than three cells", "finer", **LAYERS),
    "block as a torus": mesh("plain.msh", *OPEN_SIDES),
    "block as a torus among all": mesh("plain.msh", *OPEN_SIDES, "(and all)", cell_boundary="all"),
    "strip as a torus": mesh("strip.msh", *OPEN_SIDES, "periodic along one axis only"),
    "sides paired in part": mesh("unpaired.msh", "two sides meet across a period that are not paired",
                                 "Periodic Curve"),
    "sides that do not match": mesh("unmatched.msh", "pairs sides that do not match", "Periodic Curve"),
    "floating inclusion, periodic": hollow_mesh("loose_torus.msh", "periodic", *PARTS),
    "floating inclusion, kubc": hollow_mesh("loose.msh", "kubc", *PARTS),
    "floating inclusion, subc": hollow_mesh("loose.msh", "subc", *PARTS),
    # Names
    "region misspelt": Mistake(["region 'matirx'", "did you mean -material_matrix_young?", "matrix, inclusion"],
                               {"material_matrix_young": None, "material_matirx_young": 30e9}),
    "region unknown": Mistake(["region 'steel'", "the mesh has matrix, inclusion"], {"material_steel_young": 1e9}),
    "option unknown": Mistake(["-wind_speed is not an option of homogenize", "homogenize -help"], {"wind_speed": 3}),
    "option of slide": Mistake(["-time_end is not an option of homogenize"], {"time_end": 1}),
    "option misspelt": Mistake(["-cell_bondary is not an option", "did you mean -cell_boundary?"],
                               {"cell_bondary": "all"}),
    "option in capitals": Mistake(["-Cell_boundary differs in capitals", "write -cell_boundary"],
                                  {"Cell_boundary": "all"}),
    "option misspelt in the file": Mistake(["-cell_boundry is not an option", "did you mean -cell_boundary?"],
                                           yaml="cell: {boundry: all}\n"),
    "option of PETSc's misspelt": unread("cell_ksp_rtoll", 1e-8),
    "option of PETSc's without prefix": unread("ksp_rtol", 1e-8),
    "object of PETSc's misspelt": Mistake(["-cell_kps_rtol is not an option of homogenize"], {"cell_kps_rtol": 1e-8}),
    # Materials
    "no material": Mistake(["region 'inclusion' has no material", "-material_inclusion_young"], ONE_REGION),
    "no density": missing("material_matrix_density", "kg/m3"),
    "nu one half": value("material_matrix_poisson", 0.5, "> -1 and < 0.5"),
    "nu below minus one": value("material_matrix_poisson", -1.2, "> -1 and < 0.5"),
    "young negative": value("material_matrix_young", -30e9, "> 0", "Pa"),
    "density zero": value("material_inclusion_density", 0, "> 0", "kg/m3"),
    "stiffness not positive definite": Mistake(
        ["-material_matrix_stiffness", "not positive definite", "check the order"],
        {**STIFFNESS, "material_matrix_stiffness": "5e10,5e10,9e10,2e10,0,0"}),
    "five numbers of stiffness": Mistake(["-material_matrix_stiffness", "six numbers", "5 are given"],
                                         {**STIFFNESS, "material_matrix_stiffness": "5e10,5e10,1e10,2e10,0"}),
    "young and stiffness": Mistake(["-material_matrix_young contradicts -material_matrix_stiffness", "give one"],
                                   {"material_matrix_stiffness": "5e10,5e10,1e10,2e10,0,0"}),
    "material file missing": Mistake(["-material_inclusion_file", "cannot read 'absent.yaml'", "effective.yaml"],
                                     {**ONE_REGION, "material_inclusion_file": "absent.yaml"}),
    "material file of something else": Mistake(["-material_inclusion_file", "'other.yaml' must hold 'stiffness:"],
                                               {**ONE_REGION, "material_inclusion_file": "other.yaml"}),
    "material for no region": Mistake(["-material_all_young has no effect", "remove it"], {"material_all_young": 1e9}),
    # Values
    "boundary nonsense": value("cell_boundary", "periodc", "periodic, kubc, subc or all", "did you mean periodic?"),
    "estimate nonsense": value("cell_estimate_error", "maybe", "true or false"),
    "partitioner nonsense": value("mesh_partitioner", "scissors", "metis, simple or ptscotch"),
    "refinement negative": value("mesh_refine", -1, ">= 0"),
    "refinement by half": value("mesh_refine", 1.5, "whole number"),
    "value missing": Mistake(["-cell_boundary has no value", "kubc"], arguments=["-cell_boundary"]),
    "equals sign": Mistake(["--cell_boundary=all", "write -cell_boundary all"], arguments=["--cell_boundary=all"]),
    "stray word": Mistake(["'stray' belongs to no option"], arguments=["stray"]),
    "file missing": Mistake(["cannot read 'absent.yaml'"], arguments=["-options_file_yaml", "absent.yaml"]),
    # Solvers
    "solver nonsense": choice("cell_ksp_type", "cgg", "KSP type cgg"),
    "preconditioner nonsense": choice("cell_pc_type", "gamgg", "PC type gamgg"),
    "Newton nonsense": choice("cell_snes_type", "newtonlss", "SNES type newtonlss"),
    "tolerance a word": choice("cell_ksp_rtol", "tight", "tight has no numeric value", cell_ksp_type="cg"),
    "iterations by half": choice("cell_ksp_max_it", "2.5", "2.5 has no integer value", cell_ksp_type="cg"),
    "norm nonsense": choice("cell_ksp_norm_type", "natrual", "natural", cell_ksp_type="cg"),
    "factorisation by nobody": choice("cell_pc_factor_mat_solver_type", "mumpss", "mumpss"),
    "KSP diverges": Mistake(["unit load xx did not converge", "SNES DIVERGED_LINEAR_SOLVE",
                             "KSP DIVERGED_ITS after 2 iterations", FACTORISE, "-cell_ksp_max_it"],
                            {**WEAK, "cell_ksp_max_it": 2}),
    "KSP diverges, the third condition": Mistake(["did not converge", "KSP DIVERGED_ITS"],
                                                 {**WEAK, "cell_boundary": "subc", "cell_ksp_max_it": 2}),
    "SNES diverges": Mistake(["unit load xx did not converge (SNES DIVERGED_MAX_IT after 0 Newton steps)",
                              "leave the options -cell_snes_ out"], {"cell_snes_max_it": 0}),
    "KSP not asked for enough": Mistake(["did not converge (SNES DIVERGED_MAX_IT", "-cell_ksp_converged_reason"],
                                        {**WEAK, "cell_ksp_rtol": 0.5, "cell_snes_rtol": 1e-10, "cell_snes_max_it": 3}),
    # Folders
    "no folder": missing("output_folder", "effective.yaml"),
    "folder is a file": Mistake(["-output_folder 'plain.msh'", "give a folder"], {"output_folder": "plain.msh"}),
    "folder in a file": Mistake(["-output_folder 'plain.msh/out'", "give a folder"],
                                {"output_folder": "plain.msh/out"}),
    "folder that nobody can make": Mistake(["-output_folder '/proc/slipscale'", "give a folder"],
                                           {"output_folder": "/proc/slipscale"}),
}


def links(mesh_text):
    """The node pairs of each entry of $Periodic: where they begin among the lines, and how many they are."""
    lines = mesh_text.split("\n")
    at = lines.index("$Periodic") + 2
    while not lines[at].startswith("$End"):
        count = int(lines[at + 2])
        yield at + 3, count
        at += 3 + count


def without_pairs(mesh_text):
    """A torus whose longest pair of sides is no longer one."""
    lines = mesh_text.split("\n")
    begin, count = max(links(mesh_text), key=lambda link: link[1])
    total = int(lines[lines.index("$Periodic") + 1])
    lines[lines.index("$Periodic") + 1] = str(total - 1)
    del lines[begin - 3:begin + count]
    return "\n".join(lines)


def with_moved_node(mesh_text):
    """A torus with one node of a side off its partner by a tenth of an edge, along the side."""
    lines = mesh_text.split("\n")
    begin, count = max(links(mesh_text), key=lambda link: link[1])
    node = lines[begin + count // 2].split()[0]
    at = lines.index("$Nodes") + 2
    while not lines[at].startswith("$End"):
        size = int(lines[at].split()[3])
        if node in lines[at + 1:at + 1 + size]:
            place = at + size + 1 + lines[at + 1:at + 1 + size].index(node)
            x, y, z = lines[place].split()
            along_x = float(y) in (0, 1e-3)
            lines[place] = f"{float(x) + 1e-5} {y} {z}" if along_x else f"{x} {float(y) + 1e-5} {z}"
        at += 1 + 2 * size
    return "\n".join(lines)


class Refusals(Mistaken, Homogenising):
    program, options, files, mistakes = "homogenize", RUN, FILES, MISTAKES

    def setUp(self):
        super().setUp()
        self.material = self.folder / "material"
        self.material.mkdir()
        for name, periodic in (("cell", "xy"), ("strip", "x"), ("plain", "none")):
            self.draw_cell(self.material / f"{name}.msh", periodic=periodic)
        torus = (self.material / "cell.msh").read_text()
        (self.material / "unpaired.msh").write_text(without_pairs(torus))
        (self.material / "unmatched.msh").write_text(with_moved_node(torus))
        (self.material / "prose.msh").write_text("A mesh has nodes and cells.\n")
        (self.material / "junk.msh").write_bytes(bytes(range(256)) * 40)
        (self.material / "other.yaml").write_text("stiffness: soft\n")
        for name, disc in (("hole", False), ("loose", True)):
            hollow(self.material / f"{name}.msh", disc=disc)
            hollow(self.material / f"{name}_torus.msh", periodic=True, disc=disc)
        block(self.material / "old_torus.msh", periodic=True, form="msh2")
        block(self.material / "nameless.msh", names=False)
        block(self.material / "narrow.msh", periodic=True, divisions=2)

    def check_without_mistakes(self):
        """What the mistakes are made of is sound: the cell, and one with a hole."""
        self.run_cell(mesh_file="material/cell.msh", ranks=RANKS)
        self.run_cell(mesh_file="material/hole_torus.msh", cell_boundary="all", **ONE_REGION, ranks=RANKS)


if __name__ == "__main__":
    unittest.main()
