"""Families of meshes: how the mesh of size h is made. A family is a dict of these entries:

    morphology    options of the program, whose -size is h; `scaled` names the options that are h times a number instead
    file          a gmsh .geo for every h, which finds h as the number `h` (DefineConstant); or one ready .msh
    files         a .geo or a .msh for each h
    numbers       more numbers for gmsh, constants of the .geo or options as Mesh.RecombineAll
    refine_from   the mesh of this size is made, and `slide -mesh_refine` halves it until it has size h
"""

import math

ENTRIES = ("morphology", "scaled", "file", "files", "numbers", "refine_from")
KINDS = ("morphology", "file", "files")
SAME = 1e-6  # relative: sizes that are closer are equal


def checked(name, family):
    """The family. Raises ValueError in one sentence."""
    if unknown := family.keys() - set(ENTRIES):
        raise ValueError(f"family {name}: unknown entry {sorted(unknown)[0]!r}; known are {', '.join(ENTRIES)}")
    if sum(kind in family for kind in KINDS) != 1:
        raise ValueError(f"family {name}: give one of {', '.join(KINDS)}")
    if str(family.get("file", "")).endswith(".msh") and "refine_from" not in family:
        raise ValueError(f"family {name}: one .msh has one size, which refine_from has to say")
    return family


def made_and_refined(name, family, size):
    """The size of the mesh that is made, and how many times it is halved to have `size`. Raises ValueError when
    halving does not lead there."""
    base = checked(name, family).get("refine_from")
    if base is None:
        return size, 0
    times = round(math.log2(float(base) / size))
    if times < 0 or abs(float(base) / 2**times / size - 1) > SAME:
        raise ValueError(f"family {name}: halving {float(base):g} does not lead to {size:g}")
    return float(base), times


def is_drawn(family):
    """Whether `morphology` makes its meshes, not gmsh or nobody."""
    return "morphology" in family


def morphology_options(family, size):
    scaled = family.get("scaled", {"size": 1})
    return {**family["morphology"], **{name: float(f"{float(factor) * size:.12g}") for name, factor in scaled.items()}}


def file_of(name, family, size):
    """The .geo or .msh of this size. Raises ValueError when none is listed."""
    if "file" in checked(name, family):
        return str(family["file"])
    for listed, path in family["files"].items():
        if abs(float(listed) / size - 1) < SAME:
            return str(path)
    raise ValueError(f"family {name}: files lists none for the size {size:g}")


def file_command(path, family, size, mesh):
    """Words that leave the file `mesh`: a .msh is copied, a .geo meshed with the number h."""
    if path.endswith(".msh"):
        return ["cp", path, mesh]
    numbers = [word for name, value in {"h": size, **family.get("numbers", {})}.items()
               for word in ("-setnumber", name, f"{float(value):.12g}")]
    return ["gmsh", "-2", "-v", "2", "-format", "msh41", *numbers, "-o", mesh, path]


if __name__ == "__main__":
    raise SystemExit("refinement.families is a library, no command: snakemake --snakefile runs/refinement/Snakefile "
                     "runs the study.")
