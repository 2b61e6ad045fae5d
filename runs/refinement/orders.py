"""What a refinement study found: order, limit and error bar of every quantity, and what accuracy costs.

A table (see runs/refinement/collect.py) gives a `Refined` for each quantity of each sequence and variant. Two kinds:

- distances to a reference run. The reference is not exact: with an error a h^p on every mesh the distances are
  a (h^p - h_ref^p), which gives p, and the error of the reference itself. A reference on other meshes counts as exact,
  for runs that are clearly coarser.
- averages. Their limit is Richardson's from the three finest values, with an order of 2 at most, that of the scheme;
  the error bar is 1.25 times the extrapolated error (Roache, Verification and Validation, 1998, ch. 5). What two runs
  differ by in all parts of the window alike is a change; what it scatters by from part to part is the least error bar.

Orders are taken between sizes that are about a factor of two apart, as small changes tell little. A sequence that does
not converge has no limit, and says so.
"""

from dataclasses import dataclass

import numpy as np

from slipscale.measuring.convergence import fit_power, observed_order, observed_orders, orders_from_errors, richardson

FORMAL = 2.0  # order of scheme and elements
LEAST = 0.5  # an order below this is none
SPREAD = 1.8  # between sizes that give an order
SAFETY = 1.25
CLOSE = 0.5  # a relative distance above this is not small: unrelated signals are √2 apart
WITHIN = 2.0  # standard errors: smaller changes cannot be told from scatter
CONVERGES, SETTLED, STALLS, APART, SHORT = ("converges", "settled within its scatter", "no order", "no convergence",
                                            "too few runs")


def standard_error(values):
    """Of the mean of [n] values; zero for one."""
    return float(np.std(values, ddof=1) / np.sqrt(len(values))) if len(values) > 1 else 0.0


@dataclass
class Refined:
    """One quantity of one sequence and variant. h falls; arrays [n], errors nan where there is none; `parts` a list of
    [p]. `orders` are those between sizes SPREAD apart, order the last; order, limit and bar are nan where there is
    none."""

    sequence: str
    variant: str
    along: str
    kind: str
    quantity: str
    unit: str
    h: np.ndarray
    values: np.ndarray
    scatter: np.ndarray
    parts: list
    errors: np.ndarray
    seconds: np.ndarray
    node_steps: np.ndarray
    rows: list
    orders: np.ndarray = None
    order: float = float("nan")
    limit: float = float("nan")
    bar: float = float("nan")
    verdict: str = SHORT

    def is_average(self):
        return self.kind == "average"

    def price(self):
        """How many times more node-steps an error needs that is ten times smaller: they grow with h to a power that is
        fitted, errors fall with the order, 2 at most. nan where nothing converges."""
        if self.verdict != CONVERGES or not np.all(np.isfinite(self.node_steps)):
            return float("nan")
        return float(10 ** (-fit_power(self.h, self.node_steps).exponent / min(self.order, FORMAL)))


def apart(h, least):
    """Indices of sizes that are SPREAD apart, the finest among them; all of them when these are fewer than `least`."""
    chosen = [len(h) - 1]
    for k in range(len(h) - 2, -1, -1):
        if h[k] > SPREAD * h[chosen[0]]:
            chosen.insert(0, k)
    return np.array(chosen if len(chosen) >= least else range(len(h)))


def distance_orders(h, errors, reference_h):
    """Between successive distances [n] to the reference at reference_h, to the truth for None: [n-1], nan where there
    is none."""
    if reference_h is None:
        return orders_from_errors(h, errors)
    return np.array([observed_order([*h[k:k + 2], reference_h], [*errors[k:k + 2], 0.0]) for k in range(len(h) - 1)])


def judge_distances(found, reference_h, own):
    """Orders, the error of the reference as `bar`, and the verdict. `own` says whether the reference at reference_h
    belongs to the same refinement."""
    known = np.isfinite(found.errors)
    if reference_h is not None and not own:
        known, reference_h = known & (found.h > SPREAD * reference_h), None
    known = np.flatnonzero(known)
    if len(known) < 2:
        return
    chosen = known[apart(found.h[known], 2)]
    h, errors = found.h[chosen], found.errors[chosen]
    found.orders = distance_orders(h, errors, reference_h)
    found.verdict = APART if errors[-1] > CLOSE else STALLS
    if found.verdict == STALLS and found.orders[-1] > LEAST and np.all(np.diff(found.errors[known[-3:]]) < 0):
        found.verdict, found.order = CONVERGES, float(found.orders[-1])
        if reference_h is not None:
            found.bar = float(errors[-1] / np.expm1(found.order * np.log(h[-1] / reference_h)))


