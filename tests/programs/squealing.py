"""Runs `modes` as a user does. The environment says where it is: SLIPSCALE_MODES."""

import os

import yaml
from running import InScratch, arguments_of
from scenes import SQUEAL

MODES = os.environ["SLIPSCALE_MODES"]
FILES = {"modes.yaml", "modes.h5", "modes.xdmf"}

# The scene of a block that squeals, and what is asked about it.
RUN = {**SQUEAL, "modes_to": 0.7e6, "modes_count": 5, "output_folder": "out"}


class Squealing(InScratch):
    """A test with a folder of its own, where it runs `modes`."""

    def modes(self, *arguments, ranks=1, folder=None):
        return self.launch(MODES, *arguments, ranks=ranks, folder=folder)

    def run_modes(self, ranks=1, **changes):
        """RUN with changes: must succeed without a word on stderr. Returns what was said, and modes.yaml."""
        options = {**RUN, **changes}
        outcome = self.modes(*arguments_of(options), ranks=ranks)
        self.assertEqual((outcome.codes, outcome.err), ([0] * ranks, ""), outcome.out)
        return outcome.out, yaml.safe_load((self.folder / options["output_folder"] / "modes.yaml").read_text())
