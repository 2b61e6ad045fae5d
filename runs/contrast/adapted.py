"""What slipscale.adapting.adapt found, as rows of a study's table."""

from pathlib import Path

from contrast.morphologies import COMPOSITE
from slipscale.reading.yaml_file import load
from slipscale.running.table import OUTCOME

COMPARED = ("spectrum_distance", "power", "friction", "frequency", "amplitude", "stick", "slip", "open")

WAYS = {"time": "T", "coefficient": "µ", "damping": "damping", "slip_rate": "slip-rate form", "density": "density",
        "density_time": "density, then T", "modes": "T by modes", "modes_all": "T, µ, density, damping by modes"}
BY_MODES = ("modes", "modes_all")  # ways whose level is that of modes
GOES_ON = ("density_time",)  # ways whose distance before is that after another way


def adapted_rows(outcome):
    """Rows of an outcome.yaml of slipscale.adapting.adapt and the adapt.yaml beside it: one for each level, and one,
    `nearest`, for the trial whose spectrum came nearest whatever it matched; one row with the reason if there is no
    adapt.yaml.

    Columns: the options, `level`, status and reason of the level, `value`, `match`, COMPARED as before_ and after_, the
    `folder` of the run after; of the level of modes its misfit before and after, and all `changes`.
    """
    outcome = Path(outcome)
    ended = load(outcome, written=True)
    options = {**ended["options"], "model": "adapted"}
    costs = {name: ended[name] for name in OUTCOME if name not in ("status", "reason")}
    file = outcome.parent / "adapt.yaml"
    if not file.is_file() or str(ended["reason"]).startswith("the run was not started"):
        return [{**options, **{name: ended[name] for name in OUTCOME}}]
    found = load(file, written=True)
    before = {f"before_{name}": found["before"][name] for name in COMPARED}
    rows = []
    for level, said in found["levels"].items():
        seen = said.get("surface", {})
        rows.append({**options, "level": level, "status": said["status"], "reason": said["reason"], **costs,
                     "value": said.get("value"), "match": said.get("match"), **before, **after(said.get("after")),
                     "misfit_before": said.get("misfit_before"), "misfit_after": said.get("misfit_after"),
                     "changes": in_words(said.get("changes")),
                     **{f"time_seen_{scale}": motion["time_seen"] for scale, motion in seen.items()}})
    if nearest := found["nearest"]:
        rows.append({**options, "level": "nearest", "status": "ok", "reason": None, **costs,
                     "value": nearest["value"], **before, **after(nearest)})
    return rows


def in_words(changes):
    """Values by the names of options, as one text; None without."""
    return "; ".join(f"{name} {value:.4g}" for name, value in changes.items()) if changes else None


def cases_of(rows):
    """{composite: {(way, level): row}} of adaptations that had a distance before; a composite is (young, diameter,
    size, seed)."""
    cases = {}
    for row in rows:
        if row["model"] == "adapted" and row.get("before_spectrum_distance") is not None:
            case = tuple(row[name] for name in COMPOSITE)
            cases.setdefault(case, {})[row["way"], row["level"]] = row
    return cases


def level_of(way):
    """The level of adapt that a way other than `time` goes by."""
    return "modes" if way in BY_MODES else "search"


def before_of(case):
    """The distance of the spectrum before anything was adapted; nan if only later ways are known."""
    return next((row["before_spectrum_distance"] for (way, _), row in case.items() if way not in GOES_ON), float("nan"))


def left_by(case, way):
    """The distance of the spectrum that the best level of this way left; inf without."""
    row = best_level(case, way)
    return row["after_spectrum_distance"] if row else float("inf")


def best_level(case, way):
    """The level of this way whose spectrum came nearest, as a row; or None."""
    rows = [row for (of, level), row in case.items() if of == way and level != "nearest"
            and row["after_spectrum_distance"] is not None]
    return min(rows, key=lambda row: row["after_spectrum_distance"], default=None)


def after(found):
    return {**{f"after_{name}": found[name] for name in COMPARED}, "folder": found["folder"]} if found else {}


if __name__ == "__main__":
    raise SystemExit("contrast.adapted is a library, no command: snakemake --snakefile runs/contrast/Snakefile runs "
                     "the study.")
