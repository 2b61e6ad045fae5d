"""What a sweep runs: values spelled out, combined, and checked against the programs' manuals before anything runs.

Values of an option, in study.yaml or on a command line:
    0.1:0.1:0.8    from start by step to stop, which is included if it is met to rounding
    1:*2:16        from start by a factor
    1,2,5:5:20     several of these; in YAML also a list
    [0,-1]         one value that is itself a list; [0,-1],[0,-2] are two
For options that always take a list (numbers separated by commas, says the manual) commas do not make several values:
initial_velocity 0,-1 is one. Mistakes raise `Mistake`, in one sentence.
"""

import difflib
import re
import subprocess
from decimal import Decimal, InvalidOperation
from pathlib import Path

from slipscale.mistakes import Mistake
from slipscale.running.attempt import number_or_text
from slipscale.running.commands import word
from slipscale.running.table import read_csv

ROUNDING = Decimal("1e-9")  # of a step
MOST_RUNS = 100000
LIST = "numbers"  # how the manual's kind of an option that takes a list begins
SET_BY_THE_STUDY = {"output_folder": "the study gives each run a folder",
                    "options_file_yaml": "put its options in `scene`"}
CONSTANTS = ("H", "L", "pi")  # that every formula knows
PETSC = ("log_view", "options_view", "options_left", "malloc_", "memory_view")


def plain(number):
    """An int where a Decimal is written as one, else a float."""
    return int(number) if number == number.to_integral_value() and number.as_tuple().exponent >= 0 else float(number)


def spelled_out(text):
    """The values of start:step:stop or start:*factor:stop, without the rounding errors of repeated sums."""
    words = text.split(":")
    try:
        if len(words) != 3:
            raise InvalidOperation
        start, step, stop = (Decimal(word.lstrip("*") if k == 1 else word) for k, word in enumerate(words))
        if not all(number.is_finite() for number in (start, step, stop)):
            raise InvalidOperation
    except InvalidOperation:
        raise Mistake(f"{text} is no range: it should be start:step:stop or start:*factor:stop, in numbers.") from None
    if words[1].startswith("*"):
        return multiplied(text, start, step, stop)
    if step == 0 and start != stop:
        raise Mistake(f"{text} never ends: its step is 0.")
    if step != 0 and (stop - start) / step < 0:
        raise Mistake(f"{text} is empty: from {words[0]} a step of {words[1]} leads away from {words[2]}.")
    count = int((stop - start) / step + ROUNDING) + 1 if step else 1
    if count > MOST_RUNS:
        raise Mistake(f"{text} has {count} values; {MOST_RUNS} is the most.")
    whole = all(isinstance(plain(number), int) for number in (start, step))
    return [int(value) if whole else float(value) for value in (start + k * step for k in range(count))]


def multiplied(text, start, factor, stop):
    if factor <= 0 or factor == 1 or start == 0 or stop / start <= 0 or (stop / start - 1) * (factor - 1) < 0:
        raise Mistake(f"{text} is empty or never ends: from its start its factor should lead to its stop.")
    values, value = [], start
    while (value / stop - 1) * (1 if factor > 1 else -1) <= ROUNDING and len(values) <= MOST_RUNS:
        values.append(plain(value.normalize()) if isinstance(plain(start), int) else float(value))
        value *= factor
    return values


def split(text):
    """The parts between commas outside of brackets."""
    parts, depth = [""], 0
    for letter in text:
        depth += (letter == "[") - (letter == "]")
        if letter == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
        if not 0 <= depth <= 1:
            break
    if depth != 0 or any(not part.strip() for part in parts):
        raise Mistake(f"{text!r} is no list of values: one is empty, or a bracket is left open.")
    return [part.strip() for part in parts]


def parsed(text):
    """One value or range of a command line, as a list of values."""
    if text.startswith("["):
        if not text.endswith("]"):
            raise Mistake(f"{text!r} is no value: a comma is missing behind the bracket.")
        return [[number_or_text(part) for part in split(text[1:-1])]]
    if re.fullmatch(r"[-+.\deE]+:[-+*.\deE]+(:[-+.\deE]+)*", text):
        return spelled_out(text)
    return [number_or_text(text)]


def values_of(given, takes_list=False):
    """All values of an option, a list; `given` is a text of a command line or what YAML gives."""
    if isinstance(given, str):
        if takes_list and not given.strip().startswith("["):
            return [[number_or_text(part) for part in split(given)]]
        return [value for part in split(given) for value in parsed(part)]
    if isinstance(given, list):
        if takes_list and not any(isinstance(value, (list, str)) for value in given):
            return [given] if given else []
        return [value for entry in given for value in ([entry] if isinstance(entry, list) else values_of(entry))]
    if given is None or isinstance(given, dict):
        raise Mistake(f"{given!r} is no value of an option: names of options are written out, as friction_coefficient.")
    return [given]


