"""Which of many runs no other beats: the Pareto front of error over cost."""


def front(rows, cost, error):
    """Of rows (dicts) that have both columns, those that no other is cheaper and at least as near than; by rising cost.
    Errors count by their size."""
    found, least = [], float("inf")
    known = [row for row in rows if row.get(cost) is not None and row.get(error) is not None]
    for row in sorted(known, key=lambda row: (row[cost], abs(row[error]))):
        if abs(row[error]) < least:
            found.append(row)
            least = abs(row[error])
    return found


def within(rows, cost, error, allowed, bar=None):
    """The cheapest row whose error is at most `allowed`, or its own bar; or None."""
    good = [row for row in rows if row.get(error) is not None and abs(row[error]) <= max(
        allowed, row.get(bar) or 0 if bar else 0)]
    return min(good, key=lambda row: row[cost], default=None)


if __name__ == "__main__":
    raise SystemExit("tradeoff.front is a library, no command: snakemake --snakefile runs/tradeoff/Snakefile runs the "
                     "study.")
