"""A run, or a study, on one page: report.html, which opens in any browser, offline, wherever it is copied.

    slipscale report out/first                 writes out/first/report.html
    slipscale report runs/refinement           a folder with a README.md, or with the table.csv and pictures of a study

Of a run: the picture, the numbers, warnings, the command that repeats it, every option in effect, mesh, energy ledger.
"""

from pathlib import Path

from slipscale.mistakes import Mistake
from slipscale.parser import Parser
from slipscale.reports import html
from slipscale.reports.run_page import run_page
from slipscale.reports.study_page import study_page


def page(folder):
    """The HTML text of the page for a folder. Raises Mistake when there is nothing to report."""
    folder = Path(folder)
    if not folder.is_dir():
        raise Mistake(f"There is no folder {folder}: give the output folder of a run, or the folder of a study.")
    if (folder / "history.h5").is_file() or (folder / "run.yaml").is_file():
        return run_page(folder)
    if (folder / "README.md").is_file() or (folder / "table.csv").is_file():
        return study_page(folder)
    raise Mistake(f"{folder} holds neither a run (history.h5, run.yaml) nor a study (README.md, table.csv).")


def main(arguments=None):
    parser = Parser("report", __doc__)
    parser.add_argument("folder", help="output folder of a run, or folder of a study")
    parser.add_argument("--output", help="file to write (default: report.html in the folder)")
    given = parser.parse_args(arguments)
    output = Path(given.output or Path(given.folder) / "report.html")
    html.write(output, page(given.folder))
    print(output)
    return 0
