"""statistics.h5, strain frames and frames of a part of the block: what they hold, and which wishes are refused."""

import re
import unittest

import numpy as np
from running import InScratch, arguments_of, datasets, h5py
from scenes import SIDE, SQUEAL, block

# Sticks, slips and separates within the window.
SCENE = {**SQUEAL, "time_end": 20e-6, "time_step": 2e-8, "fields_every": 7, "fields_quantities": "stress,strain"}
WINDOW = {"statistics_from": 5e-6, "statistics_to": 19e-6, "statistics_every": 7}
PAIRS = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)]
YOUNG, POISSON = 45e9, 0.25
C22 = YOUNG * (1 - POISSON) / ((1 + POISSON) * (1 - 2 * POISSON))
C12 = C22 * POISSON / (1 - POISSON)


class Statistics(InScratch):
    def read(self, folder="out"):
        """Datasets and the attributes of /statistics."""
        with h5py.File(self.folder / folder / "statistics.h5") as file:
            return datasets(self.folder / folder / "statistics.h5"), dict(file["statistics"].attrs)

    def frames(self, first, last, folder="out"):
        """Stress and strain of the frames in a window, [frames, cells, 3], and their times."""
        fields = datasets(self.folder / folder / "fields.h5")
        chosen = [k for k, t in enumerate(fields["time"]) if first <= t <= last]
        return {name: np.array([fields[f"frames/{k:05d}/{name}"] for k in chosen]) for name in ("stress", "strain")}, \
            fields["time"][chosen]

    def test_are_those_of_the_frames(self):
        block(self.folder / "block.msh", regions=("matrix", "inclusion"), cells="mixed", divisions=12, periodic=True)
        for quantile in (0.99, 0.8, 1):
            self.run_scene({**SCENE, **WINDOW}, statistics_quantile=quantile, ranks=2)
            found, about = self.read()
            frames, times = self.frames(about["from"], about["to"])
            self.assertEqual((about["from"], about["to"], about["samples"]), (times[0], times[-1], len(times)))
            self.assertEqual((len(times), about["quantile"]), (100, quantile))  # steps 252, 259, ..., 945
            self.assertGreater(times[0], 5e-6 - 1e-12)
            self.assertLess(times[-1], 19e-6 + 1e-12)
            for name, values in frames.items():
                scale = np.abs(values).max()
                expected = {"mean": values.mean(axis=0), "deviation": values.std(axis=0),
                            "quantile_low": np.quantile(values, 1 - quantile, axis=0),
                            "quantile_high": np.quantile(values, quantile, axis=0)}
                for statistic, exact in expected.items():
                    np.testing.assert_allclose(found[f"statistics/{name}/{statistic}"], exact, rtol=0,
                                               atol=1e-12 * scale, err_msg=f"{name} {statistic}")
                np.testing.assert_array_equal(found[f"statistics/{name}/lowest"], values.min(axis=0))
                np.testing.assert_array_equal(found[f"statistics/{name}/highest"], values.max(axis=0))
                parts = values - values.mean(axis=0)
                covariance = np.stack([(parts[..., i] * parts[..., j]).mean(axis=0) for i, j in PAIRS], axis=-1)
                np.testing.assert_allclose(found[f"statistics/{name}/covariance"], covariance, rtol=0,
                                           atol=1e-12 * scale**2)
                self.assertGreater(found[f"statistics/{name}/deviation"].max(), 0.05 * scale)

    def test_have_the_same_bits_on_any_number_of_ranks(self):
        block(self.folder / "block.msh", cells="triangles", divisions=12)
        scene = {**SCENE, **WINDOW, "fields_box": "1e-3,0,4e-3,2e-3"}
        self.run_scene(scene, output_folder="alone")
        for ranks in (2, 3):
            self.run_scene(scene, ranks=ranks, output_folder="cut")
            for file in ("statistics.h5", "fields.h5"):
                left, right = (datasets(self.folder / folder / file) for folder in ("alone", "cut"))
                self.assertEqual(left.keys(), right.keys())
                for name in left:
                    self.assertEqual(left[name].tobytes(), right[name].tobytes(), f"{file}: {name}, {ranks} ranks")

    def test_of_a_slow_uniform_compression(self):
        """ε_yy = -e ½(1 - cos πt/T) between rigid sides. Inertia adds (πH/cT)²/2 = 4e-4 of it at most."""
        block(self.folder / "block.msh")
        ramp, e = 100e-6, 1e-4
        free = {name: None for name in SQUEAL if name.startswith(("surface_", "friction_"))}
        out = self.run_scene({
            **SQUEAL, **free, "boundary_bottom_y": "fixed", "boundary_left_x": "fixed", "boundary_right_x": "fixed",
            "boundary_top_x": None, "boundary_top_y": -e * SIDE, "boundary_top_ramp": ramp, "damping_stiffness": None,
            "time_end": ramp, "time_step": 5e-8, "statistics_from": 0, "statistics_quantile": 0.9}).out
        self.assertRegex(out, r"statistics of 1001 samples from 0 s to 100\.0 µs take 63\d kB of that memory")
        found, about = self.read()
        self.assertEqual(about["samples"], 1001)
        unit = {"strain": np.array([0, -e, 0]), "stress": np.array([-C12 * e, -C22 * e, 0])}
        for name, peak in unit.items():
            expected = {"mean": peak / 2, "lowest": peak, "highest": 0 * peak, "deviation": -peak / 8**0.5,
                        "quantile_low": peak * (1 + np.cos(0.1 * np.pi)) / 2,
                        "quantile_high": peak * (1 - np.cos(0.1 * np.pi)) / 2}
            for statistic, exact in expected.items():
                np.testing.assert_allclose(found[f"statistics/{name}/{statistic}"], np.broadcast_to(exact, (64, 3)),
                                           rtol=0, atol=1e-3 * np.abs(peak).max(), err_msg=f"{name} {statistic}")

    def test_default_window_ends_with_the_run(self):
        block(self.folder / "block.msh")
        self.run_scene({**SCENE, "statistics_from": 10e-6})
        about = self.read()[1]
        self.assertEqual((about["samples"], about["quantile"]), (501, 0.99))  # every step
        np.testing.assert_allclose((about["from"], about["to"]), (10e-6, 20e-6), rtol=1e-12)

    def test_cost_nothing_when_nobody_asks(self):
        block(self.folder / "block.msh")
        self.run_scene({**SCENE, "statistics_from": 0})
        out = self.folder / "out"
        self.assertTrue((out / "statistics.h5").exists() and (out / "statistics.xdmf").exists())
        self.assertNotIn("statistics", self.run_scene(SCENE).out)
        self.assertFalse((out / "statistics.h5").exists() or (out / "statistics.xdmf").exists(), "of the older run")

    def test_are_kept_when_the_run_goes_astray(self):
        """Energies beyond all numbers end the run; the samples before are those of a run that ends there. The block is
        as fast as ever, but so soft and light beside its load that p²/E overflows while p and u do not."""
        block(self.folder / "block.msh")
        less = 1e-128
        scene = {**SCENE, "boundary_top_y": None, "boundary_top_pressure": 1e99, "boundary_top_ramp": 1e-5,
                 **{name: SCENE[name] * less for name in SCENE if name.startswith("material_")
                    and name.endswith(("_young", "_density"))},
                 "statistics_from": 0, "statistics_every": 1, "fields_every": 1, "history_every": 1}
        outcome = self.slide(*arguments_of(scene), ranks=2)
        self.assertEqual(outcome.codes, [1, 1], outcome.out)
        told = re.search(r"step (\d+) .* the statistics of (\d+) samples", outcome.err)
        self.assertTrue(told, outcome.err)
        found, about = self.read()
        self.assertEqual([int(told[2])] * 2, [int(told[1]), about["samples"]])  # steps 0 to the last good one
        self.assertGreater(about["samples"], 1)
        good = int(told[1]) - 1
        self.assertRegex(outcome.err, r"the energy is too large for a number; node \d+ \(x = .* m, y = .* m, region \w+"
                                      rf"\) is displaced most, by .*up to step {good}, with a last frame of step "
                                      rf"{good}, is kept")
        self.assertRegex(outcome.err, "The loads are too large for the stiffness")
        frames, times = self.frames(0, 1)
        self.assertEqual(about["samples"], len(times))
        np.testing.assert_array_equal(found["statistics/stress/lowest"], frames["stress"].min(axis=0))


