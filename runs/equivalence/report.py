"""Says in Markdown what the tables of the study hold, for the README; run by the Snakefile."""

from collections import Counter

from equivalence.verdict import ALIKE, FLOORS, SCALARS, VERDICTS
from slipscale.pictures.scales import values_of
from slipscale.reports.publish import bullets, failures, folded, publish
from slipscale.running.studies import started_by_snakemake
from slipscale.running.table import is_true, markdown, read_csv

FORMS = {"friction": (1, ".3f"), "frequency": (1e-3, ".1f"), "amplitude": (1, ".3f"), "stick": (1, ".3f"),
         "open": (1, ".3f"), "velocity": (1, ".2f"), "power_ratio": (1, ".3f")}
HEADS = {"friction": "friction", "frequency": "frequency [kHz]", "amplitude": "its amplitude", "stick": "stick",
         "open": "open", "velocity": "rms velocity of M [m/s]", "power_ratio": "power into body / drive"}
PURE = ("friction", "frequency", "amplitude", "stick", "open", "power_ratio")  # the same in any units of load and speed
SETTLED = ("settled", "amplitude ratio")
POINT = ("block", "phases", "refine", "coefficient", "speed", "load", "memory", "window")


def in_form(measure, value):
    factor, form = FORMS[measure]
    return f"{factor * value:{form}}"


def marked(row, measure, text):
    """What does not lie within the scatter stands out."""
    return text if is_true(row[f"{measure}_within"]) else f"**{text}**"


def place(row, names):
    return [row[name] for name in names]


def figure_table(points):
    """A column for each of `points`, rows by heading; distances of the homogenised block / what the scatter allows, and
    numbers of both models."""
    lines = [["verdict", *(row["verdict"] for row in points.values())]]
    for measure in ("spectrum", "portrait"):
        lines.append([f"distance of {measure}", *(
            marked(row, measure, f"{row[f'{measure}_apart']:.3f} / {row[f'{measure}_limit']:.3f}")
            for row in points.values())])
    for measure in SCALARS:
        lines.append([HEADS[measure], *(marked(row, measure, " → ".join(
            in_form(measure, row[f"{measure}_{kind}"]) for kind in ("composites", "homogenised"))
            + f" (± {in_form(measure, row[f'{measure}_limit'])})") for row in points.values())])
    return markdown(["", *points], lines)


def kilohertz(modes):
    """Modes in Hz as text, runs divided by '; ' and their modes by ' + ', in kHz."""
    return "; ".join(" + ".join(f"{float(mode) / 1e3:.0f}" for mode in run.split(" + ") if mode)
                     for run in str(modes or "").split("; "))


def map_table(points, names):
    lines = [[*place(row, names), row["verdict"],
              f"{row['spectrum_apart']:.2f} / {row['spectrum_limit']:.2f}",
              *(kilohertz(row[f"{kind}_modes"]) for kind in ("composite", "homogenised")),
              *(", ".join(in_form(measure, row[f"{measure}_{kind}"]) for kind in ("composites", "homogenised"))
                for measure in ("friction", "amplitude", "stick", "open", "power_ratio")), *settled(row)]
             for row in points]
    return markdown([*names, "verdict", "spectrum", "modes, composites [kHz]", "homogenised", "friction", "amplitude",
                     "stick", "open", "power", *SETTLED], lines)


def settled(row):
    """Of a run, or of the runs of a point; the ratio is then that furthest from 1."""
    return "yes" if is_true(row["settled"]) else "no", f"{row['amplitude_ratio']:.2f}"


def run_table(rows, names):
    lines = [[*place(row, names), *(in_form(measure, row[measure]) for measure in SCALARS), row["regime"],
              *settled(row), f"{row['wall_seconds']:.0f}"] for row in rows]
    return markdown([*names, *(HEADS[measure] for measure in SCALARS), "regime", *SETTLED, "seconds"], lines)


def counts(points):
    """How often each verdict was found."""
    for memory in values_of(points, "memory"):
        members = [row for row in points if row["memory"] == memory]
        for block in values_of(members, "block"):
            found = [row for row in members if row["block"] == block]
            number = Counter(row["verdict"] for row in found)
            said = ", ".join(f"{number[name]} {name}" for name in VERDICTS if number[name])
            yield f"Memory {memory}, block {block}, {len(found)} points: {said}."
    moving = sum(not is_true(row["settled"]) for row in points)
    if points:
        yield (f"At {moving} of {len(points)} points some run had not settled in its window, by the rule of "
               "summary.yaml.")


def worst_of(one, other):
    return max((abs(one[name] - other[name]) / max(abs(one[name]), 1e-300), name) for name in PURE)


def proportional(rows):
    """Pairs of runs that differ in speed and load by the same factor."""
    names = ("model", "seed", *(name for name in POINT if name not in ("speed", "load")))
    for k, one in enumerate(rows):
        for other in rows[k + 1:]:
            low, high = sorted((one, other), key=lambda row: row["speed"])
            factor = high["speed"] / low["speed"]
            if (factor > 1 and high["load"] == factor * low["load"] and low["memory"].startswith("T")
                    and all(one[name] == other[name] for name in names)):
                apart, name = worst_of(low, high)
                yield (f"Speed {low['speed']} and load {low['load']} against speed {high['speed']} and load "
                       f"{high['load']} (coefficient {low['coefficient']}, {low['model']} {low['seed']}): "
                       f"{', '.join(PURE)} differ by at most {apart:.1e} of their size"
                       f"{f' ({name})' if apart else ''}.")


def same_point(row, point, names):
    return all(row[name] == point[name] for name in names)


def report(rows, points, figures):
    """`figures` are points (dicts of options) by name."""
    ran, judged = ([row for row in table if row["status"] == "ok"] for table in (rows, points))
    but_mesh = [name for name in POINT if name != "refine"]
    shown = {f"{name}, refine {row['refine']}": row for name, point in figures.items() for row in judged
             if same_point(row, point, but_mesh)}
    mapped = [row for row in judged if row not in shown.values()]
    names = ["refine", "coefficient", "speed", "load", "memory"]
    in_map = ["coefficient", "load", "speed", "memory", "block"]
    runs = [row for row in ran if any(same_point(row, point, but_mesh) for point in figures.values())]
    lines = [*counts(mapped), *proportional(ran), *failures(rows, ("model", "seed", *POINT)),
             *(f"No verdict: {', '.join(f'{name} {row[name]}' for name in POINT)}: {row['reason']}"
               for row in points if row["status"] != "ok")]
    floors = ", ".join(f"{name.replace('_', ' ')} {floor:g}" for name, floor in FLOORS.items())
    return f"""Several morphologies and the homogenised block of each; `refine` 1 halves the mesh. Distances: of the
typical (median) homogenised block to the mean of the morphologies / the largest of a morphology to the mean of the
others, which is what is allowed. Numbers: mean of the morphologies → typical homogenised block, in brackets how far
apart they may be. Bold is what lies outside. A run has settled by the rule of summary.yaml; amplitude ratio: second
half of the window over the first, of a point that furthest from 1.

{figure_table(shown)}
{bullets(lines)}
Allowed is at least (SI units): {floors}. Morphologies whose spectra scatter by more than {ALIKE} are not alike,
and nothing is equivalent to them.

{folded("All points of the maps (composites, homogenised)", map_table(mapped, in_map))}
{folded("All runs of the figures", run_table(runs, ["model", "seed", *names]))}"""


job = started_by_snakemake(globals())
publish(report(read_csv(job.input.runs), read_csv(job.input.points), job.params.figures), job.output[0],
        job.params.readme, job.input.pictures)
