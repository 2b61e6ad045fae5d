"""A refinement study's table in Markdown: errors and orders, limits with their error bars, and what accuracy costs.

    report(rows, unfolded)    the text; rows are those of the study's table
"""

import numpy as np

from refinement.orders import CONVERGES, found_in
from refinement.picture import unit_of
from refinement.sequences import SAME
from slipscale.reports.publish import bullets, failures, folded
from slipscale.running.table import markdown

OPTIONS = ("sequence", "variant", "family", "size", "step")  # of a run, to say which one failed
DIGITS = {"friction": 4, "frequency": 1, "velocity": 3, "stick": 4, "open": 4, "power_ratio": 4}
KILO = 1e-3
DEAREST = 1e4  # times: nobody pays more
SAME_DRAWING = 1e-9  # of the fraction of the inclusions


def in_digits(error):
    return "-" if not np.isfinite(error) else f"{error:.3f}" if error >= 0.1 else f"{error:#.2g}"


def scale_of(found):
    return KILO if found.unit == "Hz" else 1.0


def shown(found, value):
    """A value of an average in its unit, kHz for Hz."""
    if not np.isfinite(value):
        return "-"
    return f"{value * scale_of(found):.{DIGITS[found.quantity]}f}" if found.quantity in DIGITS else f"{value:.4g}"


def with_bar(found, value, bar):
    """The error bar has two digits, the value as many decimals."""
    value, bar = value * scale_of(found), bar * scale_of(found)
    if not (np.isfinite(value) and bar > 0):
        return shown(found, value / scale_of(found))
    decimals = min(9, max(0, 1 - int(np.floor(np.log10(bar)))))
    return f"{value:.{decimals}f} ± {bar:.{decimals}f}"


def heading(found):
    unit = {"Hz": "kHz", "1": ""}.get(found.unit, found.unit)
    return found.quantity.replace("_", " ") + (f" [{unit}]" if unit else "")


def in_words(each):
    """Orders from coarse to fine, the last of which counts; or the verdict."""
    if each.verdict != CONVERGES:
        return each.verdict
    return ", ".join(f"{order:.1f}" if np.isfinite(order) else "-" for order in each.orders)


def sizes_in(found):
    """All sizes or steps of several `Refined`, falling."""
    return sorted({h for each in found for h in each.h}, reverse=True)


def at(each, h, values):
    """The value at size h, nan where the sequence lacks it."""
    place = np.flatnonzero(np.isclose(each.h, h, rtol=SAME, atol=0))
    return values[place[0]] if len(place) else np.nan


def table_of(found, number):
    """A line for each variant and quantity, a column for each size or step, which `number(each, h)` fills; then order
    and limit."""
    sizes = [h for h in sizes_in(found) if any(number(each, h) != "-" for each in found)]
    scale, unit = unit_of(sizes, found[0].along)
    averages = found[0].is_average()
    last = ["limit ± error bar", "scatter in time"] if averages else ["error of the reference"]
    header = ["", heading_of(found), *(f"{h * scale:.4g} {unit}" for h in sizes), "order", *last,
              "ten times less costs"]
    lines = [[each.variant, heading(each), *(number(each, h) for h in sizes), in_words(each), *limit_of(each),
              price_of(each)] for each in found]
    rest = [""] * (len(header) - 2 - len(sizes))
    return markdown(header, [*lines, *([*line, *rest] for line in price_lines(found, sizes))])


def heading_of(found):
    return "average" if found[0].is_average() else "distance to the reference"


def limit_of(each):
    """What stands in the columns of the limit."""
    if not each.is_average():
        return [in_digits(each.bar)]
    return [with_bar(each, each.limit, each.bar), f"{each.scatter[-1] * scale_of(each):.2g}"]


def price_of(each):
    if not np.isfinite(each.price()):
        return "-"
    return f"{each.price():.0f} times" if each.price() < DEAREST else f"over {DEAREST:.0f} times"


def value_at(each, h):
    return shown(each, at(each, h, each.values))


def price_lines(found, sizes):
    """Two lines of a table: node-steps and seconds at each size, medians of the variants."""
    for name, label in (("node_steps", "node-steps"), ("seconds", "seconds")):
        prices = [[at(each, h, getattr(each, name)) for each in found] for h in sizes]
        yield ["", label, *("-" if np.all(np.isnan(price)) else f"{np.nanmedian(price):.2g}" for price in prices)]


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
            yield (f"{family}: the same drawing on all {len(meshes)} meshes, {numbers.pop()} inclusions with a "
                   f"fraction of {parts[0]:.6f}.")
        else:
            yield (f"{family}: not the same drawing on all {len(meshes)} meshes: "
                   f"{', '.join(map(str, sorted(numbers)))} inclusions, fractions {min(parts):.6f} to {max(parts):.6f}"
                   f"{', inclusions moved or dropped at ' + ', '.join(changed) if changed else ''}.")


def sequence_text(rows):
    """What was found in one sequence."""
    found = found_in(rows)
    text = ""
    distances = [each for each in found if not each.is_average()]
    averages = [each for each in found if each.is_average()]
    if distances:
        text += table_of(distances, lambda each, h: in_digits(at(each, h, each.errors))) + "\n"
    if averages:
        text += table_of(averages, value_at) + "\n"
    failed = bullets(failures(rows, OPTIONS))
    return text + (failed + "\n" if failed else "")


def title_of(rows):
    first = rows[0]
    families = " and ".join(dict.fromkeys(row["family"] for row in rows))
    return f"{first['sequence']}: scene {first['scene']}, meshes {families}, {varied(rows)}"


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
    """One line for each run of each sequence, price beside what was found."""
    runs = {}
    for row in rows:
        if row["status"] == "ok":
            runs.setdefault((row["sequence"], row["variant"], row["run"]), []).append(row)
    header = ["sequence", "variant", "size [m]", "step [s]", "nodes", "node-steps", "seconds", "distances", "averages"]
    return markdown(header, [
        [first["sequence"], first["variant"], f"{first['size']:.4g}", f"{first['step']:.4g}", first["nodes"],
         f"{first['node_steps']:.2e}", f"{first['seconds']:.2f}", said(found, "error", ".3g"),
         said(found, "value", ".5g")]
        for found in runs.values() for first in found[:1]])


def said(rows, column, digits):
    return ", ".join(f"{row['quantity']} {row[column]:{digits}}" for row in rows if row.get(column) is not None)


def report(rows, unfolded=None):
    """The sequences named by `unfolded`, all for None, are seen at once, others when a reader unfolds them."""
    parts = {}
    for row in rows:
        parts.setdefault(row["sequence"], []).append(row)
    drawings = bullets(drawing_lines([row for row in rows if row["status"] == "ok"]))
    text = f"{drawings}\n" if drawings else ""
    for name, part in parts.items():
        if unfolded is None or name in unfolded:
            text += f"**{title_of(part)}**\n\n{sequence_text(part)}"
        else:
            text += folded(title_of(part), sequence_text(part)) + "\n"
    return text + folded("All runs", every_run(rows))


if __name__ == "__main__":
    raise SystemExit("refinement.findings is a library, no command: snakemake --snakefile runs/refinement/Snakefile "
                     "runs the study.")
