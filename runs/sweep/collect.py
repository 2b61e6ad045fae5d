"""Collects the runs of the sweep in one table; run by the Snakefile."""

from slipscale.measuring.regime import costs, measures
from slipscale.measuring.window import FEWEST_FOR_MEANS, FEWEST_ROWS, choose_window, cut_away, rows_in, too_few
from slipscale.reading import History, UnreadableRun
from slipscale.running.studies import started_by_snakemake
from slipscale.running.table import collect, write_csv


def result(folder, window):
    """What a run did in `window` (s), or by default in its second half, a failure if that cannot be measured; of few
    rows what they tell, and the reason why the rest is empty."""
    try:
        time = History(folder).time
        begin, end = choose_window(time, window, FEWEST_FOR_MEANS)
        rows = rows_in(time, (begin, end))
        lacks = (too_few(time, (begin, end)) if rows.stop - rows.start < FEWEST_ROWS else "",
                 cut_away(time, window) if window else "")
        reason = "; ".join(filter(None, lacks))
        return {**({"reason": reason} if reason else {}), "window_begin": float(begin), "window_end": float(end),
                **measures(folder, (begin, end), fewest=FEWEST_FOR_MEANS), **costs(folder)}
    except UnreadableRun as error:
        return {"status": "failed", "reason": str(error)}


job = started_by_snakemake(globals())
rows = collect(job.input.outcomes, lambda folder: result(folder, job.params.window))
write_csv(job.output[0], [{**job.params.usual, **row} for row in rows])
