"""Finds the regularisation time with which a homogeneous model rubs as the composite does.

    slipscale adapt HETEROGENEOUS HOMOGENEOUS --output FOLDER [--level scaling|frequency|search|modes]
        [--program "mpirun -n 2 slide"] [--match power|friction|frequency|amplitude] [--window FROM TO]

Both are folders of `slide`; the homogeneous run is repeated with its run.yaml. The levels, the first three by default:

    scaling    T such that ωT is that of the heterogeneous run, ω the dominant frequency of friction
    frequency  T such that at the frequency through which most passes, the homogeneous surface moving and being
               pressed as it does, the power of the heterogeneous run passes (slipscale.adapting.relaxation); takes
               contact.h5 of both runs
    search     T at which the power into the body is that of the heterogeneous run: a scan, then false position.
               Where power is flat or not monotone over the scan, or never equal, mean friction is matched in its
               place, else the frequency; --match asks for one of them, whatever the scan looks like
    modes      T with which the growing modes of steady sliding have growth and frequency of the heterogeneous block's,
               from `modes` on the scenes of both runs, without their histories; --free names what else may change with
               it: --free friction_coefficient material_all_density damping_stiffness

`search` adapts any other number with --parameter, as friction_coefficient or damping_stiffness. --set option=value
changes the homogeneous model before: --set friction_rate=slip friction_rate_reference=0.2 --parameter friction_length
--start 1e-6. HOMOGENEOUS may be the FOLDER of an adaptation before, to adapt one number after the other.

FOLDER/adapt.yaml has the measures of both runs, the value and the distances of each level, before and after, the scan,
and one sentence of why a level failed. Trials that were run are kept in FOLDER/trials and not run again. Exit code 0:
a level came nearer in its spectrum of friction, and nearer than a block that does not vibrate, whose distance is 1;
1: none did, honestly; 2: what is asked for cannot be read.
"""

import math
import shlex
from pathlib import Path

import numpy as np
import yaml

from slipscale.adapting import mode_match, relaxation, search
from slipscale.adapting.mode_trials import ModeTrials, compared as modes_compared
from slipscale.adapting.trials import Trials, changed, compared, options_of, spelled_out, value_of
from slipscale.measuring.regime import friction_spectrum, measures
from slipscale.measuring.surface_motion import surface_motion
from slipscale.measuring.window import cut_away, default_window, unfinished
from slipscale.parser import Parser, Window
from slipscale.reading import History, Summary, UnreadableRun
from slipscale.reading.yaml_file import load
from slipscale.running import programs
from slipscale.running.attempt import number_or_text, write_whole

LEVELS = ("scaling", "frequency", "search", "modes")
BY_DEFAULT = LEVELS[:3]
SCAN = (1.0, 0.25, 0.5, 2.0, 4.0)  # of the relaxation time, of the level of modes
MATCHES = {"power": "power_into_body", "friction": "friction", "frequency": "frequency", "amplitude": "amplitude"}
IN_TURN = ("power", "friction", "frequency")
SHARES = ("stick", "slip", "open")
TOLERANCE = 0.02  # of the target: what counts as equal
AT_REST = 0.9  # distance of a spectrum from which on the model is hardly nearer than a block that does not vibrate, 1


class Failure(Exception):
    """Why a level has no answer, in one sentence."""


