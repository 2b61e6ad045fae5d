"""What a study is asked to do: its study.yaml, what is laid over it, and how many runs that makes."""

import sys
from pathlib import Path

from slipscale.mistakes import Mistake
from slipscale.reading import yaml_file
from slipscale.running.table import grid

REPLACE = "replace"  # entry of an overlay: names of entries that it takes the place of, where others are merged


def merged(base, over):
    """A dict with the entries of `over` laid over those of `base`, maps entry by entry, all else as a whole."""
    found = dict(base)
    for name, value in over.items():
        nested = isinstance(value, dict)
        found[name] = merged(found[name] if isinstance(found.get(name), dict) else {}, value) if nested else value
    return found


def replaced_by(over):
    """The names that an overlay replaces, a list."""
    names = over.get(REPLACE) or []
    return names if isinstance(names, list) else [names]


def laid_over(base, over, name):
    """`merged`, but for what `over`, the file `name`, replaces. Raises Mistake."""
    replaced = replaced_by(over)
    over = {entry: value for entry, value in over.items() if entry != REPLACE}
    if missing := [entry for entry in replaced if entry not in over]:
        raise Mistake(f"{name} replaces {missing[0]} but has no entry of that name")
    return {**merged(base, {entry: value for entry, value in over.items() if entry not in replaced}),
            **{entry: over[entry] for entry in replaced}}


def kept_groups(base, over):
    """Groups of runs of the study that stay beside those of an overlay that has groups of its own."""
    of_base, of_over = base.get("runs"), over.get("runs")
    if not isinstance(of_base, dict) or not isinstance(of_over, dict) or "runs" in replaced_by(over):
        return []
    return [name for name in of_base if name not in of_over]


def settings_of(study, overlays=(), given=None, words=()):
    """The entries of the file `study` under those of the files `overlays`, and of `words`, entry=value of the command
    line, whose values are in the dict `given`. README.md is renewed by a study as it stands, not under an overlay that
    does not say so. `kept_groups`: runs of study.yaml that an overlay with runs of its own adds to. Raises Mistake."""
    found, kept = yaml_file.options(study), []
    for path in overlays or ():
        over = yaml_file.options(path)
        kept = [name for name in kept if name in kept_groups(found, over)] if kept else kept_groups(found, over)
        found = laid_over({**found, "readme": False}, over, path)
    for word in words or ():
        name = word.partition("=")[0]
        if name != "study":
            found[name] = merged({name: found.get(name)}, {name: (given or {})[name]})[name]
    return {**found, "kept_groups": kept}


def what_is_run(config, runs):
    """How many runs there are and of which groups, a text of one or two lines."""
    groups = config.get("runs")
    groups = {name: len(grid(values)) for name, values in groups.items()} if isinstance(groups, dict) else {}
    said = ", ".join(f"{name} {count}" for name, count in groups.items() if count)
    groups_said = f": {said}" if said else ""
    lines = [f"{len(runs)} runs{groups_said}; they and the table are written to {config['output']}"]
    if kept := [name for name in config.get("kept_groups", []) if groups.get(name)]:
        lines.append(f"of study.yaml and not of what is laid over it: {', '.join(kept)}; `replace: [runs]` there "
                     "leaves them out")
    return "\n".join(lines)


def started_by_snakemake(names):
    """The job of a script of a Snakefile, which Snakemake puts among the `names` of the script; without, the script
    says what starts it."""
    if "snakemake" in names:
        return names["snakemake"]
    folder = Path(names["__file__"]).resolve().parent.name
    sys.exit(f"{Path(names['__file__']).name} is a part of a Snakefile, no command: snakemake --snakefile "
             f"runs/{folder}/Snakefile runs the study.")


def finder(top):
    """A function that finds a file from where the user stands, else below `top`; of no file it gives the path as it
    is."""
    def found_from_here(path):
        return str(Path(top) / path) if not Path(path).exists() and (Path(top) / path).exists() else str(path)

    return found_from_here