class Frames(InScratch):
    def test_strain_is_that_of_the_displacement(self):
        block(self.folder / "block.msh")
        self.run_scene({**SCENE, "fields_quantities": "u,stress,strain", "fields_times": "15e-6", "fields_every": None})
        fields = datasets(self.folder / "out" / "fields.h5")
        u, cells, x = fields["frames/00000/u"], fields["mesh/cells"], fields["mesh/coordinates"]
        # At the centre of a rectangle: means over opposite sides.
        h = SIDE / 8
        column, row = np.round(x / h).T
        corners = np.array([cell[np.lexsort((column[cell], row[cell]))] for cell in cells])  # from the lower left
        du = u[corners]
        along_x = (du[:, 1] - du[:, 0] + du[:, 3] - du[:, 2]) / (2 * h)
        along_y = (du[:, 2] - du[:, 0] + du[:, 3] - du[:, 1]) / (2 * h)
        strain = np.stack([along_x[:, 0], along_y[:, 1], along_x[:, 1] + along_y[:, 0]], axis=1)
        np.testing.assert_allclose(fields["frames/00000/strain"], strain, rtol=0, atol=1e-11 * np.abs(strain).max())
        c = np.array([[C22, C12, 0], [C12, C22, 0], [0, 0, (C22 - C12) / 2]])
        np.testing.assert_allclose(fields["frames/00000/stress"], strain @ c, rtol=0,
                                   atol=1e-11 * C22 * np.abs(strain).max())

    def test_of_a_part(self):
        block(self.folder / "block.msh")
        scene = {**SCENE, "fields_quantities": "u,stress", "fields_every": 500}
        self.run_scene(scene)
        self.run_scene(scene, ranks=2, output_folder="part", fields_box="0,0,5e-3,0.7e-3")
        whole, part = (datasets(self.folder / folder / "fields.h5") for folder in ("out", "part"))
        self.assertEqual((part["mesh/cells"].shape, part["mesh/coordinates"].shape), ((8, 4), (18, 2)))
        centre = whole["mesh/coordinates"][whole["mesh/cells"]].mean(axis=1)
        inside = centre[:, 1] < 0.7e-3
        for frame in ("00000", "00001", "00002"):
            np.testing.assert_array_equal(part[f"frames/{frame}/stress"], whole[f"frames/{frame}/stress"][inside])
            np.testing.assert_array_equal(part[f"frames/{frame}/u"][part["mesh/cells"]],
                                          whole[f"frames/{frame}/u"][whole["mesh/cells"][inside]])