class Adaptation:
    def __init__(self, heterogeneous, homogeneous, asked):
        self.asked, self.folders = asked, {"heterogeneous": heterogeneous, "homogeneous": homogeneous}
        times = {name: History(folder).time for name, folder in self.folders.items()}
        self.window = tuple(asked.window or default_window(min(times.values(), key=lambda time: time[-1])))
        self.notes = [f"the {name} run: {note}" for name, time in times.items() for note in
                      (cut_away(time, self.window), unfinished(Summary(self.folders[name]), time[-1])) if note]
        spectrum = friction_spectrum(heterogeneous, self.window)
        self.target = measures(heterogeneous, self.window)
        self.own = {"folder": str(homogeneous), **compared(homogeneous, self.window, spectrum)}
        options = options_of(homogeneous)
        of_material = any(name.startswith("material_all_") for name in (asked.parameter, *asked.set, *asked.free))
        self.options = changed(spelled_out(options) if of_material else options, asked.set)
        self.start = asked.start or value_of(self.options, asked.parameter)
        if not self.start > 0:
            raise UnreadableRun(f"{asked.parameter} is {self.start:g} in the homogeneous run, and a search needs a "
                                "value above zero: give --start.")
        self.same = self.options == options and self.start == value_of(options, asked.parameter)
        self.trials = Trials(asked.program, self.options, Path(asked.output) / "trials", self.window, spectrum)

    def trial(self, value):
        """What a run with this value of the parameter did; the homogeneous run is not repeated."""
        if self.same and math.isclose(value, self.start, rel_tol=1e-9):
            return {self.asked.parameter: self.start, "status": "ok", "reason": None, **self.own}
        return self.trials.run(**{self.asked.parameter: short(value)})

    # --- the levels: each gives a dict with the value, or raises Failure

    def scaling(self):
        time = value_of(options_of(self.folders["heterogeneous"]), "friction_time")
        scaled = relaxation.scaled_time(time, self.target["frequency"], self.own["frequency"])
        if not scaled:
            raise Failure("one of the runs has no frequency, or no relaxation time")
        return {"value": scaled}

    def frequency(self):
        coefficient = value_of(self.options, "friction_coefficient")
        motions = {name: surface_motion(folder, self.window) for name, folder in self.folders.items()}
        theirs, own = motions["heterogeneous"], motions["homogeneous"]
        told = {"surface": {name: {"frequency": motion.frequency, "power": motion.power,
                                   "power_at_line": motion.power_at_line, "phase": motion.phase,
                                   "strength": motion.strength(coefficient),
                                   "time_seen": relaxation.time_of_one_frequency(
                                       motion.omega, motion.power_at_line, motion.strength(coefficient), motion.phase)}
                            for name, motion in motions.items()}}
        time = relaxation.time_of_one_frequency(own.omega, theirs.power_at_line, own.strength(coefficient), own.phase)
        if time is None:
            most, least = relaxation.most_power_of_one_frequency(own.strength(coefficient), own.phase)
            raise Failure(f"no root: {theirs.power_at_line:.4g} W/m² pass into the composite at {theirs.frequency:.4g} "
                          f"Hz, into the homogeneous surface at {own.frequency:.4g} Hz no more than {most:.4g} and no "
                          f"less than {least:.4g} at any T", told)
        return {"value": time, **told}

    def search(self):
        values = search.scan_values(self.start, self.asked.factor, self.asked.points)
        rows = [self.trial(value) for value in values]
        if not any(row["status"] == "ok" for row in rows):
            raise Failure(f"no run of the scan came to its end: {rows[0]['reason']}")
        told = {"scan": [{name: row.get(name) for name in (self.asked.parameter, *MATCHES.values(), *SHARES,
                                                           "spectrum_distance", "status", "reason")} for row in rows]}
        seen = {}
        for name in [self.asked.match] if self.asked.match else IN_TURN:
            found = np.array([row.get(MATCHES[name], np.nan) for row in rows], dtype=float)
            seen[name] = search.judge(values, found, self.target[MATCHES[name]]), found
        told["judged"] = {name: said(scan) for name, (scan, _) in seen.items()}
        usable = [name for name, (scan, _) in seen.items() if scan.monotone and not scan.flat and scan.brackets]
        bracketed = [name for name, (scan, _) in seen.items() if scan.brackets]
        if not bracketed:
            raise Failure("not bracketed: " + "; ".join(
                f"{name} {self.target[MATCHES[name]]:.4g} lies outside {scan.lowest:.4g} to {scan.highest:.4g}"
                for name, (scan, _) in seen.items()), told)
        match = (usable or bracketed)[0]
        return {**self.refined(match, values, *seen[match]), **told}

    def modes(self):
        words, highest = self.asked.modes_program, self.asked.modes_to
        folder = Path(self.asked.output) / "modes"
        composite = ModeTrials(words, options_of(self.folders["heterogeneous"]), folder / "heterogeneous", highest).run()
        if not composite.growing:
            raise Failure(f"no mode of the heterogeneous block grows up to {highest:.4g} Hz, so that there is nothing to "
                          "match: see its modes.yaml, or give a higher --modes-to")
        block = ModeTrials(words, self.options, folder / "homogeneous", highest)
        before, _ = modes_compared(composite, block.run())

        def evaluate(changes):
            try:
                return modes_compared(composite, block.run(**{name: short(value) for name, value in changes.items()}))[0]
            except UnreadableRun:
                return math.inf

        start = {name: value_of(self.options, name) for name in ("friction_time", *self.asked.free)}
        changes, after = mode_match.nearest(evaluate, start, SCAN, self.asked.most_modes)
        changes = {name: short(value) for name, value in changes.items()}
        if not after < before:
            raise Failure(f"modes are not nearer: their misfit is {before:.3g} and no less with any T that was tried",
                          {"misfit_before": before})
        return {"value": changes["friction_time"], "changes": changes, "misfit_before": before, "misfit_after": after,
                "modes_runs": 1 + block.done,
                "paired": modes_compared(composite, block.run(**changes))[1]}

    def refined(self, match, values, scan, found):
        """Of several brackets that whose ends come nearest in spectrum: equal power alone does not tell them apart."""
        quantity, target = MATCHES[match], self.target[MATCHES[match]]
        bracket = min(scan.brackets, key=lambda pair: sum(self.trial(end)["spectrum_distance"] for end in pair))
        ends = [self.trial(end)[quantity] for end in bracket]
        value = search.refine(lambda value: self.trial(value).get(quantity), target, bracket, ends,
                              0.5 * TOLERANCE, self.asked.most)
        reached = self.trial(value)[quantity]
        if abs(reached - target) > TOLERANCE * abs(target):
            raise Failure(f"{match} jumps: it is {ends[0]:.4g} at {bracket[0]:.4g} and {ends[1]:.4g} at "
                          f"{bracket[1]:.4g}, "
                          f"and came no nearer to {target:.4g} than {reached:.4g}, at {value:.4g}", {"match": match})
        return {"value": value, "match": match, "matched": reached, "crossings": len(scan.brackets)}

    # --- what is said about them

    def level(self, name):
        try:
            found = getattr(self, name)()
        except Failure as failure:
            return {"status": "failed", "reason": failure.args[0], **(failure.args[1] if len(failure.args) > 1 else {})}
        except UnreadableRun as error:
            return {"status": "failed", "reason": str(error)}
        after = self.trials.run(**found["changes"]) if "changes" in found else self.trial(found["value"])
        if after["status"] != "ok":
            return {"status": "failed", "reason": after["reason"], **found}
        reason = not_adapted(self.own["spectrum_distance"], after["spectrum_distance"], found["value"])
        return {"status": "failed" if reason else "ok", "reason": reason, **found, "after": self.distances(after)}

    def distances(self, row):
        """Of a homogeneous run from the heterogeneous one: of the spectrum, relative differences, those of shares."""
        return {"folder": row["folder"], "spectrum_distance": row["spectrum_distance"],
                **{name: row[quantity] / self.target[quantity] - 1 if self.target[quantity] else None
                   for name, quantity in MATCHES.items()},
                **{name: row[name] - self.target[name] for name in SHARES}}

    def report(self):
        levels = {name: self.level(name) for name in self.asked.levels}
        tried = [row for row in (*self.trials.done, *([self.trial(self.start)] if self.same else []))
                 if row["status"] == "ok"]
        nearest = min(tried, key=lambda row: row["spectrum_distance"], default=None)
        value_nearest = nearest and nearest.get(self.asked.parameter, self.start)
        good = [name for name, found in levels.items() if found["status"] == "ok"]
        best = min(good, key=lambda name: levels[name]["after"]["spectrum_distance"], default=None)
        return {"parameter": self.asked.parameter, "set": self.asked.set, "window": list(self.window), "notes": self.notes,
                "start": self.start, "heterogeneous": self.target, "homogeneous": self.own,
                "before": self.distances(self.own), "levels": levels,
                "nearest": nearest and {"value": value_nearest, **self.distances(nearest)},
                "trials": len(self.trials.done), "status": "ok" if best else "failed", "best": best,
                "reason": None if best else "; ".join(f"{name}: {found['reason']}" for name, found in levels.items())}


