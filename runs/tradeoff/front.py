"""Which of many runs no other beats: the Pareto front of error over cost."""


def front(rows, cost, error, bar=None):
    """Of rows (dicts) that have both columns, those that no other is cheaper and at least as near than; by rising cost.
    Errors count by their size, and as no smaller than the column `bar`, what they are known to."""
    found, least = [], float("inf")
    known = [row for row in rows if row.get(cost) is not None and row.get(error) is not None]
    for row in sorted(known, key=lambda row: (row[cost], size_of(row, error, bar))):
        if size_of(row, error, bar) < least:
            found.append(row)
            least = size_of(row, error, bar)
    return found


def size_of(row, error, bar=None):
    """Of an error, or of what it is known to where that is more."""
    return max(abs(row[error]), row.get(bar) or 0.0) if bar else abs(row[error])


def within(rows, cost, error, allowed, bar=None):
    """The cheapest row whose error is at most `allowed`, or its own bar; or None."""
    good = [row for row in rows if row.get(error) is not None and abs(row[error]) <= max(
        allowed, row.get(bar) or 0 if bar else 0)]
    return min(good, key=lambda row: row[cost], default=None)


if __name__ == "__main__":
    raise SystemExit("tradeoff.front is a library, no command: snakemake --snakefile runs/tradeoff/Snakefile runs the "
                     "study.")
