"""Writes the coefficient of friction that `homogenize` found for a whole face, as a scene for `slide`.

    python3 -m phases.coefficient OUTCOME.yaml effective|mean SCENE.yaml

Beside the outcome lies effective.yaml: `effective` is its friction_coefficient, `mean` its friction_mean.
"""

import sys
from pathlib import Path

from slipscale.mistakes import Mistake
from slipscale.reading.yaml_file import load

NAMES = {"effective": "friction_coefficient", "mean": "friction_mean"}


def coefficient(folder, model):
    """Of the folder of a run of `homogenize`. Raises Mistake."""
    found = load(Path(folder) / "effective.yaml", written=True)
    if NAMES[model] not in found:
        raise Mistake(f"{folder}/effective.yaml has no {NAMES[model]}: give homogenize the coefficients of all phases")
    return float(found[NAMES[model]])


def main(arguments):
    outcome, model, scene = arguments
    folder = Path(outcome).parent
    # What could not be homogenised fails as the run that needs it does.
    text = f"friction_coefficient: {coefficient(folder, model)!r}\n" if (folder / "effective.yaml").is_file() else "{}\n"
    Path(scene).parent.mkdir(parents=True, exist_ok=True)
    Path(scene).write_text(text)


if __name__ == "__main__":
    main(sys.argv[1:])