def short(value):
    """As a folder's name and an option have it."""
    return float(f"{value:.6g}")


def not_adapted(before, after, value):
    """Why a model whose spectrum was `before` and is `after` away does not count as adapted, or None."""
    if after >= before:
        return f"the spectrum is not nearer: {before:.3g} before, {after:.3g} with {value:.4g}"
    if after >= AT_REST:
        return (f"the spectrum is nearer, {before:.3g} before and {after:.3g} with {value:.4g}, but no nearer than "
                "that of a block at rest, 1")
    return None


def adapted_before(folder):
    """The run that an adaptation in `folder` left: of its levels' that which came nearest, else of its trials; `folder`
    itself if there was none."""
    file = Path(folder) / "adapt.yaml"
    if not file.is_file():
        return folder
    found = load(file, written=True)
    ends = [level["after"] for level in found["levels"].values() if "after" in level]
    ends = ends or [found["nearest"] or found["before"]]
    return min(ends, key=lambda end: end["spectrum_distance"])["folder"]


def said(scan):
    return {"flat": scan.flat, "monotone": scan.monotone, "lowest": scan.lowest, "highest": scan.highest,
            "brackets": [list(pair) for pair in scan.brackets]}


def plain(value):
    """Numbers of numpy as Python's, for YAML."""
    if isinstance(value, dict):
        return {name: plain(inner) for name, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(inner) for inner in value]
    return value.item() if isinstance(value, np.generic) else value


