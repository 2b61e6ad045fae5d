"""The picture of modes: with shapes, without, with a sweep over one and two options, and when nothing is there."""

import contextlib
import io
import tempfile
import unittest
from pathlib import Path

from slipscale.pictures import modes_picture
from tests import fake_modes


SWEEPS = """sweeps:
  coefficient:
    values: [0.2, 0.4, 0.6]
    becomes_unstable:
      - {value: 0.3, frequency: 4e5}
    paths:
      - {growth_rate: [-1e4, 1e4, 2e4], frequency: [4e5, 4e5, 4e5]}
      - {growth_rate: [-2e4, -2e4, .nan], frequency: [5e5, 5e5, .nan]}
  time:
    values: [1e-7, 2e-7]
    paths: []
"""


class ModesPicture(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.addCleanup(modes_picture.plt.close, "all")

    def titles(self, **given):
        fake_modes.write_modes(self.folder, **given)
        return [axes.get_title() for axes in modes_picture.draw(self.folder, 2).axes if axes.get_title()]

    def test_spectrum_shapes_and_tractions(self):
        self.assertEqual(self.titles(), ["(a) 2 of 3 modes grow", "(b) Mode 1: 372.6 kHz, +56.00/ms",
                                         "(c) Mode 2: 512.0 kHz, +21.00/ms", "(d) Tractions of mode 1 along the contact"])

    def test_sweeps(self):
        self.assertEqual(self.titles(more=SWEEPS)[-2:], ["(e) 1 of 2 paths grow somewhere",
                                                         "(f) 0 of 0 paths grow somewhere"])

    def test_command(self):
        fake_modes.write_modes(self.folder)
        picture = self.folder / "modes.png"
        self.assertEqual(modes_picture.main([str(self.folder), str(picture)]), 0)
        self.assertGreater(picture.stat().st_size, 20000)
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            self.assertEqual(modes_picture.main([str(self.folder / "nowhere"), str(picture)]), 2)
        self.assertRegex(said.getvalue(), r"\Aslipscale modes-picture: There is no modes.yaml in [^\n]+\n\Z")
        fake_modes.write_modes(self.folder, [])
        with contextlib.redirect_stderr(said):
            self.assertEqual(modes_picture.main([str(self.folder), str(picture)]), 2)
        self.assertIn("give a higher -modes_to", said.getvalue())


if __name__ == "__main__":
    unittest.main()
