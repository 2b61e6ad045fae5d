"""Says in Markdown what the table of the study holds, for the README; run by the Snakefile."""

import numpy as np

from slipscale.reports.publish import bullets, failures, folded, publish
from slipscale.running.studies import started_by_snakemake
from slipscale.running.table import is_true, markdown, read_csv

RUN = ("regime", "mesh", "seed", "height")
ERRORS = {"friction_off": ("friction off", ".4f", 1), "frequency_off": ("frequency off [%]", ".2f", 100),
          "amplitude_off": ("amplitude off [%]", ".0f", 100), "spectrum_distance": ("distance of spectrum", ".2f", 1),
          "mean_stress_distance": ("of σ_yy, mean", ".4f", 1), "deviation_distance": ("deviation", ".3f", 1)}

COSTS = {"nodes": "nodes", "steps": "steps", "node_steps": "node-steps", "seconds": "seconds"}


def groups_of(rows):
    """Rows by regime, mesh and height, in that order."""
    groups = {}
    for row in sorted(rows, key=lambda row: (row["regime"], row["mesh"], row["height"])):
        groups.setdefault((row["regime"], row["mesh"], row["height"]), []).append(row)
    return groups


def median_and_most(rows, name, form, factor):
    found = [abs(row[name]) for row in rows if row[name] is not None]
    return f"{factor * np.median(found):{form}} ({factor * max(found):{form}})" if found else "-"


def scatter_of_whole(groups, name):
    """Of the whole composites of a regime, what a measure varies by between morphologies."""
    return {key[:2]: float(np.std([row[name] for row in rows])) for key, rows in groups.items()
            if key[2] == max(height for _, _, height in groups)}


def missed_table(groups):
    lines = []
    for (regime, mesh, height), rows in groups.items():
        whole = max(of for r, m, of in groups if (r, m) == (regime, mesh))
        costs = [np.median([row[name] for row in rows]) / np.median([row[name] for row in groups[regime, mesh, whole]])
                 for name in COSTS]
        shown = ["-"] * len(ERRORS) if height == whole else [median_and_most(rows, name, form, factor)
                                                            for name, (_, form, factor) in ERRORS.items()]
        lines.append([regime, mesh, f"{height:g}", len(rows), *shown, *(f"{cost:.2f}" for cost in costs)])
    return markdown(["regime", "mesh", "height [mm]", "morphologies", *(words for words, *_ in ERRORS.values()),
                     *COSTS.values()], lines)


def scatter_lines(groups):
    for (regime, mesh), off in scatter_of_whole(groups, "friction").items():
        kilohertz = 1e-3 * scatter_of_whole(groups, "frequency")[regime, mesh]
        yield (f"{regime}, {mesh}: between whole composites of other seeds friction varies by {off:.4f}, frequency by "
               f"{kilohertz:.1f} kHz (standard deviations).")


def run_table(rows):
    return markdown([*RUN, "T / N", "± of the window", "frequency [kHz]", "amplitude", "regime", "settled", "nodes",
                     "step [ns]", "seconds"],
                    [[*(row[name] for name in RUN), f"{row['friction']:.4f}", f"{row['friction_error']:.4f}",
                      f"{1e-3 * row['frequency']:.1f}", f"{row['amplitude']:.3f}", row["regime_seen"],
                      "yes" if is_true(row["settled"]) else "no", row["nodes"], f"{1e9 * row['step']:.2f}",
                      f"{row['seconds']:.2f}"]
                     for row in rows])


def report(rows):
    good = [row for row in rows if row["status"] == "ok"]
    groups = groups_of(good)
    return f"""What a run misses of that of the whole composite with the same seed, in absolute value: median over
morphologies (the most). Height 0 is the homogenised block, the largest the whole composite. Nodes, steps, node-steps and seconds of
one core (start and statistics included) are over those of the whole, medians of both.

{missed_table(groups)}
{bullets([*scatter_lines(groups), *failures(rows, RUN)])}
{folded("All runs", run_table(good))}"""


job = started_by_snakemake(globals())
publish(report(read_csv(job.input.table)), job.output[0], job.params.readme, [job.input.picture])
