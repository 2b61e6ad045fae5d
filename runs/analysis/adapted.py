"""What analysis.adapt found, as rows of a study's table."""

from pathlib import Path

import yaml

from analysis.table import OUTCOME

COMPARED = ("spectrum_distance", "power", "friction", "frequency", "amplitude", "stick", "slip", "open")


def adapted_rows(outcome):
    """Rows of an outcome.yaml of analysis.adapt and the adapt.yaml beside it: one for each level, and one, `nearest`,
    for the trial whose spectrum came nearest whatever it matched; one row with the reason if there is no adapt.yaml.

    Columns: the options, `level`, status and reason of the level, `value`, `match`, COMPARED as before_ and after_, and
    the `folder` of the run after.
    """
    outcome = Path(outcome)
    ended = yaml.safe_load(outcome.read_text())
    options = {**ended["options"], "model": "adapted"}
    costs = {name: ended[name] for name in OUTCOME if name not in ("status", "reason")}
    file = outcome.parent / "adapt.yaml"
    if not file.is_file() or str(ended["reason"]).startswith("the run was not started"):
        return [{**options, **{name: ended[name] for name in OUTCOME}}]
    found = yaml.safe_load(file.read_text())
    before = {f"before_{name}": found["before"][name] for name in COMPARED}
    rows = []
    for level, said in found["levels"].items():
        seen = said.get("surface", {})
        rows.append({**options, "level": level, "status": said["status"], "reason": said["reason"], **costs,
                     "value": said.get("value"), "match": said.get("match"), **before, **after(said.get("after")),
                     **{f"time_seen_{scale}": motion["time_seen"] for scale, motion in seen.items()}})
    if nearest := found["nearest"]:
        rows.append({**options, "level": "nearest", "status": "ok", "reason": None, **costs,
                     "value": nearest["value"], **before, **after(nearest)})
    return rows


def after(found):
    return {**{f"after_{name}": found[name] for name in COMPARED}, "folder": found["folder"]} if found else {}
