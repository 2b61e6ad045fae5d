"""Axes and colours for the columns of a study's table: which options were varied, where their values stand, units."""

import numpy as np
from matplotlib.colors import BoundaryNorm, ListedColormap

from slipscale.measuring.regime import MEASURES
from slipscale.pictures.colours import BLACK, BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILION
from slipscale.running.table import OUTCOME

REGIMES = {"open": "0.75", "steady": "#B9E3D3", "slip": SKY, "stick-slip": BLUE, "slip-separated": ORANGE,
           "stick-slip-separated": VERMILION}
COLOURS = (BLUE, ORANGE, GREEN, PURPLE, VERMILION, SKY, BLACK)
PREFIXES = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n"))
UNITS = {  # of measures and of the options that are varied most
    **{name: unit for name, (unit, _) in MEASURES.items()}, "surface_speed": "m/s", "friction_coefficient": "1",
    "friction_length": "m", "friction_time": "s", "friction_rate_reference": "m/s", "damping_stiffness": "s",
    "damping_mass": "1/s", "time_step": "s", "wall_seconds": "s", "size": "m", "diameter": "m", "block_width": "m",
    "block_height": "m"}


def is_number(value):
    return isinstance(value, (int, float)) and np.isfinite(value)


def values_of(rows, name):
    """The distinct values of a column: numbers ascending, else in the order in which they appear."""
    found = list(dict.fromkeys(row[name] for row in rows if row.get(name) is not None))
    return sorted(found) if all(map(is_number, found)) else found


def options_of(rows):
    """The columns before `status`: what made each run."""
    columns = list(dict.fromkeys(name for row in rows for name in row))
    return columns[:columns.index(OUTCOME[0])] if OUTCOME[0] in columns else columns


def together(rows, one, other):
    """Whether two options rise or fall together, as a time step that is kept in proportion to the element size."""
    pairs = {(row.get(one), row.get(other)) for row in rows}
    if not all(is_number(value) for pair in pairs for value in pair):
        return False
    a, b = np.array(sorted(pairs)).T
    return bool(len(a) > 1 and np.all(np.diff(a) > 0) and (np.all(np.diff(b) > 0) or np.all(np.diff(b) < 0)))


def varied(rows, options):
    """Those of `options` that have several values; of options that rise or fall together the first only."""
    kept = []
    for name in options:
        if len(values_of(rows, name)) > 1 and not any(together(rows, other, name) for other in kept):
            kept.append(name)
    return kept


def geometric(values):
    """Whether positive numbers (ascending) are nearer to equal ratios than to equal steps."""
    if len(values) < 3 or not all(map(is_number, values)) or values[0] <= 0:
        return False
    steps, ratios = np.diff(values), np.diff(np.log(values))
    return bool(np.std(ratios) / np.mean(ratios) < 0.9 * np.std(steps) / np.mean(steps))


def scaled(name, values, units):
    """A factor and an axis label with a unit that suits the largest of the numbers `values`."""
    unit = units.get(name)
    if not unit:
        return 1.0, name
    largest = max((abs(value) for value in values if is_number(value)), default=0)
    if unit == "1" or largest == 0 or 0.1 <= largest < 1e3:
        return 1.0, f"{name} [{unit}]"
    size, prefix = next((entry for entry in PREFIXES if largest >= 0.999 * entry[0]), PREFIXES[-1])
    return 1 / size, f"{name} [{prefix}{unit}]"


def in_words(name, value, units):
    """An option and its value with its unit."""
    factor, label = scaled(name, [value], units) if is_number(value) else (1.0, name)
    unit = label[len(name):].strip(" []").removesuffix("1")
    return f"{name} {factor * value:.4g} {unit}".rstrip() if is_number(value) else f"{name} {value}"


class Scale:
    """An axis for the values of an option: `at[value]`, its place; `edges` [n + 1] of cells around the values."""

    def __init__(self, rows, name, units):
        self.values = values_of(rows, name)
        self.numbers = all(map(is_number, self.values))
        self.geometric = geometric(self.values)
        factor, self.label = scaled(name, self.values, units) if self.numbers else (1.0, name)
        places = [factor * value for value in self.values] if self.numbers else range(len(self.values))
        self.at = dict(zip(self.values, map(float, places)))
        centres = np.array(list(self.at.values()))
        centres = np.log(centres) if self.geometric else centres
        middle = 0.5 * (centres[1:] + centres[:-1])
        if len(middle):
            edges = np.concatenate([[2 * centres[0] - middle[0]], middle, [2 * centres[-1] - middle[-1]]])
        else:
            edges = centres[0] + np.array([-0.5, 0.5])
        self.edges = np.exp(edges) if self.geometric else edges

    def label_axis(self, axis, set_scale, set_limits, most=12):
        if self.geometric:
            set_scale("log")
        set_limits(self.edges[0], self.edges[-1])
        places = list(self.at.values())
        chosen = range(0, len(places), -(-len(places) // most))
        names = [f"{places[k]:.4g}" if self.numbers else str(self.values[k]) for k in chosen]
        axis.set_ticks([places[k] for k in chosen], names)
        axis.set_ticks([], minor=True)
        axis.set_label_text(self.label)


class Shades:
    """Colours of a column, shared by the panels that show it: of numbers a scale, of names one each (`names`, empty for
    numbers; `colours`, a dict)."""

    def __init__(self, rows, value, units=UNITS):
        found = [row.get(value) for row in rows if row["status"] == "ok" or value == "status"]
        found = [entry for entry in found if is_number(entry) or isinstance(entry, str)]
        self.names = []
        if any(isinstance(entry, str) for entry in found):
            self.names = list(dict.fromkeys(map(str, found)))
            if set(self.names) <= set(REGIMES):  # the same colours in every picture
                self.names = [name for name in REGIMES if name in self.names]
        self.colours = {name: REGIMES.get(name, COLOURS[k % len(COLOURS)]) for k, name in enumerate(self.names)}
        self.factor, self.label = (1.0, value) if self.names else scaled(value, found, units)
        low, high = (self.factor * min(found), self.factor * max(found)) if found and not self.names else (0.0, 1.0)
        widen = 0.5 * abs(low or 1) if low == high else 0.0
        self.limits = low - widen, high + widen

    def number(self, entry):
        """What stands for an entry in the image; nan for none."""
        if self.names:
            return float(self.names.index(str(entry))) if str(entry) in self.names else np.nan
        return self.factor * entry if is_number(entry) else np.nan

    def look(self):
        """Words for pcolormesh and scatter."""
        if self.names:
            count = len(self.names)
            return {"cmap": ListedColormap(list(self.colours.values())),
                    "norm": BoundaryNorm(np.arange(count + 1) - 0.5, count)}
        return {"cmap": "cividis", "vmin": self.limits[0], "vmax": self.limits[1]}
