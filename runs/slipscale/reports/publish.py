"""What the reports of all studies share: the README that they renew, and how failures and lists are said."""

from pathlib import Path

from slipscale.pictures.drawing import keep_small
from slipscale.reading.yaml_file import load
from slipscale.running.table import replace_between, write_whole


def bullets(lines):
    """A Markdown list of sentences."""
    return "".join(f"- {line[0].upper()}{line[1:]}\n" for line in lines)


def folded(title, text):
    """Markdown that a reader unfolds."""
    return f"<details>\n<summary>{title}</summary>\n\n{text}\n</details>\n"


def failures(rows, options):
    """A sentence for each row that failed: its options and its reason."""
    for row in rows:
        if row["status"] != "ok":
            yield f"Failed: {', '.join(f'{name} {row[name]}' for name in options if name in row)}: {row['reason']}"


def publish(text, report, readme=None, pictures=(), others=()):
    """Writes `text` to the file `report` and, if there is a folder `readme`, between the lines 'report: begin' and
    'report: end' of its README.md, with small copies of the `pictures`.

    A picture is a file, or the outcome.yaml beside `picture.png`: then its copy has the name of their folder, and one
    that could not be drawn is said in `report` and left out. `others` are looked at alike but stay where they are.
    """
    drawn, missing = [], ""
    for picture in map(Path, dict.fromkeys([*pictures, *others])):
        if picture.name != "outcome.yaml":
            drawn.append((picture, picture.name))
        elif (said := load(picture, written=True))["status"] == "ok":
            if str(picture) in map(str, pictures):
                drawn.append((picture.parent / "picture.png", f"{picture.parent.name}.png"))
        else:
            missing += f"No picture: {picture}: {said['reason']}\n"
    if readme:
        replace_between(Path(readme) / "README.md", "report", f"\n{text}\n")
        for picture, name in drawn:
            keep_small(picture, Path(readme) / name)
    write_whole(Path(report), text + missing)
