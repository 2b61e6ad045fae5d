"""Constants of wear and heat: one number for all regions, or one for each (`matrix=1e-4,inclusion=1e-5`)."""

import math

import numpy as np

from slipscale.mistakes import Mistake


def by_region(option, text, regions, units=""):
    """{region: number > 0} of the words of an option; one number stands for all regions. Raises Mistake."""
    words = text.split(",")
    if len(words) == 1 and "=" not in text:
        return dict.fromkeys(regions, _number(option, text, units))
    found = {}
    for word in words:
        name, equals, number = word.partition("=")
        if not equals:
            raise Mistake(f"{option} has {word!r}: give one number, or one for each region, like {regions[0]}=1,…")
        if name not in regions:
            raise Mistake(f"{option} names the region {name!r}, which does not touch the surface or is none: there are "
                          f"{', '.join(regions)}.")
        if name in found:
            raise Mistake(f"{option} names the region {name!r} twice: give each once.")
        found[name] = _number(f"{option} of {name!r}", number, units)
    if missing := [name for name in regions if name not in found]:
        raise Mistake(f"{option} has nothing for the region {missing[0]!r}, which touches the surface: add "
                      f"{missing[0]}=….")
    return found


def _number(option, text, units):
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0 < value < math.inf:
        raise Mistake(f"{option} is {text!r}: give a number above 0{units and f', {units}'}.")
    return value


def at_nodes(constants, shares):
    """[nc]: the mean over each node's tributary length; `shares` {region: [nc]}."""
    return sum(np.asarray(shares[name]) * value for name, value in constants.items())


if __name__ == "__main__":
    raise SystemExit("slipscale.wearing.constants is a library, no command: slipscale -h lists the commands.")