class Refusals(InScratch):
    """One sentence that names the option, exit code 2 on every rank, no file touched."""

    MISTAKES = {  # changes, and words of the sentence
        "a box without cells": ({"fields_box": "6e-3,0,7e-3,1e-3"}, "-fields_box", "centre of no cell", "0 to 0.005 m"),
        "a box between centres": ({"fields_box": "0,0,1e-4,1e-4"}, "-fields_box", "centre of no cell"),
        "a box turned round in x": ({"fields_box": "2e-3,0,1e-3,1e-3"}, "-fields_box", "x = 0.002 to 0.001 m"),
        "a box turned round in y": ({"fields_box": "0,2e-3,1e-3,1e-3"}, "-fields_box", "y = 0.002 to 0.001 m"),
        "a flat box": ({"fields_box": "0,0,0,1e-3"}, "-fields_box", "x = 0 to 0 m"),
        "half a box": ({"fields_box": "0,0"}, "-fields_box has 2 numbers", "x1,y1,x2,y2"),
        "a box for no frames": ({"fields_box": "0,0,1e-3,1e-3", "fields_every": None, "fields_quantities": None},
                                "-fields_box has no effect without -fields_every, -fields_interval or -fields_times"),
        "a quantity nobody knows": ({"fields_quantities": "u,power"}, "-fields_quantities", "'power'",
                                    "u, v, stress, strain, von_mises, principal and damping_work"),
        "a window after the run": ({"statistics_from": 21e-6}, "-statistics_from: 2.1e-05 s lies outside the run"),
        "a window that ends after it": ({"statistics_from": 0, "statistics_to": 21e-6},
                                        "-statistics_to: 2.1e-05 s lies outside the run"),
        "a window turned round": ({"statistics_from": 9e-6, "statistics_to": 5e-6},
                                  "-statistics_to: 5e-06 s lies before"),
        "a window before the run": ({"statistics_from": -1e-6}, "-statistics_from", "-1e-06", ">= 0"),
        "no sample": ({"statistics_from": 1e-6, "statistics_to": 2e-6, "statistics_every": 300},
                      "-statistics_every 300", "no multiple", "steps 50 to 100"),
        "half a step": ({"statistics_from": 0, "statistics_every": 1.5}, "-statistics_every is 1.5", "whole number"),
        "never a sample": ({"statistics_from": 0, "statistics_every": 0}, "-statistics_every", ">= 1"),
        "a quantile below the median": ({"statistics_from": 0, "statistics_quantile": 0.01},
                                        "-statistics_quantile", "0.01", ">= 0.5 and <= 1"),
        "a quantile above all": ({"statistics_from": 0, "statistics_quantile": 99}, "-statistics_quantile", "99"),
        "an end without a start": ({"statistics_to": 1e-6}, "-statistics_to has no effect without -statistics_from"),
        "samples of nothing": ({"statistics_every": 2}, "-statistics_every has no effect without -statistics_from"),
        "a quantile of nothing": ({"statistics_quantile": 0.9},
                                  "-statistics_quantile has no effect without -statistics_from"),
    }

    def test_mistakes(self):
        block(self.folder / "block.msh")
        for name, (changes, *words) in self.MISTAKES.items():
            with self.subTest(name):
                outcome = self.slide(*arguments_of({**SCENE, **changes}), ranks=2)
                self.assertEqual(outcome.codes, [2, 2], outcome.out)
                self.assertRegex(outcome.err, r"\Aslide: -[^\n]+\n\Z")
                for word in words:
                    self.assertIn(word, outcome.err)
                self.assertFalse((self.folder / "out").exists(), "files were touched")


if __name__ == "__main__":
    unittest.main()
