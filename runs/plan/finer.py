"""Options of `morphology` for the mesh that is twice finer than the one of a plan.

    python3 -m plan.finer FOLDER/outcome.yaml
"""

import sys
from pathlib import Path

from slipscale.parser import Parser
from slipscale.reading.yaml_file import load


def finer_options(plan):
    """Of what plan.yaml says, a dict."""
    proposal = plan["proposal"]
    return {"cell": proposal["cell"], "size": float(f"{0.5 * proposal['size']:.9g}")}


def main(arguments=None):
    parser = Parser("plan.finer", __doc__, "python3 -m")
    parser.add_argument("outcome", type=Path, help="outcome.yaml of a plan, which lies beside its plan.yaml")
    outcome = parser.parse_args(arguments).outcome
    plan = load(outcome.parent / "plan.yaml", written=True)
    if plan["status"] == "ok":
        print(" ".join(f"-{name} {value}" for name, value in finer_options(plan).items()))
    return 0


if __name__ == "__main__":
    sys.exit(main())
