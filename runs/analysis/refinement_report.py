"""A refinement study's table in Markdown: errors and orders, limits with their error bars, and what accuracy costs.

    report(rows)    the text; rows are those of the study's table
"""

import numpy as np

from analysis.refinement import CONVERGES, found_in
from analysis.refinement_picture import unit_of
from analysis.report import bullets, failures, folded
from analysis.table import markdown

OPTIONS = ("sequence", "variant", "family", "size", "step")  # of a run, to say which one failed
DIGITS = {"friction": 4, "frequency": 1, "velocity": 3, "stick": 3, "open": 3, "power_ratio": 3}
KILO = 1e-3
DEAREST = 1e6  # times: nobody pays more
SAME_DRAWING = 1e-9  # of the fraction of the inclusions


def in_digits(error):
    return "-" if not np.isfinite(error) else f"{error:.3f}" if error >= 0.1 else f"{error:.2g}"


def shown(found, value, digits=None):
    """A value of an average in its unit, kHz for Hz."""
    if not np.isfinite(value):
        return "-"
    if found.quantity in DIGITS:
        return f"{value * (KILO if found.unit == 'Hz' else 1):.{digits or DIGITS[found.quantity]}f}"
    return f"{value:.{digits or 4}g}"


def heading(found):
    unit = {"Hz": "kHz", "1": ""}.get(found.unit, found.unit)
    return found.quantity.replace("_", " ") + (f" [{unit}]" if unit else "")


def in_words(each):
    """Order from the three finest and, in brackets, those between successive ones; or the verdict."""
    if each.verdict != CONVERGES:
        return each.verdict
    return f"{each.order:.2f} ({', '.join(f'{order:.1f}' for order in each.orders)})"


def sizes_in(found):
    """All sizes or steps of several `Refined`, falling."""
    return sorted({h for each in found for h in each.h}, reverse=True)


def at(each, h, values):
    """The value at size h, nan where the sequence lacks it."""
    place = np.flatnonzero(np.isclose(each.h, h, rtol=1e-6))
    return values[place[0]] if len(place) else np.nan


def table_of(found, number):
    """A line for each variant and quantity, a column for each size or step, which `number(each, h)` fills; then order
    and limit."""
    sizes = [h for h in sizes_in(found) if any(number(each, h) != "-" for each in found)]
    scale, unit = unit_of(sizes, found[0].along)
    averages = found[0].is_average()
    last = ["limit ± error bar"] if averages else ["error of the reference"]
    header = ["", heading_of(found), *(f"{h * scale:.4g} {unit}" for h in sizes), "order", *last, "ten times less costs"]
    lines = [[each.variant, heading(each), *(number(each, h) for h in sizes), in_words(each), limit_of(each),
              price_of(each)] for each in found]
    return markdown(header, lines)


def heading_of(found):
    return "average" if found[0].is_average() else "distance to the reference"


def limit_of(each):
    if not each.is_average():
        return in_digits(each.bar)
    if not np.isfinite(each.limit):
        return "-"
    return f"{shown(each, each.limit)} ± {shown(each, each.bar)}"


def price_of(each):
    return f"{each.price():.0f} times" if each.price() < DEAREST else "-"


def value_at(each, h):
    value = at(each, h, each.values)
    scatter = at(each, h, each.scatter)
    return shown(each, value) + (f" ± {shown(each, scatter)}" if scatter > 0 else "")


def trade_lines(found):
    """For each quantity that converges: what its finest error cost."""
    for each in found:
        known = np.isfinite(each.errors) & (each.errors > 0)
        if each.verdict == CONVERGES and np.count_nonzero(known) > 1:
            scale, unit = unit_of(each.h, each.along)
            steps = [f"{in_digits(each.errors[k])} at {each.h[k] * scale:.4g} {unit} for {each.seconds[k]:.2g} s and "
                     f"{each.node_steps[k]:.1e} node-steps" for k in np.flatnonzero(known)[[0, -1]]]
            yield f"{each.variant}, {heading(each)}: error {'; '.join(steps)}."


def drawing_lines(rows):
    """Whether `morphology` drew the same on all sizes, for each family that has inclusions."""
    families = dict.fromkeys(row["family"] for row in rows if row.get("inclusions"))
    for family in families:
        meshes = {row["size"]: row for row in rows if row["family"] == family and row.get("inclusions")}
        numbers = {mesh["inclusions"] for mesh in meshes.values()}
        parts = [mesh["inclusion_fraction"] for mesh in meshes.values()]
        mended = {size: mesh["moved"] + mesh["redrawn"] + mesh["dropped"] for size, mesh in meshes.items()}
        changed = [f"{size:g} m ({count} mended)" for size, count in mended.items() if count]
        if len(numbers) == 1 and np.ptp(parts) <= SAME_DRAWING and not changed:
            yield (f"{family}: the same drawing on all {len(meshes)} meshes, {numbers.pop()} inclusions with a fraction "
                   f"of {parts[0]:.6f}.")
        else:
            yield (f"{family}: not the same drawing on all {len(meshes)} meshes: {', '.join(map(str, sorted(numbers)))} "
                   f"inclusions, fractions {min(parts):.6f} to {max(parts):.6f}"
                   f"{', inclusions moved or dropped at ' + ', '.join(changed) if changed else ''}.")


def sequence_text(name, rows):
    """The part of one sequence."""
    found = found_in(rows)
    first = rows[0]
    text = f"**{name}**, scene {first['scene']}, meshes {first['family']}, {varied(rows)}:\n\n"
    distances = [each for each in found if not each.is_average()]
    averages = [each for each in found if each.is_average()]
    if distances:
        text += table_of(distances, lambda each, h: in_digits(at(each, h, each.errors))) + "\n"
    if averages:
        text += table_of(averages, value_at) + "\n"
    lines = [*trade_lines(distances), *failures(rows, OPTIONS)]
    return text + (bullets(lines) + "\n" if lines else "")


def varied(rows):
    """What is refined, and how the other of size and step goes with it."""
    along, other = ("size", "step") if rows[0]["along"] == "size" else ("step", "size")
    fixed = {row[other] for row in rows}
    scale, unit = unit_of([max(fixed)], other)
    word = {"size": "element size", "step": "time step"}
    if len(fixed) == 1:
        return f"{word[along]} refined, {word[other]} {fixed.pop() * scale:.4g} {unit}"
    return f"{word[along]} and {word[other]} refined together"


def every_run(rows):
    """One line for each run of each sequence and number, price beside error."""
    header = ["sequence", "variant", "size [m]", "step [s]", "nodes", "node-steps", "seconds", "quantity", "value",
              "scatter", "distance"]
    return markdown(header, [
        [row["sequence"], row["variant"], f"{row['size']:.4g}", f"{row['step']:.4g}", row["nodes"],
         f"{row['node_steps']:.2e}", f"{row['seconds']:.2f}", row["quantity"] or "the reference",
         *("" if row.get(name) is None else f"{row[name]:.5g}" for name in ("value", "scatter", "error"))]
        for row in rows if row["status"] == "ok"])


def report(rows):
    parts = {}
    for row in rows:
        parts.setdefault(row["sequence"], []).append(row)
    drawings = bullets(drawing_lines([row for row in rows if row["status"] == "ok"]))
    text = "".join(sequence_text(name, part) for name, part in parts.items())
    return f"{drawings}{chr(10) if drawings else ''}{text}{folded('All runs', every_run(rows))}"
