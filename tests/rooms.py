"""Compares who includes whom in src/ and include/ with the table of rooms in src/README.md.

    python3 tests/rooms.py [folder of the clone]

A room may include the public headers of every room that the arrows of the table lead down to, and nothing else; the
table has no circle, no room that is not there and no arrow that nobody uses. Files that src/README.md names are there.
Prints one line for each fault; exit code 1 when there is any.
"""

import re
import sys
from pathlib import Path

BEGIN, END = "<!-- rooms: begin -->", "<!-- rooms: end -->"
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"')
NAMED = re.compile(r"`((?:[\w.-]+/)+[\w.-]*)`")  # a path: words with slashes between them
PROGRAMS = "programs"  # the files of src/ itself, one a program


def drawn(text):
    """{room: rooms its arrows point to} of the table; a row is | `room` | `other`, `another` | … |."""
    if BEGIN not in text or END not in text:
        raise SystemExit(f"src/README.md lacks the comments '{BEGIN}' and '{END}' around its table of rooms")
    rows = {}
    for line in text.split(BEGIN, 1)[1].split(END, 1)[0].splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if names := re.findall(r"`(\w+)`", cells[0]):
            rows[names[0]] = set(re.findall(r"`(\w+)`", cells[1]))
    return rows


def below(arrows):
    """{room: all rooms that its arrows lead down to}, and the circles among them."""
    reach, circles = {}, []
    for room in arrows:
        seen, to_visit = set(), list(arrows[room])
        while to_visit:
            other = to_visit.pop()
            if other not in seen:
                seen.add(other)
                to_visit += arrows.get(other, ())
        reach[room] = seen
        if room in seen:
            circles.append(room)
    return reach, circles


def room_of(file, root):
    """Of src/<room>/…, src/<program>.cpp and include/slipscale/<room>/…."""
    inside = file.relative_to(root / ("src" if file.is_relative_to(root / "src") else "include/slipscale")).parts
    return inside[0] if len(inside) > 1 else PROGRAMS


def includes(root):
    """(file, line number, its room, the room it includes, whether by a public header) of every quoted include that
    leaves its room; `version.hpp` belongs to nobody."""
    for file in sorted([*root.glob("src/**/*.[ch]pp"), *root.glob("include/**/*.hpp")]):
        own = room_of(file, root)
        for number, line in enumerate(file.read_text().splitlines(), 1):
            if not (found := INCLUDE.match(line)):
                continue
            header = found[1]
            public = header.startswith("slipscale/")
            if header == "slipscale/version.hpp":
                continue
            target = root / "include" / header if public else (file.parent / header).resolve()
            try:
                other = room_of(target, root)
            except ValueError:  # outside of both trees
                other = header
            if other != own or (public and not target.exists()):
                yield file.relative_to(root), number, own, other, public and target.exists()


def is_there(root, path):
    """Whether the clone, src/ or include/slipscale/ holds it."""
    return any((root / parent / path).exists() for parent in ("", "src", "include/slipscale"))


def faults(root):
    """One sentence for each."""
    readme = (root / "src/README.md").read_text()
    arrows = drawn(readme)
    reach, circles = below(arrows)
    found = [f"src/README.md: {room} knows itself in a circle" for room in circles]
    there = {PROGRAMS} | {folder.name for parent in ("src", "include/slipscale")
                          for folder in (root / parent).iterdir() if folder.is_dir()}
    found += [f"src/README.md: the table has no row for room {room}" for room in sorted(there - set(arrows))]
    drawn_rooms = set(arrows) | {other for others in arrows.values() for other in others}
    found += [f"src/README.md: there is no room {room}" for room in sorted(drawn_rooms - there)]
    used = set()
    for file, line, own, other, public in includes(root):
        used.add((own, other))
        if not public:
            found.append(f"{file}:{line}: {own} includes a header of {other} that is not among its public ones "
                         f"(include/slipscale/{other}/)")
        elif other not in reach.get(own, ()):
            found.append(f"{file}:{line}: {own} includes {other}, which no arrow of src/README.md leads to")
    found += [f"src/README.md: the arrow from {room} to {other} is drawn, but nothing uses it"
              for room in arrows for other in sorted(arrows[room])
              if other in there and (room, other) not in used]
    found += [f"src/README.md names {path}, which is not there"
              for path in dict.fromkeys(NAMED.findall(readme)) if not is_there(root, path)]
    return found


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parents[1]).resolve()
    found = faults(root)
    print("\n".join(found) if found else "every include follows an arrow of src/README.md")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
