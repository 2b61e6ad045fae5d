"""Depth that a contact wears off, from sums over every step.

Archard (J. Appl. Phys. 24 (1953) 981): the volume worn off over a way s is k F s / H, so the depth is
k/H ∫ p |ds| with the wear coefficient k and the hardness H of the softer body; ∫ p |ds| is `pressure_slip`, taken step by
step and not from a mean pressure. By energy (Fouvry and others, Wear 255 (2003) 287): the volume is that of the friction
work times k_E, m³/J, so the depth is k_E times the friction work per area. With Coulomb's law, τ = μp, both are one when
k/H = μ k_E; with a regularised law τ lags behind μp and they part.

The run is not worn: geometry and contact stay as they were, so a depth is that of the first moments of wear, to be scaled
over the way of a life by hand.
"""

from dataclasses import dataclass

import numpy as np

from slipscale.wearing.constants import at_nodes


@dataclass(frozen=True)
class Phase:
    """What a region lost. part: of the contact's length; mean and most: depth, m, over its length and at a node that
    is at least half of it (NaN where there is none); volume: part of all that was worn off."""

    name: str
    part: float
    mean: float
    most: float
    volume: float


SOURCES = {"archard": "pressure_slip", "energy": "friction_work"}  # law: the sum that it takes


def archard_factors(coefficient, hardness):
    """k/H by region, 1/Pa."""
    return {name: coefficient[name] / hardness[name] for name in coefficient}


def depth(law, factors, sums, shares):
    """m, of each node the mean over its tributary length. factors {region: k/H, 1/Pa, or k_E, m³/J}; sums {name:
    […, nc]}; shares {region: [nc]}."""
    return sums[SOURCES[law]] * at_nodes(factors, shares)


def phases(law, factors, sums, shares, length):
    """A Phase for each region; sums {name: [nc]}, length [nc] m."""
    depths = {name: sums[SOURCES[law]] * factors[name] for name in factors}
    volumes = {name: np.sum(depths[name] * shares[name] * length) for name in factors}
    whole = sum(volumes.values())
    found = []
    for name in factors:
        own, mostly = np.sum(shares[name] * length), shares[name] >= 0.5
        found.append(Phase(name, own / np.sum(length), volumes[name] / own,
                           np.max(depths[name][mostly]) if mostly.any() else np.nan,
                           volumes[name] / whole if whole else np.nan))
    return found


if __name__ == "__main__":
    raise SystemExit("slipscale.wearing.depth is a library, no command: slipscale -h lists the commands.")
