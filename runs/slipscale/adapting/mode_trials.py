"""Runs `modes` on the scene of a `slide` run, with other options, each in a folder of its own, once."""

import math
import shlex
from pathlib import Path

from slipscale.adapting.mode_match import misfit
from slipscale.adapting.trials import changed
from slipscale.measuring.pairing import pairs_of
from slipscale.mistakes import Mistake
from slipscale.reading import UnreadableRun
from slipscale.reading.modes import Modes
from slipscale.reading.yaml_file import load
from slipscale.running.attempt import attempt
from slipscale.running.commands import words

COUNT = 12  # modes that are looked at, those that grow fastest
ASKED = {"modes_count": COUNT, "modes_shapes": COUNT, "modes_frames": 1, "modes_tolerance": 1e-6}
# What speaks of time steps and of what is recorded: nothing that modes know.
IDLE = ("time_", "history_", "contact_every", "contact_interval", "initial_", "surface_speed_ramp", "watch_")


class ModeTrials:
    """`program`: words; `options`: of the scene of slide; `highest`: frequency in Hz."""

    def __init__(self, program, options, output, highest):
        self.program, self.output = program, Path(output)
        self.options = {name: value for name, value in options.items()
                        if not name.startswith(IDLE) and not name.endswith("_ramp")}
        self.asked = {**ASKED, "modes_to": highest}
        self.done = 0

    def run(self, **changes):
        """The Modes. Raises UnreadableRun with the reason where there are none."""
        name = "_".join(f"{key}_{value:.6g}" for key, value in changes.items()) or "own"
        folder = self.output / name
        command = [*self.program, *shlex.split(words({**changed(self.options, changes), **self.asked,
                                                      "output_folder": folder}))]
        try:
            outcome = load(folder / "outcome.yaml", written=True)
            outcome = outcome if outcome["command"] == shlex.join(command) else None
        except (Mistake, TypeError, KeyError):
            outcome = None
        outcome = outcome or attempt(folder / "outcome.yaml", command, changes)
        self.done += 1
        if outcome["status"] != "ok":
            raise UnreadableRun(outcome["reason"])
        return Modes(folder)


def compared(composite, block):
    """The misfit of two Modes, and rows for adapt.yaml: each growing mode of the composite and its partner."""
    pairs = [(pair.one, pair.other) for pair in pairs_of(composite, block) if pair.one.growth_rate > 0]
    taken = [partner for _, partner in pairs]
    others = [mode.growth_rate for mode in block.growing if mode not in taken]
    rows = [{"frequency": mode.frequency, "growth_rate": mode.growth_rate,
             "partner_frequency": partner and partner.frequency, "partner_growth_rate": partner and partner.growth_rate}
            for mode, partner in pairs]
    return (misfit(pairs, others) if pairs else math.nan), rows


if __name__ == "__main__":
    raise SystemExit("slipscale.adapting.mode_trials is a library, no command: slipscale -h lists the commands.")
