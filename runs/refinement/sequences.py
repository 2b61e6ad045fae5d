"""Sequences of runs that differ in the size of the elements, the time step, or both: what a refinement study is made
of.

A sequence is a dict of these entries (runs/refinement/study.yaml spells several out):

    name                       of the sequence
    scene, family, variants    names; families and variants may be several, each is refined by itself
    size                       of the elements in m, one or several
    step                       time step in s, one or several, or auto; or step_per_size in s/m, in place of it
    reference                  dict of what the reference run has instead of the finest run's (family, size, …); without
                               it the finest run itself is the reference
    window                     two times in s
    trajectories               SIGNALS that are compared with the reference's, time by time
    distances                  spectrum, portrait: whole cycles compared with the reference's
    averages                   names of `regime.MEASURES`
    known                      dict of exact values of averages
    point, parts               probe point (0), and parts of the window whose scatter is the error of an average (4)
    portraits                  dict: variants, size or step (those to draw) and window
"""

import re
from dataclasses import dataclass, field
from itertools import product

OPTIONS = ("scene", "family", "variant", "size", "step")  # of a run
ENTRIES = ("name", "scene", "family", "variants", "size", "step", "step_per_size", "reference", "window",
           "trajectories", "distances", "averages", "known", "point", "parts", "portraits")
SEVERAL = ("family", "variants", "trajectories", "distances", "averages")
NAME = re.compile(r"[\w.+-]+")  # of a file
SAME = 1e-6  # relative: sizes and steps that are closer are equal


@dataclass
class Chain:
    """One variant of a sequence on one family of meshes: its runs (dicts of OPTIONS) from coarse to fine, `along` size
    or step; and the run that is the reference, one of them or another. `variant` is what it is called: by its family
    where the sequence has several, by both where it has several of both."""

    name: str
    variant: str
    along: str
    runs: list
    reference: dict
    entries: dict = field(default_factory=dict)

    def has_own_reference(self):
        return self.reference == self.runs[-1]


def several(value):
    """A list, of one entry when it is none."""
    return list(value) if isinstance(value, (list, tuple)) else [value]


def number(value):
    """As the run's name says it: nine digits; 'auto' stays."""
    return value if value == "auto" else float(f"{float(value):.9g}")


def checked(sequence):
    """The entries with those of SEVERAL as lists. Raises ValueError in one sentence."""
    name = sequence.get("name", "without a name")
    if unknown := sequence.keys() - set(ENTRIES):
        raise ValueError(f"sequence {name}: unknown entry {sorted(unknown)[0]!r}; known are {', '.join(ENTRIES)}")
    if missing := [each for each in ("name", "scene", "family", "variants", "size", "window") if each not in sequence]:
        raise ValueError(f"sequence {name}: it lacks {missing[0]}")
    if ("step" in sequence) == ("step_per_size" in sequence):
        raise ValueError(f"sequence {name}: give step or step_per_size")
    lists = {each: several(sequence.get(each, [])) for each in SEVERAL}
    for word in (name, sequence["scene"], *lists["family"], *lists["variants"]):
        if not NAME.fullmatch(str(word)):
            raise ValueError(f"sequence {name}: {word!r} names files: use letters, digits, and . + - _")
    return {**sequence, **lists, "window": [float(time) for time in sequence["window"]]}


def steps_of(sequence, sizes):
    """A step for every size."""
    if "step_per_size" in sequence:
        return [number(float(sequence["step_per_size"]) * size) for size in sizes]
    steps = [number(step) for step in several(sequence["step"])]
    return steps * len(sizes) if len(steps) == 1 else steps


def pairs_of(sequence):
    """What is varied, 'size' or 'step', and pairs of size and step from coarse to fine."""
    sizes = [number(size) for size in several(sequence["size"])]
    steps = steps_of(sequence, sizes)
    along = "step" if len(sizes) == 1 and len(steps) > 1 else "size"
    sizes = sizes * len(steps) if along == "step" else sizes
    if len(sizes) != len(steps):
        raise ValueError(f"sequence {sequence['name']}: {len(steps)} steps do not go with {len(sizes)} sizes")
    pairs = sorted(zip(sizes, steps), key=lambda pair: pair[along == "step"], reverse=True)
    varied = [pair[along == "step"] for pair in pairs]
    if any(fine > coarse * (1 - SAME) for coarse, fine in zip(varied, varied[1:])):
        raise ValueError(f"sequence {sequence['name']}: a {along} stands there twice")
    return along, pairs


def chains(sequences):
    """The chains of all sequences (a list of dicts), in their order."""
    found = []
    for sequence in map(checked, sequences):
        along, pairs = pairs_of(sequence)
        for family, variant in product(sequence["family"], sequence["variants"]):
            runs = [{"scene": sequence["scene"], "family": family, "variant": variant, "size": size, "step": step}
                    for size, step in pairs]
            found.append(Chain(sequence["name"], called(sequence, family, variant), along, runs,
                               reference_of(sequence, runs[-1]), sequence))
    return found


def called(sequence, family, variant):
    """What tells a chain from the others of its sequence."""
    if len(sequence["family"]) == 1:
        return variant
    return family if len(sequence["variants"]) == 1 else f"{family}-{variant}"


def reference_of(sequence, finest):
    """The run that is the truth; its step follows its size unless it is given."""
    given = dict(sequence.get("reference") or {})
    if unknown := given.keys() - set(OPTIONS):
        raise ValueError(f"sequence {sequence['name']}: unknown entry {sorted(unknown)[0]!r} in its reference; known "
                         f"are {', '.join(OPTIONS)}")
    given.update({name: number(given[name]) for name in ("size", "step") if name in given})
    if "size" in given and "step" not in given and "step_per_size" in sequence:
        given["step"] = steps_of(sequence, [given["size"]])[0]
    return {**finest, **given}


if __name__ == "__main__":
    raise SystemExit("refinement.sequences is a library, no command: snakemake --snakefile runs/refinement/Snakefile "
                     "runs the study.")
