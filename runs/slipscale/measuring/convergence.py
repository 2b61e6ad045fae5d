"""Order and limit of a sequence of refinements, and powers fitted to measurements.

Sizes h are those of the elements (or time steps), any unit, and fall along the sequence; values are whatever was
computed on them. After Roache, Verification and Validation in Computational Science and Engineering (1998), ch. 5.
"""

from dataclasses import dataclass

import numpy as np

STEEPEST = 50.0  # orders looked for lie between minus and plus this


def orders_from_errors(h, errors):
    """Order between successive sizes, log(e_k/e_{k+1})/log(h_k/h_{k+1}): [n] and [n] give [n-1].

    Only the size of an error counts; where one is zero there is no order (nan).
    """
    h, errors = falling(h), np.abs(np.asarray(errors, dtype=float))
    known = (errors[:-1] > 0) & (errors[1:] > 0)
    ratio = np.divide(errors[:-1], errors[1:], out=np.full(len(h) - 1, np.nan), where=known)
    return np.log(ratio) / np.log(h[:-1] / h[1:])


def observed_order(h, values):
    """Order p of v(h) = v_0 + a h^p through three values, v_0 unknown: solves
    (v_1 - v_2)/(v_2 - v_3) = (h_1^p - h_2^p)/(h_2^p - h_3^p).

    nan where no such p exists: the differences change sign or vanish, so the sequence is not in its asymptotic range.
    """
    h, values = falling(h), np.asarray(values, dtype=float)
    if len(h) != 3:
        raise ValueError("an order without a known limit needs exactly three sizes")
    first, second = values[0] - values[1], values[1] - values[2]
    if not first * second > 0:
        return float("nan")
    coarse, fine = np.log(h[0] / h[1]), np.log(h[1] / h[2])

    def quotient(p):  # of the differences, grows with p
        return coarse / fine if p == 0 else np.expm1(p * coarse) / -np.expm1(-p * fine)

    low, high = -STEEPEST, STEEPEST
    if not quotient(low) < first / second < quotient(high):
        return float("nan")
    while high - low > 1e-13 * STEEPEST:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if quotient(middle) < first / second else (low, middle)
    return 0.5 * (low + high)


def observed_orders(h, values):
    """`observed_order` of every three successive sizes: [n] and [n] give [n-2]."""
    return np.array([observed_order(h[k:k + 3], values[k:k + 3]) for k in range(len(h) - 2)])


@dataclass
class Extrapolated:
    """What a sequence tends to, and the estimated error of its finest value (value - limit)."""

    limit: float
    error: float


def richardson(h, values, order):
    """Richardson's extrapolation from the two finest sizes, for a leading error term h^order, order > 0."""
    h = falling(h)
    if not (len(h) >= 2 and order > 0):
        raise ValueError("Richardson's extrapolation needs two sizes and a positive order")
    error = (values[-2] - values[-1]) / np.expm1(order * np.log(h[-2] / h[-1]))
    return Extrapolated(float(values[-1] - error), float(error))


@dataclass
class Power:
    """y = factor x^exponent, fitted; `spread` is the standard error of the exponent, nan from two points."""

    factor: float
    exponent: float
    spread: float

    def __call__(self, x):
        return self.factor * np.asarray(x, dtype=float) ** self.exponent


def fit_power(x, y):
    """Least squares in the logarithms of positive x [n] and y [n], at least two of them different in x."""
    x, y = np.log(np.asarray(x, dtype=float)), np.log(np.asarray(y, dtype=float))
    if len(x) < 2 or np.ptp(x) == 0 or not np.all(np.isfinite([x, y])):
        raise ValueError("a power is fitted to positive values at two or more different places")
    apart = x - x.mean()
    exponent = apart @ y / (apart @ apart)
    misfit = y - y.mean() - exponent * apart
    spread = np.sqrt(misfit @ misfit / (len(x) - 2) / (apart @ apart)) if len(x) > 2 else float("nan")
    return Power(float(np.exp(y.mean() - exponent * x.mean())), float(exponent), float(spread))


def falling(h):
    """h as an array; ValueError unless it is positive and falls."""
    h = np.asarray(h, dtype=float)
    if not (np.all(h > 0) and np.all(np.diff(h) < 0)):
        raise ValueError("sizes have to be positive and fall from coarse to fine")
    return h


if __name__ == "__main__":
    raise SystemExit("slipscale.measuring.convergence is a library, no command: slipscale -h lists the commands.")
