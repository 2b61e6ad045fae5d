"""Writes the coefficient of friction that `homogenize` found for a whole face, as a scene for `slide`.

    python3 -m phases.coefficient OUTCOME.yaml effective|mean SCENE.yaml

Beside the outcome lies effective.yaml: `effective` is its friction_coefficient, `mean` its friction_mean.
"""

import sys
from pathlib import Path

from slipscale.mistakes import Mistake
from slipscale.parser import Parser
from slipscale.reading import read_yaml

NAMES = {"effective": "friction_coefficient", "mean": "friction_mean"}


def coefficient(folder, model):
    """Of the folder of a run of `homogenize`. Raises Mistake."""
    report = read_yaml(Path(folder) / "effective.yaml")["homogenize"]
    if NAMES[model] not in report:
        raise Mistake(f"{folder}/effective.yaml has no {NAMES[model]}: give homogenize the coefficients of all phases")
    return float(report[NAMES[model]])


def coefficient_of_run(folder):
    """The coefficient that a run of `slide` was given for all phases, or None."""
    given = read_yaml(Path(folder) / "run.yaml").get("friction_coefficient")
    return None if given is None else float(given)


def main():
    parser = Parser("phases.coefficient", __doc__, "python3 -m")
    parser.add_argument("outcome", help="outcome.yaml of a run of homogenize", type=Path)
    parser.add_argument("model", help="which coefficient", choices=sorted(NAMES))
    parser.add_argument("scene", help="the file to write", type=Path)
    asked = parser.parse_args()
    folder = asked.outcome.parent
    # What could not be homogenised fails as the run that needs it does.
    there = (folder / "effective.yaml").is_file()
    asked.scene.write_text(f"friction_coefficient: {coefficient(folder, asked.model)!r}\n" if there else "{}\n")


if __name__ == "__main__":
    sys.exit(main())
