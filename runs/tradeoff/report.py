"""Tables of the study in Markdown, put between marks in README.md; run by the Snakefile."""

import numpy as np

from slipscale.reports.publish import failures, folded, publish
from slipscale.running.studies import started_by_snakemake
from slipscale.running.table import is_true, markdown, read_csv
from tradeoff.ends import ENDS, ends_of
from tradeoff.front import within
from tradeoff.picture import OTHER_SCENES

ERRORS = ("friction", "frequency", "amplitude", "stick", "open", "velocity", "displacement", "stress_matrix",
          "stress_inclusion")
OPTIONS = ("case", "cell", "size", "safety", "beta2", "damping", "storage", "every", "model", "height", "young", "diameter",
           "seed")
TURNED = {"cells": ("cell",), "sizes": ("size",), "steps": ("safety",), "beta2": ("beta2",), "damping": ("damping",),
          "storage": ("storage",), "cadence": ("every",), "models": ("model",), "heights": ("height",),
          "together": ("cell", "size", "safety")}

ALLOWED = {"frequency": (0.01, 0.003, 0.001), "spectrum": (0.2, 0.1, 0.05), "stress_inclusion": (0.1, 0.03, 0.01)}


def off(row, name):
    """Per cent, with its bar."""
    value, bar = row.get(f"{name}_off"), row.get(f"{name}_bar")
    return "-" if value is None else f"{100 * value:+.2g} ± {100 * bar:.1g}"


def regime(row):
    return row["regime"] + ("" if is_true(row["settled"]) else ", not settled")


def setting(row):
    return ", ".join(str(row[name]) for name in TURNED[row["knob"]])


def knobs_table(rows):
    lines = []
    for row in rows:
        lines.append([row["case"], row["knob"], setting(row), *(off(row, name) for name in ERRORS),
                      "-" if row.get("spectrum_off") is None else f"{row['spectrum_off']:.2g} ({row['spectrum_bar']:.1g})",
                      regime(row), f"{row['seconds']:.2g}", f"{row['node_steps']:.2g}",
                      f"{1e-6 * row['memory']:.0f}", f"{1e-6 * row['disk']:.2g}"])
    return markdown(["case", "knob", "set to", *(name.replace("_", " ") for name in ERRORS), "spectrum", "regime", "seconds",
                     "node-steps", "MB memory", "MB disk"], lines)


def extremes_table(rows):
    """Of each contrast and size of the discs: what the homogenised block is off, against what seeds differ by."""
    lines, keys = [], dict.fromkeys((row["young"], row["diameter"]) for row in rows)
    for young, diameter in keys:
        of = [row for row in rows if (row["young"], row["diameter"]) == (young, diameter)]
        whole = [row for row in of if row["model"] == "whole"]
        other = [row for row in of if row["model"] != "whole" and row.get("friction_off") is not None]
        if len(whole) < 2 or not other:
            continue
        spread = {name: np.ptp([row[name] for row in whole]) / abs(np.mean([row[name] for row in whole]))
                  for name in ("friction", "frequency")}
        missed = {name: max(abs(row[f"{name}_off"]) for row in other) for name in ("friction", "frequency")}
        cheaper = np.median([row["seconds"] for row in whole]) / np.median([row["seconds"] for row in other])
        lines.append([young, f"{other[0]['height'] / diameter:g}", f"{100 * missed['friction']:.2g}",
                      f"{100 * spread['friction']:.2g}", f"{100 * missed['frequency']:.2g}",
                      f"{100 * spread['frequency']:.2g}", f"{max(row['spectrum_off'] for row in other):.2g}",
                      f"{cheaper:.2g}", sum(not is_true(row["settled"]) for row in of),
                      "yes" if all(missed[name] <= max(spread[name], 0.02) for name in missed) else "no"])
    return markdown(["inclusions [GPa]", "discs per height", "friction off [%]", "seeds apart [%]", "frequency off [%]",
                     "seeds apart [%]", "spectrum", "times cheaper", "not settled", "worth it"], lines)


def ends_table(rows):
    lines = [[end["case"], end["knob"], end["from"], end["to"],
              f"{end['most']} {100 * end['change']:+.2g} ± {100 * end['scatter']:.1g}",
              "-" if end["frequency"] is None else f"{100 * end['frequency']:+.2g}", f"{100 * end['bulk']:+.2g}",
              end["beyond"] or "none", f"{end['seconds']:.2f}"] for end in ends_of(rows)]
    return markdown(["case", "knob", "from", "to", "changes most [%]", "frequency [%]", "bulk [%]",
                     "more than two scatters [%]", "seconds"], lines)


def named(row):
    """A run by its price, its knob and where that stands."""
    return f"{row['seconds']:.2g} s: {row['knob']} {setting(row)}"


def cheapest_table(rows):
    """The cheapest run of each case within an error, of those of the whole microstructure in the same scene: what another
    model is off by is chance, and no choice."""
    lines = []
    for name, allowed in ALLOWED.items():
        for case in dict.fromkeys(row["case"] for row in rows):
            of = [row for row in rows if row["case"] == case and row["knob"] not in (*OTHER_SCENES, "models")]
            if not any(row.get(f"{name}_off") is not None for row in of):
                continue
            found = [within(of, "seconds", f"{name}_off", most) for most in allowed]
            lines.append([name.replace("_", " "), case, *("-" if row is None else named(row) for row in found)])
    return markdown(["error in", "case", *("wide", "middle", "narrow")], lines)


def text_of(rows):
    ok = [row for row in rows if row["status"] == "ok"]
    knobs = [row for row in ok if row["knob"] in TURNED]
    text = ("Errors in per cent of the reference (the same drawing on a grid of the reference's size at half the step), ± the "
            "standard error over time of both; the spectrum's distance (that of the halves of one window); seconds of one "
            "core, start included.\n\n")
    for case in dict.fromkeys(row["case"] for row in knobs):
        text += folded(f"{case}: every knob", knobs_table([row for row in knobs if row["case"] == case])) + "\n"
    if knobs:
        errors = "; ".join(f"{name.replace('_', ' ')} {', '.join(f'{100 * most:g}' for most in allowed)} %"
                           for name, allowed in ALLOWED.items())
        text += ("What a second buys: seconds and setting of the cheapest run of the whole microstructure within an error, "
                 f"wide, middle and narrow: {errors}.\n\n{cheapest_table(knobs)}\n")
    if extremes := [row for row in ok if row["knob"] not in TURNED]:
        text += ("Where the homogenised block is no longer worth it: off by more than two seeds are apart, or 2 %; the most of "
                 "both seeds, and how many of the four runs had not settled.\n\n" +
                 extremes_table(extremes))
    if any(row["knob"] in ENDS for row in knobs):
        text += ("\nWhat step, storage and the moduli of the homogenised block change on one mesh: of the contact's quantities "
                 "that which changes most, those that change by more than twice their scatter over time, of the bulk's the "
                 "most; seconds over those of `from`.\n\n" + ends_table(knobs))
    if failed := list(failures(rows, OPTIONS)):
        text += "\n" + folded("Runs that failed", "".join(f"- {line}\n" for line in failed))
    return text


if "snakemake" in globals():
    job = started_by_snakemake(globals())
    publish(text_of(read_csv(job.input.table)), job.output[0], job.params.readme, [job.input.picture])
elif __name__ == "__main__":
    started_by_snakemake(globals())
