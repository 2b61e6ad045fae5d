"""The page of a study: its README with the pictures inside, or the table and pictures of its output folder."""

import csv
import re
from pathlib import Path

from slipscale.mistakes import Mistake
from slipscale.reports import html

MOST_ROWS = 500


def study_page(folder):
    folder = Path(folder)
    body = of_readme(folder) if (folder / "README.md").is_file() else of_output(folder)
    name = folder.resolve().name
    return html.document(f"slipscale: {name}", body, "all quantities in SI units unless a heading says otherwise")


def of_readme(folder):
    try:
        import markdown
    except ImportError as missing:
        raise Mistake("The page of a study needs Python's markdown (python3-markdown on Debian).") from missing
    body = markdown.markdown((folder / "README.md").read_text(), extensions=["tables", "fenced_code", "md_in_html"])
    body = body.replace("<table>", '<div class="scroll"><table>').replace("</table>", "</table></div>")
    return re.sub(r'<img([^>]*?)src="([^":]+)"', lambda found: embedded(folder, found), body)


def embedded(folder, found):
    path = folder / found[2]
    if not path.is_file():
        return found[0]
    kind = "image/svg+xml" if path.suffix == ".svg" else f"image/{path.suffix.lstrip('.')}"
    return f'<img{found[1]}src="{html.embedded(path.read_bytes(), kind)}"'


def of_output(folder):
    pictures = sorted(folder.glob("*.png")) + sorted(folder.glob("picture/**/*.png"))
    shown = "".join(f"<p>{html.image(path)}</p>\n" for path in pictures)
    with (folder / "table.csv").open(newline="") as file:
        heading, *rows = csv.reader(file)
    cut = [f"The table has {len(rows)} rows; the first {MOST_ROWS} are shown."] if len(rows) > MOST_ROWS else []
    return (f"<h1>{html.text(folder.resolve().name)}</h1>\n{shown}" + html.warnings(cut)
            + html.section("Table", html.table(rows[:MOST_ROWS], heading)))
