"""The command line of a plan: its words, and options of the programs laid over scene and recipe."""

from slipscale.parser import Parser, Window
from slipscale.planning.case import SEPARATE
from slipscale.planning.wishes import seconds_of
from slipscale.running.sweep import check, owner, parameters_in, values_of
from slipscale.running.sweep_command import paired

CELLS = ("grid", "triangle", "quadrilateral")


def with_changes(scene, recipe, changes, manuals):
    """Both with options of the command line, each given to the program that knows it. Raises Mistake."""
    for name, text in changes:
        value = values_of(text, takes_list=True)[0] if "," in text else values_of(text)[0]
        (recipe if owner(name, manuals) == "morphology" else scene)[name] = value
    for options, program in ((scene, "slide"), (recipe, "morphology")):
        for name, value in options.items():
            if name not in SEPARATE:
                check(name, value, {program: manuals[program]}, parameters_in(scene))
    return scene, recipe


def parsed(words, manual):
    """What was asked for, and options of the programs, pairs of name and text. Raises Mistake."""
    parser = Parser("plan", manual)
    parser.add_argument("scene", help="YAML file, options of slide")
    parser.add_argument("--recipe", required=True, help="YAML file, options of morphology for the block")
    parser.add_argument("--want", help="results and how accurate they shall be, as friction:1%%,frequency:0.5%%")
    parser.add_argument("--budget", help="time of one core, as 90s, 10min or 2h: what accuracy does it buy?")
    parser.add_argument("--output", default="out/plan", help="folder (default: out/plan)")
    parser.add_argument("--window", action=Window, metavar=("FROM", "TO"), help="of averages, s; default: the second "
                        "half of the run")
    parser.add_argument("--before", action=Window, metavar=("FROM", "TO"), help="of trajectories, s")
    parser.add_argument("--cells", default="grid,triangle", help="kinds that are tried, the first most (default: "
                        "grid,triangle)")
    parser.add_argument("--sizes", type=float, metavar="SIZE", help="of the coarsest pilot mesh, m (default: by its price)")
    parser.add_argument("--pilots", default="1min", help="what all pilot runs may take while the proposal is short")
    parser.add_argument("--jobs", type=int, default=1, help="pilot runs at a time")
    parser.add_argument("--dry-run", action="store_true", help="only draw the pilot meshes and say what their runs take")
    parser.add_argument("--quiet", action="store_true", help="only the answer")
    changes, left = paired(words)
    asked = parser.parse_args(left)
    if not (asked.want or asked.budget):
        parser.error("say what you want, as --want friction:1%, or a --budget, as 10min")
    asked.pilots = seconds_of(asked.pilots)
    asked.cells = [cell.strip() for cell in asked.cells.split(",")]
    if set(asked.cells) - set(CELLS) or len(set(asked.cells)) < len(asked.cells):
        parser.error(f"--cells: {', '.join(CELLS)}, each once, are to choose from")
    if asked.sizes is not None and not 0 < asked.sizes < float("inf"):
        parser.error(f"--sizes: a length in m, above 0, is wanted, as 0.5e-3, not {asked.sizes:g}")
    if asked.jobs < 1:
        parser.error(f"--jobs: at least one pilot run at a time is wanted, not {asked.jobs}")
    return asked, changes


if __name__ == "__main__":
    raise SystemExit("slipscale.planning.asked is a library, no command: slipscale -h lists the commands.")
