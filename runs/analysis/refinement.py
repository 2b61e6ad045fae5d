"""What a refinement study found: order, limit and error bar of every quantity, and what accuracy costs.

A table (see runs/refinement/collect.py) gives a `Refined` for each quantity of each sequence and variant. Two kinds:

- distances to a reference run. The reference is not exact: with an error a h^p on every mesh the distances are
  a (h^p - h_ref^p), which gives p, and the error of the reference itself.
- averages. Their limit is Richardson's from the three finest values, with an order of 2 at most, that of the scheme;
  the error bar is 1.25 times the extrapolated error (Roache, Verification and Validation, 1998, ch. 5), and never less
  than the scatter of the parts of the window: averages of a limit cycle are measurements.

A sequence that does not converge has no limit, and says so.
"""

from dataclasses import dataclass

import numpy as np

from analysis.convergence import fit_power, observed_order, observed_orders, orders_from_errors, richardson

FORMAL = 2.0  # order of scheme and elements
SAFETY = 1.25
CLOSE = 0.5  # a relative distance above this is not small: unrelated signals are √2 apart
WITHIN = 2.0  # scatters: smaller changes cannot be told from it
CONVERGES, SETTLED, DRIFTS, APART, SHORT = ("converges", "settled within its scatter", "no order", "no convergence",
                                            "too few runs")


@dataclass
class Refined:
    """h falls; arrays [n], errors nan where there is none. `reference_h`: of the reference run, in the same family, or
    None. order, limit and bar are nan where there is none."""

    sequence: str
    variant: str
    along: str
    kind: str
    quantity: str
    unit: str
    h: np.ndarray
    values: np.ndarray
    scatter: np.ndarray
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
        fitted, errors fall with the order. nan where nothing converges."""
        if self.verdict != CONVERGES or not np.all(np.isfinite(self.node_steps)):
            return float("nan")
        return float(10 ** (-fit_power(self.h, self.node_steps).exponent / self.order))


def distance_order(h, errors, reference_h):
    """Order from two distances to the reference at reference_h; to the truth for None. nan where there is none."""
    if reference_h is None:
        return float(orders_from_errors(h, errors)[0])
    return observed_order([*h, reference_h], [*errors, 0.0])


def judge_distances(found, reference_h):
    """Orders, the error of the reference as `bar`, and the verdict; the reference's own row stands last when it is one
    of the sequence."""
    known = np.isfinite(found.errors)
    h, errors = found.h[known], found.errors[known]
    found.orders = np.array([distance_order(h[k:k + 2], errors[k:k + 2], reference_h) for k in range(len(h) - 1)])
    if len(h) < 2:
        return
    first = max(0, len(h) - 3)
    found.order = distance_order(h[[first, -1]], errors[[first, -1]], reference_h)
    falls = np.all(np.diff(errors[first:]) < 0)
    found.verdict = CONVERGES if falls and errors[-1] < CLOSE and found.order > 0 else APART
    if found.verdict == CONVERGES and reference_h is not None:
        found.bar = float(errors[-1] / np.expm1(found.order * np.log(h[-1] / reference_h)))


def judge_averages(found, known=None):
    """Orders, limit, error bar, verdict and errors of averages; `known` is the exact limit."""
    h, values = found.h, found.values
    scatter = float(np.max(found.scatter[-3:]))
    if known is not None:
        found.errors = np.abs(values - known)
        found.orders = orders_from_errors(h, found.errors)
        found.order = float(orders_from_errors(h[[max(0, len(h) - 3), -1]], found.errors[[max(0, len(h) - 3), -1]])[0])
        found.limit, found.bar = known, 0.0
        found.verdict = CONVERGES if found.order > 0 else SETTLED if found.errors[-1] <= WITHIN * scatter else DRIFTS
        return
    if len(h) < 3:
        return
    found.orders = observed_orders(h, values)
    changes = np.abs(np.diff(values[-3:]))
    order = found.orders[-1]
    if np.all(changes <= WITHIN * scatter):
        found.verdict, found.limit = SETTLED, float(values[-1])
        found.bar = max(scatter, float(np.ptp(values[-3:])))
    elif order > 0:
        found.verdict, found.order = CONVERGES, float(order)
        limit = richardson(h, values, min(order, FORMAL))
        found.limit, found.bar = limit.limit, max(SAFETY * abs(limit.error), scatter)
    else:
        found.verdict = DRIFTS
    if np.isfinite(found.limit):
        found.errors = np.abs(values - found.limit)
        if found.verdict == SETTLED:
            found.errors[-1] = np.nan  # it is the limit


def refine(rows, reference_h=None, known=None):
    """`Refined` of rows (dicts) of one quantity, in any order."""
    rows = sorted(rows, key=lambda row: -row[row["along"]])
    first = rows[0]

    def column(name):
        return np.array([np.nan if row.get(name) is None else row[name] for row in rows], dtype=float)

    found = Refined(*(str(first[name]) for name in ("sequence", "variant", "along", "kind", "quantity", "unit")),
                    h=column(first["along"]), values=column("value"), scatter=column("scatter"), errors=column("error"),
                    seconds=column("seconds"), node_steps=column("node_steps"), rows=rows)
    judge_averages(found, known) if found.is_average() else judge_distances(found, reference_h)
    return found


def found_in(rows):
    """A list of `Refined`, one for each quantity, variant and sequence of a table, in its order."""
    groups = {}
    for row in rows:
        if row["status"] == "ok" and row["quantity"]:
            groups.setdefault((row["sequence"], row["variant"], row["kind"], row["quantity"]), []).append(row)
    return [refine(group, group[0].get("reference_h"), group[0].get("known")) for group in groups.values()]


def summary_rows(found):
    """A row for each `Refined`: a table of orders."""
    return [{"sequence": each.sequence, "variant": each.variant, "along": each.along, "kind": each.kind,
             "quantity": each.quantity, "unit": each.unit, "runs": len(each.h), "finest": each.h[-1],
             "orders": " ".join(f"{order:.3f}" for order in each.orders) if each.orders is not None else None,
             "order": each.order, "limit": each.limit, "error_bar": each.bar, "verdict": each.verdict,
             "price": each.price()} for each in found]
