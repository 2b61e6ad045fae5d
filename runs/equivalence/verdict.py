"""Whether a homogenised block behaves as the composites it stands for: whether it lies within their scatter.

The criterion, for any measure: each morphology has a distance to the mean of the other morphologies, and the largest of
these is the scatter. A homogenised block has a distance to the mean of all morphologies. It is within the scatter when
that is no larger, or too small to be told from nothing (FLOORS). Where each morphology has a homogenised block of its
own, the one in the middle (the median) decides.

The verdict on a point of a map is that of the spectrum of friction: `verdict`.
"""

from dataclasses import dataclass

import numpy as np

from slipscale.measuring.distance import mean_spectrum, portrait_distance, spectrum_distance
from slipscale.measuring.regime import friction_spectrum, measures, rows_of
from slipscale.reading import History, UnreadableRun

SCALARS = ("friction", "frequency", "amplitude", "stick", "open", "velocity", "power_ratio")
FLOORS = {  # as much as a run differs from itself in another window of its limit cycle; in units of the measure
    "spectrum": 0.05, "portrait": 0.05, "friction": 0.005, "frequency": 1e3, "amplitude": 0.01, "stick": 0.005,
    "open": 0.005, "velocity": 0.02, "power_ratio": 0.005}
STILL = 0.01  # amplitude (1) of friction below which nothing vibrates
ALIKE = 0.5  # scatter of the spectra above which morphologies are not alike, so that no block stands for them
COMPARABLE = 1 / 3  # height of a second peak of √density, of the first, from which on it counts as a mode
NEAR = 0.05  # of a frequency: within it two are the same

EQUIVALENT, STABLE, UNSETTLED, ONE_ONLY, COMPETE, FREQUENCY, AMPLITUDE, UNLIKE = VERDICTS = (
    "equivalent", "nothing vibrates", "not settled", "only one vibrates", "modes compete", "frequency differs",
    "amplitude differs", "morphologies differ")


@dataclass
class Run:
    """What is compared of a run in one window: spectrum, a pair (Hz, 1/√Hz) of arrays [n]; portrait, [2, n], u in m and
    v in m/s; values, those of `regime.measures`."""

    spectrum: tuple
    portrait: np.ndarray
    values: dict

    @property
    def vibrates(self):
        return self.values["amplitude"] > STILL


def read_run(folder, window, point=0):
    """The Run in `folder` over `window` (s). Raises UnreadableRun."""
    history = History(folder)
    if point >= len(history.points):
        raise UnreadableRun(f"{folder} recorded no probe point {point}: name one with -history_points.")
    rows = rows_of(history, window)
    probe = history.points[point]
    return Run(friction_spectrum(folder, window), np.array([probe.u[rows, 0], probe.v[rows, 0]]),
               measures(folder, window, point))


@dataclass
class Judged:
    """Distances [n] of the morphologies to the mean of the others and [m] of homogenised blocks to the mean of all."""

    measure: str
    composites: list
    homogenised: list

    @property
    def scatter(self):
        return float(max(self.composites))

    @property
    def typical(self):
        """Of the homogenised blocks."""
        return float(np.median(self.homogenised))

    @property
    def limit(self):
        return max(self.scatter, FLOORS[self.measure])

    @property
    def within(self):
        return self.typical <= self.limit


def judge(measure, composites, homogenised):
    """Judged, of two lists of Run: `spectrum`, `portrait` or one of SCALARS. Two morphologies are the least."""
    if len(composites) < 2 or not homogenised:
        raise ValueError("a scatter needs two morphologies, and a homogenised block to compare with it")
    item, mean, distance = {
        "spectrum": (lambda run: run.spectrum, mean_spectrum, spectrum_distance),
        "portrait": (lambda run: run.portrait, np.hstack, portrait_distance),
    }.get(measure, (lambda run: run.values[measure], np.mean, lambda one, other: float(abs(one - other))))
    items = [item(run) for run in composites]
    among = [distance(each, mean(items[:k] + items[k + 1:])) for k, each in enumerate(items)]
    return Judged(measure, among, [distance(item(run), mean(items)) for run in homogenised])


def modes(spectrum, lowest=3):
    """Frequencies (Hz), strongest first, of the peaks of √density that are at least COMPARABLE to the highest and no
    multiples, to one bin, of a lower one of them. Bins below `lowest` are drift."""
    frequency, height = spectrum
    inner = np.arange(max(lowest, 1), len(height) - 1)
    peaks = inner[(height[inner] >= height[inner - 1]) & (height[inner] > height[inner + 1])]
    if not len(peaks):
        return []
    peaks = peaks[height[peaks] >= COMPARABLE * height[peaks].max()]
    kept, step = [], frequency[1]
    for peak in peaks:  # from low to high
        at = centre_of(frequency, height, peak)
        if not any(abs(at - round(at / low) * low) <= step and round(at / low) > 1 for low, _ in kept):
            kept.append((at, height[peak]))
    return [at for at, _ in sorted(kept, key=lambda mode: -mode[1])]


