"""From the study.yaml of a sweep to its meshes, effective materials and runs: which option goes to which program.

The entries `mesh` (a recipe of morphology, or null where the scene names a mesh_file), `homogenize` (null, or `mesh`,
the recipe of what is homogenised, and `options` of homogenize), `scene` (options of slide), `sweep` and `list`.
"""

from dataclasses import dataclass, field
from pathlib import Path

from slipscale.mistakes import Mistake
from slipscale.running.commands import flat
from slipscale.running.sweep import check, combinations, manual, name_of, named, owner, parameters_in

PROGRAMS = ("slide", "morphology", "homogenize")
BLOCK, COMPOSITE = "block", "composite"


@dataclass
class Plan:
    """`runs`: the options varied anywhere, by run; `usual`: what each of them is where it is not varied, or None;
    `scenes`: what rules/slide.smk asks of scene_of, by run; `meshes`: options of morphology by mesh; `effectives`:
    pairs of mesh and options of homogenize by name."""

    runs: dict
    usual: dict
    scenes: dict = field(default_factory=dict)
    meshes: dict = field(default_factory=dict)
    effectives: dict = field(default_factory=dict)


def given(options):
    """Nested options joined as in a scene; one that is null is left out."""
    return {name: value for name, value in flat(options or {}).items() if value is not None}


def program_of(name, manuals):
    """With an effective material the phases belong to homogenize."""
    if "homogenize" in manuals and name.startswith(("material_", "cell_")):
        return "homogenize"
    return owner(name, manuals)


def recipe_options(varied, recipes):
    """What is varied in each recipe: an option goes to those that name it, or else to the last, the composite's."""
    chosen = {recipe: {} for recipe in recipes}
    for name, value in varied.items():
        if not recipes:
            raise Mistake(f"-{name} is an option of morphology, but there is no recipe: the scene has a mesh_file.")
        for recipe in [recipe for recipe in recipes if name in recipes[recipe]] or list(recipes)[-1:]:
            chosen[recipe][name] = value
    return chosen


def checked(config, manuals):
    """The flat recipes by mesh, options of homogenize and of slide. Raises Mistake for an option that nobody knows."""
    homogenize = config.get("homogenize") or {}
    recipes = {BLOCK: given(config.get("mesh"))} if config.get("mesh") else {}
    if homogenize:
        recipes[COMPOSITE] = given(homogenize.get("mesh"))
    constants, scene = given(homogenize.get("options")), given(config.get("scene"))
    for program, options in [("morphology", recipe) for recipe in recipes.values()] + [
            ("homogenize", constants), ("slide", scene)]:
        for name, value in options.items():
            if not name.startswith("cell_"):  # PETSc's solver options
                check(name, value, {program: manuals[program]} if program in manuals else manuals, parameters_in(scene))
    return recipes, constants, scene


def plan(config, manuals):
    """The Plan of a study; `manuals` holds the options of each program (`sweep.manual`). Raises Mistake."""
    if not config.get("homogenize"):
        manuals = {name: options for name, options in manuals.items() if name != "homogenize"}
    recipes, constants, scene = checked(config, manuals)
    runs = combinations(config.get("sweep"), config.get("list"), manuals,
                        parameters_in({**scene, **(config.get("sweep") or {})}))
    usual = {name: usual_value(name, [scene, constants, *recipes.values()]) for run in runs for name in run}
    filled = {name: value for name, value in usual.items() if value is not None}
    found = Plan(named([{name: {**filled, **run}[name] for name in usual if name in run or name in filled}
                        for run in runs]), usual)
    for name, options in found.runs.items():
        parts = {program: {} for program in PROGRAMS}
        for option, value in options.items():
            parts[program_of(option, manuals)][option] = value
        changes = recipe_options(parts["morphology"], recipes)
        meshes = {recipe: "-".join(filter(None, [recipe, name_of(change) if change else ""]))
                  for recipe, change in changes.items()}
        found.meshes.update({meshes[recipe]: {**recipes[recipe], **change} for recipe, change in changes.items()})
        effective = None
        if COMPOSITE in meshes:
            changed = {**changes[COMPOSITE], **parts["homogenize"]}
            effective = name_of(changed)
            found.effectives[effective] = meshes[COMPOSITE], {**constants, **parts["homogenize"]}
        found.scenes[name] = {"mesh": meshes.get(BLOCK), "effective": effective,
                              **with_files({**scene, **parts["slide"]}, BLOCK in meshes)}
    return found


def usual_value(name, places):
    """The value of an option where it is not varied, or None: no place names it, or several differently."""
    values = [options[name] for options in places if name in options]
    return values[0] if values and all(value == values[0] for value in values) else None


def with_files(options, meshed):
    """The options of a run and the files they name. Raises Mistake when there is not exactly one mesh, or no file."""
    if meshed == ("mesh_file" in options):
        raise Mistake("The block needs a recipe, `mesh`, or a mesh_file in `scene`, and not both.")
    files = [str(value) for name, value in options.items()
             if name == "mesh_file" or name.startswith("material_") and name.endswith("_file")]
    if missing := [file for file in files if not Path(file).is_file()]:
        raise Mistake(f"There is no {missing[0]}, which the scene names.")
    return {"options": options, "files": files}


def manuals_of(folder):
    """Of the programs in a folder."""
    return {program: manual(Path(folder) / program) for program in PROGRAMS}
