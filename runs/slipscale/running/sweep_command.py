"""A sweep from the command line: writes its study.yaml and starts snakemake on it, nothing more.

    runs/sweep/run.sh [-options_file_yaml SCENE.yaml] [--recipe BLOCK.yaml] -friction_coefficient 0.1:0.1:0.8
        -surface_speed 1,2,4 [-any_option value] [--output out/mine] [-- -c4]

Options of slide and morphology with one minus; those with several values are varied, and every combination is run.
  start:step:stop   a range; start:*factor:stop too          1,2,5   several values
  [0,-1],[0,-2]     values that are lists; of an option that takes a list, 0,-1 is one value
What else the scene and the block are made of stands in study.yaml, or in the files given in its place. Behind -- stand
words for snakemake: -c4 for four cores (else all), -n to see what would be run, --profile runs/profiles/slurm.
"""

import argparse
import os
import sys
from pathlib import Path

import yaml

from slipscale.running.attempt import write_whole
from slipscale.running.commands import flat
from slipscale.running.sweep import Mistake, takes_list, values_of
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
    try:
        options = yaml.safe_load(Path(path).read_text())
    except (OSError, yaml.YAMLError) as error:
        raise Mistake(f"{path} cannot be read as YAML ({' '.join(str(error).split())}).") from error
    if not isinstance(options, dict):
        raise Mistake(f"{path} should hold options, as friction: {{coefficient: 0.3}}.")
    return {name: value for name, value in flat(options).items() if name != "output_folder"}


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


def main(arguments=None):
    folder, *words = sys.argv[1:] if arguments is None else arguments
    cut = words.index("--") if "--" in words else len(words)
    parser = argparse.ArgumentParser("run.sh", description=__doc__, allow_abbrev=False,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--recipe", help="YAML file, options of morphology for the block")
    parser.add_argument("--list", help="CSV file of combinations to run, a column for each option")
    parser.add_argument("--window", nargs=2, type=float, metavar=("FROM", "TO"), help="times of the averages, s")
    parser.add_argument("--output", help="folder (default: below out/sweeps, by the names of what is varied)")
    parser.add_argument("--ranks", type=int, help="of each run")
    parser.add_argument("--programs", help="folder of the programs")
    top = Path(folder).resolve().parents[1]
    try:
        options, left = paired(words[:cut])
        given = parser.parse_args(left)
        base = yaml.safe_load((Path(folder) / "study.yaml").read_text())
        base.update({"programs": str(Path(given.programs).resolve())} if given.programs else {})
        manuals = manuals_of(top / base["programs"])
        study = study_of(base, options, given.recipe, given.list, given.window, given.output, given.ranks, manuals)
        os.chdir(top)
        count = len(plan(study, manuals).runs)
    except Mistake as mistake:
        print(f"run.sh: {mistake}", file=sys.stderr)
        return 2
    out = top / study["output"]
    out.mkdir(parents=True, exist_ok=True)
    write_whole(out / "study.yaml", yaml.safe_dump(study, sort_keys=False, allow_unicode=True))
    print(f"{count} runs; the study: {out}/study.yaml\ntable:   {out}/table.csv\npicture: {out}/picture/picture.png",
          flush=True)
    snakemake = ["snakemake", "--snakefile", f"{folder}/Snakefile", "--config", f"study={out}/study.yaml"]
    more = words[cut + 1:]
    if not any(word.startswith(("-c", "--cores", "--profile", "-j", "--jobs")) for word in more):
        more = ["--cores", "all", *more]
    os.execvp(snakemake[0], [*snakemake, "--rerun-incomplete", *more])


if __name__ == "__main__":
    sys.exit(main())