def judge_averages(found, known=None):
    """Orders, limit, error bar, verdict and errors; `known` is the exact limit."""
    chosen = apart(found.h, 3)
    if len(chosen) < (3 if known is None else 2):
        return
    h, values = found.h[chosen], found.values[chosen]
    scatter = [change_scatter(found, *pair) for pair in zip(chosen, chosen[1:])]
    if known is not None:
        found.errors = np.abs(found.values - known)
        found.orders = orders_from_errors(h, values - known)
        settled = found.errors[-1] <= WITHIN * found.scatter[-1]
        found.limit, found.bar = known, 0.0
    else:
        found.orders = observed_orders(h, values)
        settled = np.all(np.abs(np.diff(values)[-2:]) <= WITHIN * np.array(scatter[-2:]))
    order = float(found.orders[-1])
    found.verdict = SETTLED if settled else CONVERGES if order > LEAST else STALLS
    if found.verdict == CONVERGES:
        found.order = order
    if known is None and found.verdict != STALLS:
        found.limit, found.bar = limit_of(h, values, found.order, scatter[-1])
        found.errors = np.abs(found.values - found.limit)
        if found.verdict == SETTLED:
            found.errors[-1] = np.nan  # it is the limit


def change_scatter(found, coarse, fine):
    """Standard error of the change between two runs, from the parts of the window: what both share drops out."""
    own, other = found.parts[coarse], found.parts[fine]
    return standard_error(own - other) if len(own) == len(other) else 0.0


def limit_of(h, values, order, scatter):
    """Limit and error bar; the finest value and the range of the last three without an order."""
    if np.isnan(order):
        return float(values[-1]), max(float(np.ptp(values[-3:])), scatter)
    found = richardson(h, values, min(order, FORMAL))
    return found.limit, max(SAFETY * abs(found.error), scatter)


def parts_of(row):
    """Its values in the parts of the window [p], none when it has none."""
    return np.array([] if row.get("parts") is None else str(row["parts"]).split(), dtype=float)


def refine(rows, reference_h=None, known=None, own=True):
    """`Refined` of rows (dicts) of one quantity, in any order; see `judge_distances` and `judge_averages`."""
    rows = sorted(rows, key=lambda row: -row[row["along"]])
    first = rows[0]

    def column(name):
        return np.array([np.nan if row.get(name) is None else row[name] for row in rows], dtype=float)

    found = Refined(*(str(first[name]) for name in ("sequence", "variant", "along", "kind", "quantity", "unit")),
                    h=column(first["along"]), values=column("value"), scatter=column("scatter"),
                    parts=[parts_of(row) for row in rows], errors=column("error"), seconds=column("seconds"),
                    node_steps=column("node_steps"), rows=rows)
    judge_averages(found, known) if found.is_average() else judge_distances(found, reference_h, own)
    return found


def found_in(rows):
    """A list of `Refined`, one for each quantity, variant and sequence of a table, in its order."""
    groups = {}
    for row in rows:
        if row["status"] == "ok" and row["quantity"]:
            groups.setdefault((row["sequence"], row["variant"], row["kind"], row["quantity"]), []).append(row)
    return [refine(group, group[0].get("reference_h"), group[0].get("known"), group[0].get("reference_own", 1))
            for group in groups.values()]


def summary_rows(found):
    """A row for each `Refined`: a table of orders."""
    return [{"sequence": each.sequence, "variant": each.variant, "along": each.along, "kind": each.kind,
             "quantity": each.quantity, "unit": each.unit, "runs": len(each.h), "finest": each.h[-1],
             "orders": " ".join(f"{order:.3f}" for order in each.orders) if each.orders is not None else None,
             "order": each.order, "limit": each.limit, "error_bar": each.bar, "verdict": each.verdict,
             "price": each.price()} for each in found]


if __name__ == "__main__":
    raise SystemExit("refinement.orders is a library, no command: snakemake --snakefile runs/refinement/Snakefile runs "
                     "the study.")
