"""The picture of modes: with shapes, without, with a sweep over one and two options, and when nothing is there."""

import contextlib
import io
import tempfile
import unittest
from pathlib import Path

from slipscale.pictures import modes_picture
from tests import fake_modes


def point(options, growth):
    values = "".join(f"    {name}: {value}\n" for name, value in options.items()).lstrip()
    return f"  - {values}    modes:\n      - {{frequency: 4e5, growth_rate: {growth}}}\n"


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
        one = "sweep:\n" + "".join(point({"coefficient": mu}, 1e5 * (mu - 0.3)) for mu in (0.2, 0.4, 0.6))
        self.assertEqual(self.titles(more=one)[-1], "(e) Sweep: 2 of 3 points have a mode that grows")
        two = "sweep:\n" + "".join(point({"coefficient": mu, "time": time}, 1e5 * (mu - 0.3)) for mu in (0.2, 0.4)
                                   for time in (1e-7, 1e-6))
        self.assertEqual(self.titles(more=two)[-1], "(e) Sweep: 2 of 4 points have a mode that grows")

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
