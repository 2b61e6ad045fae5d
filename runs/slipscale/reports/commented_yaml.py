"""The programs write YAML whose comments are the units and meanings: rows for people, not data for programs."""

import re

LINE = re.compile(r"^(?P<indent> *)(?P<key>[^\s#:][^:#]*):(?:\s+(?P<value>.*?))?(?:\s{2,}#\s*(?P<note>.*))?$")


def rows_of(path, without=()):
    """(name, value, unit or meaning) of every entry of a file, (name,) where a group begins; groups in `without` are
    left out. Empty when there is no such file."""
    if not path.is_file():
        return []
    rows, skipping = [], False
    for line in path.read_text().splitlines():
        found = LINE.match(line)
        if not found or line.lstrip().startswith("#"):
            continue
        if not found["indent"]:
            skipping = found["key"] in without
        if skipping:
            continue
        value = (found["value"] or "").strip()
        if value.startswith("#"):  # a group with a remark
            rows.append((f"{found['key']}: {value.lstrip('# ')}",))
        elif not value:
            rows.append((found["key"] + (f": {found['note']}" if found["note"] else ""),))
        else:
            rows.append((found["key"], value, found["note"] or ""))
    return rows


def group_of(path, group):
    """The rows of one group."""
    rows, inside = [], False
    for line in path.read_text().splitlines() if path.is_file() else []:
        found = LINE.match(line)
        if not found:
            continue
        if not found["indent"]:
            inside = found["key"] == group
        elif inside:
            rows.append((found["key"], (found["value"] or "").strip(), found["note"] or ""))
    return rows


if __name__ == "__main__":
    raise SystemExit("slipscale.reports.commented_yaml is a library, no command: slipscale -h lists the commands.")
