"""A sweep from the command line: writes its study.yaml and starts snakemake on it, nothing more.

    slipscale sweep [SCENE.yaml] [--recipe BLOCK.yaml] -friction_coefficient 0.1:0.1:0.8 -surface_speed 1,2,4
        [-any_option value] [--output out/mine] [--dry-run] [-- -c4]

Options of slide and morphology with one minus; those with several values are varied, and every combination is run.
  start:step:stop   a range; start:*factor:stop too          1,2,5   several values
  [0,-1],[0,-2]     values that are lists; of an option that takes a list, 0,-1 is one value
The scene may be given as for slide, -options_file_yaml SCENE.yaml. What else the scene and the block are made of stands
in the study.yaml of the folder runs/sweep, or in the files given in its place. Everything is found and written from
where the command is given; all of it, the engine's notes included, below --output. Behind -- stand words for snakemake:
-c4 for four cores (else all), --profile runs/profiles/slurm.
"""

import os
import shutil
import sys
from pathlib import Path

import yaml

from slipscale.mistakes import Mistake
from slipscale.parser import Parser, Window
from slipscale.reading import yaml_file
from slipscale.running import programs
from slipscale.running.attempt import write_whole
from slipscale.running.commands import flat, pairs_of
from slipscale.running.sweep import takes_list, values_of
from slipscale.running.sweep_plan import manuals_of, plan, program_of

FILE = "options_file_yaml"


def is_option(word):
    return word[:1] == "-" and word[1:2].isalpha()


def paired(words):
    """Options, pairs of name and text, from words -name text, and the words that are left."""
    options, left, k = [], [], 0
    while k < len(words):
        if is_option(words[k]) and words[k] != "-h":
            if k + 1 == len(words) or is_option(words[k + 1]) or words[k + 1].startswith("--"):
                raise Mistake(f"{words[k]} needs a value.")
            options.append((words[k][1:], words[k + 1]))
            k += 2
        else:
            left.append(words[k])
            k += 1
    return options, left


def read_options(path):
    """The flat options of a file, but for the folder. Raises Mistake."""
    found = {}
    for name, value in pairs_of(yaml_file.options(path)):
        if name in found:
            raise Mistake(f"{path}: {name} is given twice (keys join with _); keep one")
        found[name] = value
    found.pop("output_folder", None)
    return found


def study_of(base, options, recipe=None, rows=None, window=None, output=None, ranks=None, manuals=None):
    """The study.yaml, a dict: `base`, that of the folder, with the `options` (pairs of name and text) of a command
    line, the file `recipe` of the block, the file `rows` of combinations, and so on in place of its own."""
    files = [text for name, text in options if name == FILE]
    scene = {} if files else flat(base.get("scene") or {})
    for file in files:
        scene.update(read_options(file))
    block = read_options(recipe) if recipe else flat(base.get("mesh") or {})
    programs = {name: known for name, known in manuals.items() if name != "homogenize" or base.get("homogenize")}
    sweep = {}
    for name, text in options:
        if name == FILE:
            continue
        values = values_of(text, takes_list(name, manuals))
        program = program_of(name, programs)
        if len(values) > 1 or program == "homogenize":
            sweep[name] = values
        else:
            (block if program == "morphology" else scene)[name] = values[0]
    if "mesh_file" in sweep or (not recipe and "mesh_file" in scene):
        block = None
    elif recipe:
        scene.pop("mesh_file", None)
    for place in (scene, sweep):
        place.update({name: found_from_here(place[name]) for name in ("mesh_file", "material_file") if name in place})
    changes = {"window": window, "ranks": ranks, "output": output or f"out/sweeps/{'-'.join(sweep) or 'runs'}"}
    return {**base, "mesh": block, "scene": scene, "sweep": sweep, "list": str(Path(rows).resolve()) if rows else [],
            "readme": False, **{name: value for name, value in changes.items() if value is not None}}


