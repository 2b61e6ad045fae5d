"""The picture of relocalised stress: of all kinds of mesh, frames, statistics and probes, and when nothing is there."""

import contextlib
import io
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace

import h5py
import numpy as np

from slipscale.pictures import relocalized_picture
from slipscale.pictures.local_history import history_panel
from slipscale.reading import Fields, UnreadableRun
from tests import fake_run

TIMES = [1e-5, 2e-5, 3e-5]


class RelocalizedPicture(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.addCleanup(relocalized_picture.plt.close, "all")
        self.folders = [Path(temporary.name) / name for name in ("reference", "relocalised", "homogeneous")]
        for folder in self.folders:
            folder.mkdir()

    def write(self, kind="triangles", factor=1.05, points=((3, 0), (200, 1), (7, 0))):
        """A heterogeneous run, the relocalised stress `factor` times its, and 90 % of its mean on a coarse mesh."""
        reference, relocalised, homogeneous = self.folders
        fake_run.write_fields(reference, TIMES, kind, divisions=24)
        fake_run.write_relocalized(relocalised, reference, factor, points)
        fake_run.write_fields(homogeneous, TIMES, "quadrilaterals", divisions=5)
        with h5py.File(homogeneous / "fields.h5", "r+") as file:
            for frame in file["frames"].values():
                frame["stress"][:] = [-1e6, -20e6, 7e6]

    def scale_frame(self, folder, name, frame, factor):
        with h5py.File(folder / name, "r+") as file:
            file[f"frames/{frame:05d}/stress"][:] *= factor

    def draw(self, **options):
        figure = relocalized_picture.draw(*self.folders, **options)
        return figure, {axes.get_title()[:3]: axes for axes in figure.axes}

    def run_main(self, *extra):
        """Exit code and what was said on stderr."""
        said = io.StringIO()
        picture = self.folders[0].parent / "picture.png"
        with contextlib.redirect_stderr(said):
            code = relocalized_picture.main([*map(str, self.folders), str(picture), *extra])
        return code, said.getvalue()

    def test_every_kind_of_mesh(self):
        for kind in ("triangles", "quadrilaterals", "mixed"):
            self.write(kind)
            self.assertEqual(self.run_main(), (0, ""), kind)
            self.assertGreater((self.folders[0].parent / "picture.png").stat().st_size, 50000)

    def test_errors_of_known_fields(self):
        self.write("mixed")
        figure, panels = self.draw()
        with Fields(self.folders[0]) as fields:
            stress = fields.read("stress")[:, 1]
        # The cells of the mixed mesh: boxes in the lower half, half boxes in the upper.
        area = np.where(np.arange(len(stress)) < 24 * 12, 1.0, 0.5)
        expected = np.sqrt(np.sum(area * (stress + 20e6)**2) / np.sum(area * stress**2))
        self.assertIn(f"homogeneous {expected:.3f}   |   relocalised 0.050", figure._suptitle.get_text())
        self.assertIn("error 0.050", panels["(b)"].get_title())
        self.assertIn(f"error {expected:.3f}", panels["(c)"].get_title())

    def test_the_three_fields_share_their_colours(self):
        self.write()
        _, panels = self.draw()
        limits = [panels[letter].collections[0].get_clim() for letter in ("(a)", "(b)", "(c)", "(d)")]
        self.assertEqual(limits[0], limits[1])
        self.assertEqual(limits[0], limits[2])
        self.assertEqual(limits[3][0], -limits[3][1])

    def test_component_and_time(self):
        self.write()
        self.scale_frame(self.folders[1], "relocalized.h5", 1, 1.2 / 1.05)
        figure, _ = self.draw(component="xy", time=2.0001e-5)
        self.assertIn("20 µs", figure._suptitle.get_text())
        self.assertIn("relocalised 0.200", figure._suptitle.get_text())
        self.assertIn("xy", figure._suptitle.get_text())
        self.assertIn("homogeneous 0.000", figure._suptitle.get_text())  # σ_xy is 7 MPa in both

    def test_statistic(self):
        self.write()
        fake_run.write_statistics(self.folders[0])
        fake_run.write_statistics(self.folders[0], "relocalized_statistics.h5", factor=0.9)
        (self.folders[0] / "relocalized_statistics.h5").rename(self.folders[1] / "relocalized_statistics.h5")
        fake_run.write_statistics(self.folders[2])
        self.assertEqual(self.run_main("--statistic", "deviation"), (0, ""))
        figure, _ = self.draw(statistic="mean")
        self.assertIn("mean over 100–200 µs", figure._suptitle.get_text())
        self.assertIn("relocalised 0.100", figure._suptitle.get_text())
        with self.assertRaisesRegex(UnreadableRun, "no dataset statistics/stress/highest"):
            self.draw(statistic="highest")

    def test_histories_of_one_point_in_each_phase(self):
        self.write(points=((3, 0), (7, 0), (200, 1)))
        _, panels = self.draw()
        self.assertIn("in matrix", panels["(e)"].get_title())
        self.assertIn("in inclusion", panels["(f)"].get_title())
        reference, homogeneous, relocalised = panels["(e)"].lines[:3]
        np.testing.assert_allclose(relocalised.get_ydata(), 1.05 * reference.get_ydata(), rtol=1e-12)
        np.testing.assert_allclose(homogeneous.get_ydata(), 0.525 * reference.get_ydata(), rtol=1e-12)
        self.assertEqual([line.get_label() for line in (homogeneous, relocalised)], ["homogeneous", "relocalised"])
        self.assertIn("homogeneous 0.475, relocalised 0.050", panels["(e)"].get_title())

    def test_points_may_be_numbered_anew(self):
        """As `relocalize` does: the cells are where they were, so it is the same morphology."""
        self.write()
        with h5py.File(self.folders[1] / "relocalized.h5", "r+") as file:
            points = file["mesh/coordinates"][:]
            order = np.random.default_rng(2).permutation(len(points))
            file["mesh/cells"][:] = np.argsort(order)[file["mesh/cells"][:]]
            file["mesh/coordinates"][:] = points[order]
        figure, panels = self.draw()
        self.assertNotIn("another morphology", figure._suptitle.get_text())
        self.assertIn("error 0.050", panels["(b)"].get_title())

    def test_a_history_is_not_held_against_what_was_not_recorded(self):
        """Nothing is known of the relocalised stress before its first frame: what the run did there does not count."""
        point = SimpleNamespace(x=np.zeros(2), region="matrix", time=np.array([3.94e-4, 3.97e-4, 4.0e-4]),
                                stress=np.full((3, 3), 1e6), homogeneous_stress=np.full((3, 3), 1e6))
        time = np.arange(3.9e-4, 4.00001e-4, 1e-7)
        stress = np.where(time[:, None] < 3.94e-4 - 1e-9, 9e6, 1e6) * np.ones(3)
        axes = relocalized_picture.plt.figure().subplots()
        history_panel(axes, "", point, (time, stress), 1, "s", None)
        self.assertIn("relocalised 0.000", axes.get_title())

    def test_another_morphology_has_no_error(self):
        self.write()
        with h5py.File(self.folders[1] / "relocalized.h5", "r+") as file:
            file["mesh/region"][:] = 1 - file["mesh/region"][:]
        figure, panels = self.draw()
        self.assertIn("another morphology", figure._suptitle.get_text())
        self.assertIn("difference", panels["(b)"].get_title())
        self.assertNotIn("error", panels["(b)"].get_title())

    def test_runs_of_other_scenes_are_named(self):
        self.write()
        for folder, coefficient in zip(self.folders[::2], (0.5, 0.3)):
            (folder / "run.yaml").write_text(f"friction_coefficient: {coefficient}\ntime_step: {coefficient}\n")
        figure, panels = self.draw()
        self.assertIn("differ: friction_coefficient 0.5 and 0.3", figure._suptitle.get_text())
        self.assertIn("difference", panels["(c)"].get_title())

    def test_another_block_is_refused(self):
        self.write()
        with h5py.File(self.folders[2] / "fields.h5", "r+") as file:
            file["mesh/coordinates"][:] *= 2
        code, said = self.run_main()
        self.assertEqual((code, said.count("\n")), (2, 1))
        self.assertRegex(said, "The block of .*homogeneous is not that of .*reference")

    def test_history_of_the_heterogeneous_run_where_it_has_the_point(self):
        self.write(points=((3, 0),))
        fake_run.write_history(self.folders[0], np.arange(800) * 5e-8)
        with Fields(self.folders[1], "relocalized.h5", "relocalize") as fields:
            x = fields.local_points()[0].x
        with h5py.File(self.folders[0] / "history.h5", "r+") as file:
            file["points/0/x"][:] = x
        _, panels = self.draw()
        self.assertEqual(len(panels["(e)"].lines[0].get_xdata()), 401)  # 10 to 30 µs

    def test_without_probe_points(self):
        self.write(points=())
        self.assertEqual(self.run_main(), (0, ""))

    def test_one_sentence_when_there_is_nothing_to_draw(self):
        for name, program in (("fields.h5", "slide"), ("relocalized.h5", "relocalize")):
            code, said = self.run_main()
            self.assertEqual((code, said.count("\n")), (2, 1))
            self.assertIn(f"There is no {name} in", said)
            self.assertIn(f"`{program}` run", said)
            self.write()
            (self.folders[1] / "relocalized.h5").unlink()
        self.write()
        code, said = self.run_main("--time", "2.5e-5")
        self.assertEqual((code, said.count("\n")), (2, 1))
        self.assertIn("has no frame at 2.5e-05 s", said)

    def test_unknown_statistic(self):
        with self.assertRaises(SystemExit) as stop, contextlib.redirect_stderr(io.StringIO()) as said:
            relocalized_picture.main(["a", "b", "c", "picture.png", "--statistic", "median"])
        self.assertEqual(stop.exception.code, 2)
        self.assertIn("quantile_high", said.getvalue())


if __name__ == "__main__":
    unittest.main()
