"""Tables of the study in Markdown, put between marks in README.md; run by the Snakefile."""

from pathlib import Path

from plan.kept import SECONDS_ALLOWED
from slipscale.reports.publish import publish
from slipscale.running.studies import started_by_snakemake
from slipscale.running.table import is_true, markdown, read_csv


def percent(value):
    return "-" if value is None else f"{100 * value:.2g}"


def wishes_table(rows):
    lines = [[row["scene"], row["wish"], percent(row["wished"]), percent(row["promised"]),
              "-" if row["value"] is None else f"{row['value']:.5g}", "-" if row["finer"] is None else f"{row['finer']:.5g}",
              percent(row["finer_error"]), f"{100 * row['apart']:+.2g}",
              "yes" if is_true(row["within"]) else "with its scatter" if is_true(row["holds"]) else "**no**",
              percent(row["between_morphologies"])] for row in rows]
    return markdown(["scene", "result", "wished [%]", "promised [%]", "proposed run", "twice finer", "± of it [%]",
                     "apart [%]", "kept", "between morphologies [%]"], lines)


def costs_table(rows):
    first = {row["scene"]: row for row in reversed(rows)}
    lines = [[name, f"{row['cell']}, {1e6 * row['size']:.0f} µm", f"{1e9 * row['step']:.3g}", f"{row['windows']:g}",
              f"{row['pilot_seconds_announced']:.2g} / {row['pilot_seconds']:.2g}",
              f"{row['seconds_said']:.3g} / {row['seconds']:.3g}", f"{row['seconds_finer']:.3g}",
              f"{1e-6 * row['memory_said']:.0f} / {1e-6 * row['memory']:.0f}",
              f"{1e-6 * row['disk_said']:.2g} / {1e-6 * row['disk']:.2g}"] for name, row in first.items()]
    return markdown(["scene", "cells", "step [ns]", "windows", "pilots [s]: said / taken", "run [s]: said / taken",
                     "twice finer [s]", "memory [MB]: said / taken", "disk [MB]: said / taken"], lines)


def text_of(rows, scenes):
    ok = [row for row in rows if row["status"] == "ok"]
    held, within = sum(is_true(row["holds"]) for row in ok), sum(is_true(row["within"]) for row in ok)
    seconds = {row["scene"]: row["seconds"] / row["seconds_said"] for row in ok}
    near = sum(abs(ratio - 1) <= SECONDS_ALLOWED for ratio in seconds.values())
    lines = [f"Of {len(ok)} wishes {held} hold, {within} of them without the scatter of the finer run; the seconds are "
             f"within {100 * SECONDS_ALLOWED:.0f} % for {near} of {len(seconds)} scenes.\n"]
    if ok:
        lines += [wishes_table(ok), "\n", costs_table(ok)]
    lines += ["\n", *(f"- {name}: {scene['what']}; wished for {scene['want'].replace(',', ', ')}.\n"
                      for name, scene in scenes.items() if name in {row["scene"] for row in rows})]
    lines += [f"- {row['scene']} {'refused' if row['status'] == 'refused' else 'failed'}: {row['reason']}.\n"
              for row in rows if row["status"] != "ok"]
    return "".join(lines)


if "snakemake" in globals():
    job = started_by_snakemake(globals())
    drawn = Path(job.input[0]).parent / job.params.shown / "plan" / "plan.png"
    publish(text_of(read_csv(job.input[0]), job.params.scenes), job.output[0], job.params.readme,
            [drawn] if drawn.is_file() else [])
elif __name__ == "__main__":
    started_by_snakemake(globals())
