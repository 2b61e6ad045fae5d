"""Options of `morphology` for the mesh that is twice finer than the one of a plan.

    python3 -m plan.finer FOLDER/outcome.yaml
"""

import sys
from pathlib import Path

from slipscale.reading.yaml_file import load


def finer_options(plan):
    """Of what plan.yaml says, a dict."""
    proposal = plan["proposal"]
    return {"cell": proposal["cell"], "size": float(f"{0.5 * proposal['size']:.9g}")}


def main(arguments=None):
    outcome = Path((sys.argv[1:] if arguments is None else arguments)[0])
    plan = load(outcome.parent / "plan.yaml", written=True)
    if plan["status"] == "ok":
        print(" ".join(f"-{name} {value}" for name, value in finer_options(plan).items()))
    return 0


if __name__ == "__main__":
    sys.exit(main())
