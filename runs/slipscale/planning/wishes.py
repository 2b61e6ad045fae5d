"""What is wished for: results and how accurate they shall be, and a budget of time, as words of a command line."""

import re
from dataclasses import dataclass

from slipscale.measuring.regime import MEASURES
from slipscale.mistakes import Mistake

AVERAGES = {name: what for name, (unit, what) in MEASURES.items() if unit and not name.endswith("_error")}
TRAJECTORIES = {  # of the probe point and the measured boundary, before squeal saturates
    "trajectory_displacement": "tangential displacement of the probe point, over --before",
    "trajectory_velocity": "its velocity",
    "trajectory_normal_force": "normal force at the measured boundary, over --before",
    "trajectory_tangential_force": "tangential force there",
}
DISTANCES = {"spectrum": "√density of friction below 2 MHz, relative L2 distance",
             "portrait": "phase portrait of the probe point, in standard deviations"}
SHARES = ("friction", "stick", "slip", "open", "power_ratio")  # without a unit, below or near one
STRESS = "stress_"  # and the name of a region
SECONDS = {"s": 1, "min": 60, "h": 3600}


@dataclass(frozen=True)
class Wish:
    """A result and how accurate it shall be: `share`, of its value (of distances and trajectories of 1), or `absolute`,
    in its unit; the other is None."""

    name: str
    share: float | None = None
    absolute: float | None = None

    @property
    def kind(self):
        return kind_of(self.name)

    def allowed(self, size):
        """As a share of the size of the result."""
        return self.share if self.absolute is None else self.absolute / size

    def __str__(self):
        return f"{self.name} to {100 * self.share:g} %" if self.absolute is None else f"{self.name} to {self.absolute:g}"


def kind_of(name):
    """average, trajectory, distance or stress. Raises Mistake."""
    if name in AVERAGES:
        return "average"
    if name in TRAJECTORIES:
        return "trajectory"
    if name in DISTANCES:
        return "distance"
    if name.startswith(STRESS) and len(name) > len(STRESS):
        return "stress"
    import difflib
    known = [*AVERAGES, *TRAJECTORIES, *DISTANCES, f"{STRESS}<region>"]
    near = difflib.get_close_matches(name, known, 1, 0.6)
    raise Mistake(f"{name} is no result that can be wished for" +
                  (f"; is {near[0]} meant?" if near else f": there are {', '.join(known)}"))


def wishes_of(text):
    """The Wish of each part of `friction:1%,frequency:0.5%,stick:0.005`. Raises Mistake."""
    found = []
    for part in text.split(","):
        name, colon, much = (word.strip() for word in part.partition(":"))
        kind = kind_of(name)
        number = re.fullmatch(r"([-+.\deE]+)\s*(%?)", much)
        try:
            value = float(number[1]) if number else 0.0
        except ValueError:
            value = 0.0
        if not (colon and value > 0):
            raise Mistake(f"{part.strip()!r} is no wish: write friction:1%, or stick:0.005 in the unit of the result")
        percent = bool(number[2])
        if kind in ("trajectory", "distance"):
            percent, value = True, value if percent else 100 * value
        if (value if percent else 100 * value * (name in SHARES)) >= 100:
            raise Mistake(f"{part.strip()!r} allows an error as large as the result itself: write {name}:1%, say")
        found.append(Wish(name, share=value / 100) if percent else Wish(name, absolute=value))
    if len({wish.name for wish in found}) < len(found):
        raise Mistake(f"{text} wishes for one result twice")
    return found


def seconds_of(text):
    """`90s`, `10min`, `2h` in s. Raises Mistake."""
    found = re.fullmatch(r"([.\deE+]+)\s*(s|min|h)", text.strip())
    try:
        value = float(found[1]) * SECONDS[found[2]] if found else 0.0
    except ValueError:
        value = 0.0
    if not value > 0:
        raise Mistake(f"{text!r} is no time: write 90s, 10min or 2h")
    return value


if __name__ == "__main__":
    raise SystemExit("slipscale.planning.wishes is a library, no command: slipscale -h lists the commands.")
