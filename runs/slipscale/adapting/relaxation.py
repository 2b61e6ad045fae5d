"""The regularisation time T of a homogeneous model from the power that passes through its contact: formulas alone.

In slip the traction follows the pressure as T dτ/dt = μp - τ, a filter of gain 1/√(1 + ω²T²) and lag atan ωT. With the
pressure p0 + p1 cos ωt and the velocity v1 cos(ωt + φ) of the body's surface, the mean power τv that passes into the
body is, for the strength A = μ p1 v1/2,

    P = A (cos φ - ωT sin φ)/(1 + ω²T²),   so   P ω²T² + A ω sin φ T + (P - A cos φ) = 0.
"""

import numpy as np


def scaled_time(time, frequency, own_frequency):
    """The T (s) that keeps ωT: `time` is that of a run whose dominant frequency (Hz) is `frequency`, for a model whose
    own is `own_frequency`. None without a frequency."""
    return time * frequency / own_frequency if own_frequency > 0 and frequency > 0 else None


def power_of_one_frequency(omega, time, strength, phase):
    """P in W/m², of omega in rad/s, time T in s, strength A = μ p1 v1/2 in W/m² and phase φ of the velocity before the
    pressure in rad."""
    x = omega * time
    return strength * (np.cos(phase) - x * np.sin(phase)) / (1 + x**2)


def time_of_one_frequency(omega, power, strength, phase):
    """The smallest positive T (s) at which `power` (W/m²) passes; None if there is none."""
    a, b, c = power, strength * np.sin(phase), power - strength * np.cos(phase)
    if a == 0:  # without power: the lag makes traction and velocity orthogonal
        roots = np.array([-c / b]) if b != 0 else np.array([])
    else:
        square = b**2 - 4 * a * c
        roots = (-b + np.array([-1, 1]) * np.sqrt(square)) / (2 * a) if square >= 0 else np.array([])
    positive = roots[roots > 0]
    return float(positive.min() / omega) if len(positive) else None


def most_power_of_one_frequency(strength, phase):
    """The most and the least P in W/m² over all T >= 0: what lies outside cannot be reached. With φ = -ψ, δ the lag:
    P = A cos δ cos(δ - ψ) = A/2 (cos ψ + cos(2δ - ψ)), δ from 0 to π/2."""
    lag = np.linspace(0, np.pi / 2, 2001)
    power = strength * np.cos(lag) * np.cos(lag + phase)
    return float(power.max()), float(power.min())


if __name__ == "__main__":
    raise SystemExit("slipscale.adapting.relaxation is a library, no command: slipscale -h lists the commands.")
