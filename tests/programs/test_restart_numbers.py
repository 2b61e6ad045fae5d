"""Runs whose numbers go astray: what stops them, what they say of it and what they leave, and what is no reason to stop."""

import re
import unittest

import numpy as np
import yaml
from running import InScratch, SLIDE, arguments_of, datasets, h5py
from scenes import SIDE, SQUEAL, block
from sealed import unsealed

LOWER_AND_UPPER = {f"material_{region}_{name}": value for region in ("lower", "upper")
                   for name, value in (("young", 45e9), ("poisson", 0.25), ("density", 1800))}
SCENE = {**{name: value for name, value in SQUEAL.items() if not name.startswith("material")}, **LOWER_AND_UPPER,
         "time_step": 2e-9, "time_end": 4e-6, "history_every": 1, "history_points": None, "fields_every": 500,
         "checkpoint_every": 700}
TINY = {"mesh_file": "block.msh", **LOWER_AND_UPPER, "surface_boundary": "bottom", "surface_speed": 2,
        "friction_law": "coulomb", "friction_coefficient": 0.3, "initial_gap": 1e-4, "time_step": 1e-12,
        "time_end": 1e-9}


class Numbers(InScratch):
    def setUp(self):
        super().setUp()
        block(self.folder / "block.msh", regions=("lower", "upper"))

    def summary(self):
        return yaml.safe_load((self.folder / "out" / "summary.yaml").read_text())

    def interrupted_by_kill(self):
        """Step 1400 in checkpoint.h5 and 700 in the older, of a run to step 2000 whose last checkpoint is gone."""
        self.run_scene(SCENE, time_end=2.8e-6)
        return self.folder / "out" / "checkpoint.h5"

    def gone_astray(self, words, ranks):
        """Goes on with the run, which must stop; returns its sentence."""
        checkpoint = self.folder / "out" / "checkpoint.h5"
        before = checkpoint.read_bytes()
        outcome = self.slide("-restart", "out", "-time_end", 4e-6, "-checkpoint_every", 700, ranks=ranks)
        self.assertEqual(outcome.codes, [1] * ranks, outcome.out + outcome.err)
        self.assertRegex(outcome.err, r"\Aslide: [^\n]+\n\Z")
        for word in words:
            self.assertIn(word, outcome.err)
        self.assertEqual(checkpoint.read_bytes(), before)
        for file in ("history.h5", "contact.h5", "fields.h5", "fault.h5"):
            with self.subTest(file):
                self.assertIn("time", datasets(self.folder / "out" / file))
        return outcome.err


class Stopped(Numbers):
    def first_around(self, node):
        """The lowest number among a node and those that share a cell with it; where it is, and the number of cells."""
        with h5py.File(self.folder / "out" / "fields.h5") as file:
            cells, place = file["mesh/cells"][:], file["mesh/coordinates"][:]
        around = cells[(cells == node).any(axis=1)]
        return int(around.min()), place[around.min()]

    def test_no_finite_state(self):
        for ranks, node, component in ((1, 40, 0), (2, 70, 1), (2, 5, 0)):
            with self.subTest(ranks=ranks, node=node):
                checkpoint = self.interrupted_by_kill()
                first, place = self.first_around(node)
                with unsealed(checkpoint) as file:
                    file["nodes/displacement"][node, component] = np.nan
                region = "lower" if place[1] < SIDE / 2 else "upper" if place[1] > SIDE / 2 else ""
                said = self.gone_astray((
                    "step 1401 (t = 2.802e-06 s): the state is no longer finite at node ",
                    f"node {first} (x = {place[0]:g} m, y = {place[1]:g} m, region {region}",
                    "what was recorded up to step 1400", "the state of this step is in 'out/fault.xdmf'"), ranks)
                self.assertNotIn("PETSC", said)
                fault = datasets(self.folder / "out" / "fault.h5")
                self.assertTrue(np.isnan(fault["frames/00000/u"][node, component]))
                self.assertEqual(np.isnan(fault["frames/00000/u"]).sum(), 1)

    def test_energy_from_nowhere(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                checkpoint = self.interrupted_by_kill()
                flowed = datasets(self.folder / "out" / "history.h5")["energy/flowed"][-1]
                with unsealed(checkpoint) as file:
                    supports = file["boundary_nodes/supports"]
                    supports[len(supports) // 2] -= 1e-5 * flowed
                said = self.gone_astray(("step 1401 ", " is displaced most, by ", ", region lower)"), ranks)
                missed, of = map(float, re.search(r"misses ([\d.e+-]+) J/m of ([\d.e+-]+) J/m", said).groups())
                np.testing.assert_allclose((missed, of), (1e-5 * flowed, flowed), rtol=0.02)
                # The checkpoint from before the edit is there, too, and is sound.
                (self.folder / "out" / "checkpoint.h5").unlink()
                outcome = self.slide("-restart", "out", "-time_end", 4e-6, ranks=ranks)
                self.assertEqual((outcome.codes, outcome.err), ([0] * ranks, ""), outcome.out)

    def test_energy_from_nowhere_beside_rounding(self):
        """In a scene where rounding is as large as all that flows: a thousandfold of it stops the run."""
        self.run_scene({**TINY, "body_acceleration": "0,-9.81"})
        rounding = 2.2e-16 * 1e-4 * 1800 * SIDE * SIDE * 9.81 * 1000  # eps |u| m g, a thousand times
        with unsealed(self.folder / "out" / "checkpoint.h5") as file:
            file["boundary_nodes/loads"][0] += 1000 * rounding
        outcome = self.slide("-restart", "out", "-time_end", 1.1e-9)
        self.assertEqual(outcome.codes, [1], outcome.out)
        self.assertIn("the energy balance misses -", outcome.err)


class TinySteps(Numbers):
    """Of a body that the gap has displaced so far that what a step adds lies about the last digit."""

    def test_are_no_reason_to_stop(self):
        for name, load in {"pressure": {"boundary_top_pressure": 1e6}, "weight": {"body_acceleration": "0,-9.81"},
                           "held": {"boundary_top_y": -1e-6, "boundary_top_ramp": 1e-6}}.items():
            for ranks in (1, 2):
                with self.subTest(name, ranks=ranks):
                    self.run_scene({**TINY, **load}, ranks=ranks)
                    summary = self.summary()
                    self.assertLess(summary["energy"]["largest_relative_residual"], 1e-6)
                    if name != "held":
                        self.assertIn("displacements change by little more than their last digit",
                                      summary["notes"]["note_2"])

    def test_of_one_that_is_where_it_belongs_need_no_such_note(self):
        self.run_scene({**TINY, "initial_gap": None, "boundary_top_pressure": 1e6})
        self.assertLess(self.summary()["energy"]["largest_relative_residual"], 1e-9)
        self.assertNotIn("last digit", (self.folder / "out" / "summary.yaml").read_text())


if __name__ == "__main__":
    unittest.main()