def parsed(arguments):
    parser = Parser("adapt", __doc__)
    parser.add_argument("heterogeneous")
    parser.add_argument("homogeneous")
    parser.add_argument("--output", required=True, help="folder of adapt.yaml and the trials")
    parser.add_argument("--level", dest="levels", nargs="+", choices=LEVELS, help="default: the first three; of another "
                        "parameter than friction_time only search")
    parser.add_argument("--program", help="words before the options, as 'mpirun -n 2 …' (default: the slide beside "
                                          "this command)")
    parser.add_argument("--match", choices=tuple(MATCHES))
    parser.add_argument("--window", action=Window, metavar=("FROM", "TO"), help="s; default: the second half")
    parser.add_argument("--parameter", default="friction_time", help="option of slide that is adapted")
    parser.add_argument("--set", nargs="+", default=[], metavar="OPTION=VALUE", help="other changes to the model")
    parser.add_argument("--start", type=float, help="middle of the scan; default: what the homogeneous run has")
    parser.add_argument("--factor", type=float, default=2.0, help="between values of the scan")
    parser.add_argument("--points", type=int, default=7, help="of the scan")
    parser.add_argument("--most", type=int, default=10, help="trials after the scan")
    parser.add_argument("--free", nargs="+", default=[], metavar="OPTION", help="numbers that the level of modes may change "
                        "besides friction_time")
    parser.add_argument("--modes-to", type=float, default=1e6, help="Hz, highest frequency of modes (default: 1e6)")
    parser.add_argument("--modes-program", help="words before the options (default: the modes beside this command)")
    parser.add_argument("--most-modes", type=int, default=40, help="runs of modes after their scan")
    asked = parser.parse_args(arguments)
    asked.program = programs.words_of(asked.program or shlex.quote(str(programs.program("slide"))))
    if "modes" in (asked.levels or ()):
        asked.modes_program = programs.words_of(asked.modes_program or shlex.quote(str(programs.program("modes"))))
    asked.set = {name: number_or_text(value) for name, _, value in (word.partition("=") for word in asked.set)}
    asked.levels = asked.levels or (BY_DEFAULT if asked.parameter == "friction_time" else ("search",))
    if asked.parameter != "friction_time" and set(asked.levels) != {"search"}:
        parser.error(f"scaling, frequency and modes speak of friction_time only, {asked.parameter} can be searched for")
    return asked


def main(arguments=None):
    asked = parsed(arguments)
    found = Adaptation(asked.heterogeneous, adapted_before(asked.homogeneous), asked).report()
    Path(asked.output).mkdir(parents=True, exist_ok=True)
    write_whole(Path(asked.output) / "adapt.yaml", yaml.safe_dump(plain(found), sort_keys=False, width=1000,
                                                                  allow_unicode=True))
    for note in found["notes"]:
        print(f"note: {note}")
    for name, level in found["levels"].items():
        print(f"{name}: " + (level["reason"] or f"{asked.parameter} {level['value']:.6g}, distance of the spectrum "
              f"{found['before']['spectrum_distance']:.3g} -> {level['after']['spectrum_distance']:.3g}"))
    if found["status"] != "ok":
        print(f"not adapted: {found['reason']}")
    return 0 if found["status"] == "ok" else 1