def centre_of(frequency, height, peak):
    """Between bins, by the density of the peak and its neighbours."""
    weight = height[peak - 1:peak + 2]**2
    return float(np.average(frequency[peak - 1:peak + 2], weights=weight))


def fundamental(run):
    """Its strongest mode in Hz, nan without."""
    return next(iter(modes(run.spectrum)), float("nan"))


def same(frequencies):
    """Whether frequencies lie within NEAR of their mean."""
    return bool(np.ptp(frequencies) <= 2 * NEAR * np.mean(frequencies))


def verdict(composites, homogenised):
    """One of VERDICTS on two lists of Run. Equivalent means that the morphologies are alike (their scatter is below
    ALIKE) and the homogenised block lies within it; else the first of these reasons that applies: a run has not
    settled, by the rule of `measures` and of summary.yaml; some vibrate and others do not; a run has two modes or the
    morphologies have different ones; the block has another frequency than the morphologies; morphologies are not alike;
    its spectrum is as much apart at the same frequency."""
    runs = [*composites, *homogenised]
    settled = all(run.values["settled"] for run in runs)
    if not any(run.vibrates for run in runs):
        return STABLE if settled else UNSETTLED
    judged = judge("spectrum", composites, homogenised)
    if all(run.vibrates for run in runs) and judged.scatter <= ALIKE and judged.within:
        return EQUIVALENT
    if not settled:
        return UNSETTLED
    if not all(run.vibrates for run in runs):
        return ONE_ONLY
    own, other = ([fundamental(run) for run in side] for side in (composites, homogenised))
    if any(len(modes(run.spectrum)) > 1 for run in runs) or not same(own):
        return COMPETE
    if not same([np.mean(own), np.median(other)]):
        return FREQUENCY
    return AMPLITUDE if judged.scatter <= ALIKE else UNLIKE


def furthest_from_one(ratios):
    """Of amplitude ratios, growing or falling, that which is most."""
    return max(ratios, key=lambda ratio: abs(np.log(ratio)) if ratio > 0 else float("inf"))


def compared(composites, homogenised):
    """The columns of a study's table for one point, of two lists of Run: `verdict`; how many of each; `settled`,
    whether all are, and `amplitude_ratio`, that of the run in which it is furthest from 1; the modes in Hz as text; and
    for each measure `_apart` (of the typical homogenised block), `_limit` and `_within`, for a number also
    `_composites` (mean) and `_homogenised` (median)."""
    row = {"verdict": verdict(composites, homogenised), "composites": len(composites), "homogenised": len(homogenised),
           "settled": all(run.values["settled"] for run in (*composites, *homogenised)),
           "amplitude_ratio": furthest_from_one([run.values["amplitude_ratio"] for run in (*composites, *homogenised)])}
    for name, runs in (("composite_modes", composites), ("homogenised_modes", homogenised)):
        row[name] = "; ".join(" + ".join(f"{mode:.0f}" for mode in modes(run.spectrum)) for run in runs)
    for measure in ("spectrum", "portrait", *SCALARS):
        judged = judge(measure, composites, homogenised)
        if measure in SCALARS:
            row[f"{measure}_composites"] = float(np.mean([run.values[measure] for run in composites]))
            row[f"{measure}_homogenised"] = float(np.median([run.values[measure] for run in homogenised]))
        row.update({f"{measure}_apart": judged.typical, f"{measure}_limit": judged.limit,
                    f"{measure}_within": judged.within})
    return row


def points(rows, folders, windows):
    """Rows of a table of runs (dicts, with the options `model`, composite or homogenised, `seed` and `window`) and
    their folders give a row for each point, which is all other options, that both models were run at. `windows` are
    pairs in s by name. A point with less than two morphologies that ran has the status failed."""
    groups = {}
    for row, folder in zip(rows, folders):
        place = {name: row[name] for name in list(row)[:list(row).index("status")] if name not in ("model", "seed")}
        groups.setdefault(tuple(place.items()), []).append((row, folder))
    found = []
    for place, members in groups.items():
        models = {model: [folder for row, folder in members if row["model"] == model and row["status"] == "ok"]
                  for model in ("composite", "homogenised")}
        if {row["model"] for row, _ in members} != set(models):
            continue
        found.append({**dict(place), "status": "ok", "reason": None})
        if len(models["composite"]) < 2 or not models["homogenised"]:
            found[-1].update(status="failed", reason="no two morphologies, or no homogenised block, ran to the end")
            continue
        window = windows[dict(place)["window"]]
        runs = [[read_run(folder, window) for folder in folders] for folders in models.values()]
        found[-1].update(compared(*runs))
    return found


if __name__ == "__main__":
    raise SystemExit("equivalence.verdict is a library, no command: snakemake --snakefile runs/equivalence/Snakefile "
                     "runs the study.")