def manual(program):
    """The options in `PROGRAM -help`: a dict of kinds (a number > 0 (m), …) by name, which may hold a <region>."""
    try:
        said = subprocess.run([str(program), "-help"], capture_output=True, text=True, timeout=60)
    except (OSError, subprocess.TimeoutExpired) as error:
        raise Mistake(f"{program} cannot be asked for its options ({error}): is it built?") from error
    return options_in(said.stdout)


def options_in(text):
    return dict(re.findall(r"^  -(\S+)  (.*?)(?:; .*)?$", text, re.MULTILINE))


def kind_of(name, options):
    """The kind of an option in a manual, also of one whose name holds a region or a boundary; None when unknown."""
    if name in options:
        return options[name]
    for pattern, kind in options.items():
        if re.fullmatch(re.sub(r"<\w+>", r"\\w+", pattern), name):
            return kind
    return None


def owner(name, manuals):
    """The first program that knows an option; `manuals`, a dict of manuals by program, stand in the order in which they
    are asked."""
    for program, options in manuals.items():
        if kind_of(name, options) is not None:
            return program
    if name.startswith(PETSC):
        return "slide"
    near = difflib.get_close_matches(name, [known for options in manuals.values() for known in options], 1, 0.75)
    raise Mistake(f"None of {', '.join(manuals)} has an option -{name}" + (f"; is -{near[0]} meant?" if near else "."))


def takes_list(name, manuals):
    return any((kind_of(name, options) or "").startswith(LIST) for options in manuals.values())


def parameters_in(options):
    """Names that the formulas of flat options may hold."""
    return {name.removeprefix("parameters_") for name in options if name.startswith("parameters_")}


def may_be_formula(text, kind, parameters):
    """Whether a text is more than a word that no formula of this kind knows; the programs read the rest."""
    found = re.search(r"formula of ([\w, ]+)", kind)
    known = {*CONSTANTS, *parameters, *(re.findall(r"\w+", found[1]) if found else ())}
    return bool(found) and (not re.fullmatch(r"[^\W\d]\w*", text) or text in known)


def check(name, value, manuals, parameters=()):
    """Raises Mistake for a value that every run would refuse; `parameters`: names that formulas may hold."""
    if name in SET_BY_THE_STUDY:
        raise Mistake(f"-{name} cannot be set: {SET_BY_THE_STUDY[name]}.")
    kind = kind_of(name, manuals[owner(name, manuals)]) or ""
    if kind.startswith(("a number", "a whole number")) and not isinstance(number_or_text(word(value)), (int, float)) and \
            not may_be_formula(word(value), kind, parameters):
        raise Mistake(f"-{name} {word(value)} is not {kind}.")


def combinations(sweep, rows, manuals, parameters=()):
    """The options varied in each run, a list of dicts: all combinations of the dict `sweep`, then the `rows` (a list of
    dicts, or a CSV file). An option that is null is left out of the sweep; a row may lack options."""
    sweep = {name: values_of(given, takes_list(name, manuals)) for name, given in (sweep or {}).items()
             if given is not None}
    if empty := [name for name, values in sweep.items() if not values]:
        raise Mistake(f"-{empty[0]} is to be varied over no value.")
    if isinstance(rows, str):
        if not Path(rows).is_file():
            raise Mistake(f"There is no {rows}, a file of combinations to run.")
        rows = read_csv(rows)
    rows = rows or []
    if not all(isinstance(row, dict) for row in rows):
        raise Mistake("`list` should hold one set of options for each run, as - {surface_speed: 2, time_beta2: 0.6}.")
    runs = [dict(zip(sweep, chosen)) for chosen in products(sweep)] if sweep or not rows else []
    runs += [{name: row[name] for name in row if row[name] is not None} for row in rows]
    for run in runs:
        for name, value in run.items():
            check(name, value, manuals, parameters)
    return runs


def products(values):
    """All combinations, tuples, of a dict of lists of values; the last varies first."""
    chosen = [()]
    for several in values.values():
        chosen = [(*before, value) for before in chosen for value in several]
        if len(chosen) > MOST_RUNS:
            raise Mistake(f"The sweep has more than {MOST_RUNS} runs.")
    return chosen


def name_of(options):
    """A folder's name for the options of a run, without what a path, a shell or snakemake's lists of wildcards could
    misread."""
    said = "-".join(f"{name}_{word(value)}" for name, value in options.items())
    return re.sub(r"[^\w.+-]", "-", said) or "only"


def named(runs):
    """The runs by name; equal runs are there once."""
    found = {}
    for options in runs:
        name = name_of(options)
        if name in found and found[name] != options:
            name += f"-{len(found)}"
        found[name] = options
    return found
