"""Wear depth and flash temperature of a run, from the sums over every step in its contact.h5.

    slipscale wear out/first out/first/wear --archard 1e-4 --hardness 1.2e9
    slipscale wear out/first out/first/wear --energy matrix=2e-14,inclusion=4e-15
    slipscale wear out/first out/first/wear --conductivity 30 --density 2400 --heat-capacity 800 --share 0.5

Archard: depth = k/H ∫ p |ds|, k dimensionless, H the hardness in Pa. By energy: depth = k_E times the friction work per
area, k_E in m³/J. The run itself is not worn: scale the depth over the way of a life.

Flash temperature: the surface of a half-space under the friction heat of each node, one-dimensional along the depth:
T(t) = ∫ q(t')/√(π k ρ c (t − t')) dt' since the start of the run, with the mean heat between two rows of contact.h5 integrated
exactly. k ρ c are conductivity, density and heat capacity; --share is the part of the heat that goes into the body. Peaks
shorter than the distance of two rows are smeared over it: -contact_every sets it.

Each constant is one number, or one for each region that touches the surface (matrix=…,inclusion=…); a node between two takes
their mean by length. Writes wear.csv (one row a node), wear.h5 (over time) and wear.png into the folder. SI units.
"""

import os
from pathlib import Path

from slipscale.mistakes import Mistake
from slipscale.parser import Parser, Window
from slipscale.wearing.constants import by_region

THERMAL = {"conductivity": "W/(m K)", "density": "kg/m^3", "heat_capacity": "J/(kg K)", "share": "at most 1"}


def factors_of(options):
    """A function of the regions that gives {law: {region: factor}}. Raises Mistake."""
    from slipscale.wearing.depth import archard_factors

    if (options.archard is None) != (options.hardness is None):
        lacking, given = ("--hardness", "--archard") if options.hardness is None else ("--archard", "--hardness")
        raise Mistake(f"{given} without {lacking}: Archard's law takes both.")

    def factors(regions):
        found = {}
        if options.archard is not None:
            found["archard"] = archard_factors(by_region("--archard", options.archard, regions),
                                               by_region("--hardness", options.hardness, regions, "in Pa"))
        if options.energy is not None:
            found["energy"] = by_region("--energy", options.energy, regions, "in m^3/J")
        return found

    return factors


def thermal_of(options):
    """A function of the regions that gives the constants of heat, or None where none is given. Raises Mistake."""
    given = [name for name in THERMAL if getattr(options, name) is not None]
    if not given:
        return None
    if missing := [name for name in THERMAL if name not in given]:
        raise Mistake(f"--{given[0].replace('_', '-')} without --{missing[0].replace('_', '-')}: flash temperature takes "
                      "conductivity, density, heat capacity and share.")

    def thermal(regions):
        found = {name: by_region(f"--{name.replace('_', '-')}", getattr(options, name), regions, units)
                 for name, units in THERMAL.items()}
        if wrong := [value for value in found["share"].values() if value > 1]:
            raise Mistake(f"--share is {wrong[0]:g}: the body takes at most all of the heat, 1.")
        return found

    return thermal


def main(arguments=None):
    parser = Parser("wear", __doc__)
    parser.add_argument("run", help="output folder of a slide run")
    parser.add_argument("folder", help="where wear.csv, wear.h5 and wear.png go")
    parser.add_argument("--archard", metavar="K", help="wear coefficient k [1]")
    parser.add_argument("--hardness", metavar="H", help="of the body [Pa]")
    parser.add_argument("--energy", metavar="K", help="energetic wear coefficient [m³/J]")
    parser.add_argument("--conductivity", metavar="K", help="of heat, of the body [W/(m K)]")
    parser.add_argument("--density", metavar="RHO", help="of the body [kg/m³]")
    parser.add_argument("--heat-capacity", metavar="C", help="of the body [J/(kg K)]")
    parser.add_argument("--share", metavar="S", help="part of the friction heat that goes into the body")
    parser.add_argument("--window", action=Window, metavar=("BEGIN", "END"),
                        help="times [s] between which wear counts (default: the whole run)")
    options = parser.parse_args(arguments)
    factors, thermal = factors_of(options), thermal_of(options)

    from slipscale.pictures.drawing import save
    from slipscale.wearing import results
    from slipscale.wearing.picture import draw
    from slipscale.wearing.worn import worn

    found = worn(options.run, factors, thermal, options.window)
    folder = Path(options.folder)
    os.makedirs(folder, exist_ok=True)
    results.write_csv(folder / "wear.csv", found)
    results.write_hdf5(folder / "wear.h5", found)
    save(parser, folder / "wear.png", lambda: draw(options.run, found))
    print(results.report(found))
    return 0


if __name__ == "__main__":
    raise SystemExit("slipscale.wearing.wear is a library, no command: slipscale -h lists the commands.")