def found_from_here(files):
    """Files that exist from where the command was given, as absolute paths."""
    if isinstance(files, list):
        return [found_from_here(file) for file in files]
    return str(Path(files).resolve()) if Path(files).is_file() else files


SHIPPED = Path(__file__).resolve().parents[2] / "sweep"  # the folder of the Snakefile and of a study.yaml


def parsed(words):
    """What was asked for, with `options`, pairs of name and text. Raises Mistake."""
    parser = Parser("sweep", __doc__)
    parser.add_argument("scene", nargs="*", help="YAML files, as with -options_file_yaml")
    parser.add_argument("--recipe", help="YAML file, options of morphology for the block")
    parser.add_argument("--list", help="CSV file of combinations to run, a column for each option")
    parser.add_argument("--window", action=Window, metavar=("FROM", "TO"), help="times of the averages, s "
                        "(default: the second half of each run)")
    parser.add_argument("--output", help="folder (default: below out/sweeps, by the names of what is varied)")
    parser.add_argument("--ranks", type=int, help="of each run")
    parser.add_argument("--programs", help="folder of the programs (default: those beside this command)")
    parser.add_argument("--study", default=SHIPPED, help="a copy of the folder runs/sweep whose study.yaml is meant")
    parser.add_argument("--dry-run", action="store_true", help="only say what would be run")
    options, left = paired(words)
    asked = parser.parse_args(left)
    asked.options = [*((FILE, file) for file in asked.scene), *options]
    return asked


def planned(asked):
    """The study.yaml, a dict, and the plan. Raises Mistake."""
    base = yaml_file.options(Path(asked.study) / "study.yaml")
    base["programs"] = str(programs.folder(asked.programs or base.get("programs")))
    manuals = manuals_of(base["programs"])
    study = study_of(base, asked.options, asked.recipe, asked.list, asked.window, asked.output, asked.ranks, manuals)
    study["output"] = str(Path(study["output"]).resolve())
    return study, plan(study, manuals)


def counted(things, one, several):
    return f"{len(things)} {one if len(things) == 1 else several}" if things else ""


def said(study, found):
    """How much is to be run and where it will be, a text."""
    counts = [counted(found.runs, "run", "runs"), counted(found.meshes, "mesh", "meshes"),
              counted(found.effectives, "effective material", "effective materials")]
    out = study["output"]
    return (f"{', '.join(filter(None, counts))}; the study: {out}/study.yaml\ntable:   {out}/table.csv\n"
            f"picture: {out}/picture/picture.png")


def snakefile_of(folder):
    """Its own, of a copy beside the studies, else the one that is shipped."""
    own = Path(folder).resolve() / "Snakefile"
    return str(own if own.is_file() else SHIPPED / "Snakefile")


def snakemake(study, folder, more, dry):
    """The words that start the engine, its notes being kept in the output folder."""
    if not any(word.startswith(("-c", "--cores", "--profile", "-j", "--jobs")) for word in more):
        more = ["--cores", "all", *more]
    out = study["output"]
    return ["snakemake", "--snakefile", snakefile_of(folder), "--directory", out, "--config",
            f"study={out}/study.yaml", "--rerun-incomplete", *(["--dry-run", "--quiet", "all"] if dry else []), *more]


def main(arguments=None):
    words = sys.argv[1:] if arguments is None else arguments
    cut = words.index("--") if "--" in words else len(words)
    asked = parsed(words[:cut])
    if not shutil.which("snakemake"):
        raise Mistake("snakemake, which starts the runs, is not installed: cmake/install-dependencies.sh installs it")
    study, found = planned(asked)
    print(said(study, found), flush=True)
    if asked.dry_run and not words[cut + 1:]:
        return 0
    out = Path(study["output"])
    out.mkdir(parents=True, exist_ok=True)
    write_whole(out / "study.yaml", yaml.safe_dump(study, sort_keys=False, allow_unicode=True))
    command = snakemake(study, asked.study, words[cut + 1:], asked.dry_run)
    os.execvp(command[0], command)
