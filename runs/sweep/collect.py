"""Collects the runs of the sweep in one table; run by the Snakefile."""

from slipscale.measuring.regime import costs, measures
from slipscale.measuring.window import choose_window
from slipscale.reading import History, UnreadableRun
from slipscale.running.table import collect, write_csv


def result(folder, window):
    """What a run did in `window` (s), or by default in its second half; a failure if that cannot be measured."""
    try:
        begin, end = choose_window(History(folder).time, window)
        return {"window_begin": float(begin), "window_end": float(end), **measures(folder, (begin, end)),
                **costs(folder)}
    except UnreadableRun as error:
        return {"status": "failed", "reason": str(error)}


job = snakemake  # noqa: F821
rows = collect(job.input.outcomes, lambda folder: result(folder, job.params.window))
write_csv(job.output[0], [{**job.params.usual, **row} for row in rows])
