"""Repeats a `slide` run with other options, each repetition in a folder of its own, once: what was run before is kept.

The options are those of the run's run.yaml; fields and statistics are left out, as trials are only measured.
"""

import shlex
from pathlib import Path

from slipscale.measuring.distance import spectrum_distance
from slipscale.measuring.regime import friction_spectrum, measures
from slipscale.mistakes import Mistake
from slipscale.reading import Summary, UnreadableRun, read_yaml
from slipscale.reading.yaml_file import load
from slipscale.running.attempt import attempt
from slipscale.running.commands import words

LEFT_OUT = ("run", "output_folder", "fields_", "statistics_", "progress", "contact_every", "contact_interval")
SELDOM = 10**7  # steps between rows of contact.h5: none but the first
OVERRULES = {"friction_time": ("friction_length",), "friction_length": ("friction_time",),
             "friction_rate": ("friction_time",)}
LAWS = {"slip": (), "surface": ("friction_rate_reference",)}  # options that a rate has no use for


def options_of(folder):
    """The options of a run that make it the same again, as a dict. Raises UnreadableRun."""
    options = Summary(folder).options
    if "mesh_file" not in options:
        raise UnreadableRun(f"{Path(folder) / 'run.yaml'} does not say which mesh was run: is this a folder of "
                            "`slide`?")
    kept = {name: value for name, value in options.items() if not name.startswith(LEFT_OUT)}
    return {name: found_file(value, folder) if name.endswith("_file") else value for name, value in kept.items()}


def found_file(path, folder):
    """An absolute path: of the file from here, else as it is named from a folder above the run's, from which it was
    started. Raises UnreadableRun when there is none."""
    places = [Path(path), *(parent / path for parent in Path(folder).resolve().parents)]
    if found := next((place for place in places if place.is_file()), None):
        return str(found.resolve())
    raise UnreadableRun(f"{Path(folder) / 'run.yaml'} names {path}, which is neither here nor in a folder above the "
                        "run: start from where the run was started, or put it back.")


def changed(options, changes):
    """`options` with `changes`, without what they overrule: a relaxation time and a length cannot stand together."""
    gone = {other for name in changes for other in OVERRULES.get(name, ())}
    gone |= set(LAWS.get(changes.get("friction_rate"), ()))
    return {**{name: value for name, value in options.items() if name not in gone or name in changes}, **changes}


def spelled_out(options):
    """`options` with the stiffness and density that an effective.yaml gives to all regions in place of its name."""
    if "material_file" not in options:
        return options
    found = read_yaml(Path(options["material_file"]))
    return {**{name: value for name, value in options.items() if name != "material_file"},
            "material_all_stiffness": found["stiffness"], "material_all_density": found["density"]}


def value_of(options, parameter):
    """A number among the options; the relaxation time may stand there as the length L* = T |V|. Raises
    UnreadableRun."""
    try:
        if parameter == "friction_time" and "friction_time" not in options:
            return float(options["friction_length"]) / abs(float(options["surface_speed"]))
        return float(options[parameter])
    except (KeyError, TypeError, ValueError, ZeroDivisionError) as error:
        raise UnreadableRun(f"the homogeneous run has no number {parameter}: name another parameter, or set "
                            "it.") from error


class Trials:
    """Runs of `program` (a list of words) with `options` in folders below `output`, each compared over `window` (s)
    with `reference`, a spectrum as of `regime.friction_spectrum`."""

    def __init__(self, program, options, output, window, reference):
        self.program, self.options, self.output = program, options, Path(output)
        self.window, self.reference = window, reference
        self.done = []  # dicts, in the order in which they were asked for

    def run(self, **changes):
        """What `compared` gives, with the changes and `status`, ok or failed with its `reason`."""
        name = "_".join(f"{key}_{value:.6g}" if isinstance(value, float) else f"{key}_{value}"
                        for key, value in changes.items())
        folder = self.output / name
        options = {**changed(self.options, changes), "contact_every": SELDOM, "output_folder": folder}
        command = [*self.program, *shlex.split(words(options))]
        outcome = self.outcome(folder, command) or attempt(folder / "outcome.yaml", command, changes,
                                                              restart=self.program[-1])
        found = {**changes, "folder": str(folder), "status": outcome["status"], "reason": outcome["reason"]}
        if outcome["status"] == "ok":
            try:
                found.update(compared(folder, self.window, self.reference))
            except UnreadableRun as error:
                found.update(status="failed", reason=str(error))
        if found not in self.done:
            self.done.append(found)
        return found

    @staticmethod
    def outcome(folder, command):
        """That of the same command, run before; or None."""
        try:
            known = load(folder / "outcome.yaml", written=True)
            return known if known["command"] == shlex.join(command) else None
        except (Mistake, TypeError, KeyError):
            return None


def compared(folder, window, reference):
    """The measures of a run and `spectrum_distance` from `reference`."""
    return {**measures(folder, window), "spectrum_distance": spectrum_distance(friction_spectrum(folder, window),
                                                                              reference)}
