"""What the table of a sweep holds, in Markdown."""

from statistics import median

from slipscale.pictures.scales import options_of, values_of, varied
from slipscale.reports.publish import bullets, failures, folded
from slipscale.running.table import is_true, markdown

SHOWN = {"friction": ".4f", "frequency": ".0f", "amplitude": ".3g", "stick": ".3f", "open": ".3f",
         "power_ratio": ".3f", "settled": "", "amplitude_ratio": ".2f", "regime": "", "wall_seconds": ".1f"}
UNITS = {"frequency": "frequency [Hz]", "power_ratio": "power into the body over drive",
         "amplitude_ratio": "amplitude ratio", "wall_seconds": "seconds"}


VIBRATES = 0.01  # amplitude from which a run counts as vibrating


def cell(row, name, form):
    return format(row[name], form) if row.get(name) is not None else "-"


def at(row, options):
    return ", ".join(f"{option} {row[option]}" for option in options if row[option] is not None)


def counts(rows):
    ok = [row for row in rows if row["status"] == "ok"]
    regimes = [f"{sum(row['regime'] == name for row in ok)} {name}" for name in values_of(ok, "regime")]
    return f"{len(rows)} runs, {len(rows) - len(ok)} failed; regimes: {', '.join(regimes) or 'none'}."


def unsettled(rows):
    """What is no average of a limit cycle yet."""
    ok = [row for row in rows if row["status"] == "ok"]
    loud = [row for row in ok if row["amplitude"] > VIBRATES]
    count, quiet = (sum(not is_true(row["settled"]) for row in some)
                    for some in (loud, [row for row in ok if row not in loud]))
    return (f"{len(loud)} runs vibrate (amplitude above {VIBRATES:g}); {count} of these, and {quiet} of the others, "
            "had not settled (`settled`, the rule of summary.yaml): their averages belong to this window only.")


def in_part(rows, options):
    """A sentence for each row that lacks something, though its run came to its end."""
    for row in rows:
        if row["status"] == "ok" and row["reason"]:
            yield f"In part: {at(row, options)}: {row['reason']}"


def extremes(rows, options):
    """Where measures are smallest and largest."""
    for name in ("friction", "amplitude", "frequency", "power_ratio"):
        ok = sorted((row for row in rows if row.get(name) is not None), key=lambda row: row[name])
        if ok:
            low, high = (f"{cell(row, name, SHOWN[name])} ({at(row, options)})" for row in (ok[0], ok[-1]))
            yield f"{UNITS.get(name, name)} from {low} to {high}."


def changes(rows, option):
    """Pairs of rows that are ok and differ in the option alone, its values being neighbours."""
    values, others = values_of(rows, option), [name for name in options_of(rows) if name != option]
    found = {tuple(row[name] for name in (*others, option)): row for row in rows if row["status"] == "ok"}
    for low, high in zip(values, values[1:]):
        for key, row in found.items():
            if key[-1] == low and (other := found.get((*key[:-1], high))):
                yield row, other


def change_table(rows, option):
    """How much friction and regime change with an option, for each value of the others."""
    pairs, lines = list(changes(rows, option)), []
    for name in [name for name in varied(rows, options_of(rows)) if name != option]:
        for value in values_of(rows, name):
            some = [pair for pair in pairs if pair[0][name] == value]
            if some:
                moved = [abs(high["friction"] - low["friction"]) for low, high in some]
                shift = [abs(high["frequency"] / low["frequency"] - 1) for low, high in some
                         if low["frequency"] and high["frequency"] is not None]
                lines.append([f"{name} {value}", len(some), f"{median(moved):.4f}", f"{max(moved):.4f}",
                              sum(part > 0.1 for part in shift),
                              sum(low["regime"] != high["regime"] for low, high in some)])
    return markdown(["at", "pairs", "friction changes by: median", "most", "frequency by more than a tenth",
                     "another regime"], lines)


def report(rows, compared=None):
    options = options_of(rows)
    table = markdown([*options, *(UNITS.get(name, name) for name in SHOWN), "status"], [
        [*(row[name] for name in options), *(cell(row, name, form) for name, form in SHOWN.items()), row["status"]]
        for row in rows])
    text = bullets([counts(rows), unsettled(rows), *extremes(rows, varied(rows, options)), *in_part(rows, options),
                    *failures(rows, options)])
    if compared in options and len(values_of(rows, compared)) > 1:
        text += f"\nBetween neighbouring values of {compared}, everything else equal:\n\n{change_table(rows, compared)}"
    return text + "\n" + folded("All runs", table)
