"""Friction of each phase: its own constants act where it touches, equal ones have the bits of one law for all."""

import re
import unittest

import numpy as np
from running import InScratch, arguments_of, datasets
from scenes import SIDE, SQUEAL

REGIONS = ("matrix", "inclusion")
STRIPES, DIVISIONS = 4, 3


def striped(folder, name="block.msh"):
    """A block of stripes, matrix and inclusion in turn, of squares; a layer of matrix only, `back`, above them."""
    edge, half = SIDE / STRIPES, SIDE / 2
    lines = []
    for row, y in enumerate((0, half, SIDE)):
        lines += [f"Point({100 * row + k + 1}) = {{{k * edge}, {y}, 0}};" for k in range(STRIPES + 1)]
        lines += [f"Line({1000 + 100 * row + k}) = {{{100 * row + k + 1}, {100 * row + k + 2}}};" for k in range(STRIPES)]
    for row in (0, 1):
        lines += [f"Line({2000 + 100 * row + k}) = {{{100 * row + k + 1}, {100 * row + k + 101}}};" for k in range(STRIPES + 1)]
        for k in range(STRIPES):
            surface = 100 * row + k + 1
            lines += [f"Curve Loop({surface}) = {{{1000 + 100 * row + k}, {2000 + 100 * row + k + 1}, "
                      f"-{1100 + 100 * row + k}, -{2000 + 100 * row + k}}};", f"Plane Surface({surface}) = {{{surface}}};"]
    lines += [f"Transfinite Curve{{1000:1299}} = {DIVISIONS + 1};", f"Transfinite Curve{{2000:2199}} = {2 * DIVISIONS + 1};",
              "Transfinite Surface{:}; Recombine Surface{:};"]
    for index, region in enumerate(REGIONS):
        lines.append(f'Physical Surface("{region}") = {{{", ".join(str(k + 1) for k in range(index, STRIPES, 2))}}};')
    lines += [f'Physical Surface("back") = {{101:{100 + STRIPES}}};', f'Physical Curve("bottom") = {{1000:{999 + STRIPES}}};',
              f'Physical Curve("top") = {{1200:{1199 + STRIPES}}};']
    (folder / "striped.geo").write_text("\n".join(lines) + "\n")
    return ["-v", "1", "-2", "-format", "msh41", "striped.geo", "-o", name]


SCENE = {**SQUEAL, "contact_every": 10, "fields_every": 200, "time_end": 20e-6}
COULOMB = {"friction_law": "coulomb", "friction_time": None, "friction_threshold": None}
BY_SLIP_RATE = {"friction_time": None, "friction_rate": "slip", "friction_length": 1.2e-6, "friction_rate_reference": 0.1}
FALLING = {"friction_law": "exponential", "friction_kinetic": 0.3, "friction_slip_rate": 1, "friction_threshold": None}
OWN = {"friction_matrix_coefficient": 0.2, "friction_inclusion_coefficient": 0.6}


class Phases(InScratch):
    def setUp(self):
        super().setUp()
        self.assertEqual(self.launch("gmsh", *striped(self.folder)).codes, [0])

    def assert_same_bits(self, left, right):
        for file in ("history.h5", "contact.h5", "fields.h5"):
            one, two = (datasets(self.folder / folder / file) for folder in (left, right))
            for name in one:
                self.assertEqual(one[name].tobytes(), two[name].tobytes(), f"{file}: {name}")

    def test_equal_constants_are_one_law(self):
        cases = {"coulomb": (COULOMB, {}), "time": ({}, {"time": 0.6e-6}), "length": ({}, {"length": 1.2e-6}),
                 "instantaneous": ({"friction_threshold": None}, {"time": 0.6e-6}),
                 "slip rate": (BY_SLIP_RATE, {"length": 1.2e-6}),
                 "exponential": (FALLING, {"time": 0.6e-6, "kinetic": 0.3, "slip_rate": 1})}
        for name, (law, memory) in cases.items():
            with self.subTest(name):
                if name == "length":
                    law = {"friction_time": None, "friction_length": 1.2e-6}
                self.run_scene({**SCENE, **law, "output_folder": "one"})
                own = {f"friction_{region}_{key}": value for region in REGIONS
                       for key, value in {"coefficient": 0.5, **memory}.items()}
                self.run_scene({**SCENE, **law, **own, "output_folder": "each"}, ranks=2)
                self.assert_same_bits("one", "each")

    def test_each_rubs_with_its_own(self):
        for ranks in (1, 2):
            self.run_scene({**SCENE, **COULOMB, **OWN, "output_folder": f"out{ranks}"}, ranks=ranks)
        self.assert_same_bits("out1", "out2")
        seen = datasets(self.folder / "out2" / "contact.h5")
        stripe = seen["x"] / (SIDE / STRIPES)
        between = np.abs(stripe - np.round(stripe)) < 1e-9
        inner = between & (stripe > 0.5) & (stripe < STRIPES - 0.5)
        mu = np.where(np.minimum(np.floor(stripe), STRIPES - 1) % 2 == 0, 0.2, 0.6)
        mu[np.isclose(stripe, STRIPES)] = 0.6
        mu[inner] = 0.4  # edges of equal length
        slips = seen["status"] == 2
        self.assertTrue(slips.any(axis=0).all())
        np.testing.assert_allclose(np.abs(seen["tangential_traction"])[slips],
                                   (mu[None, :] * seen["normal_traction"])[slips], rtol=1e-11)
        history = datasets(self.folder / "out2" / "history.h5")
        self.assertLess(np.abs(history["energy/residual"] / history["energy/flowed"])[1:].max(), 1e-10)

    def test_those_of_all_need_not_be_given_where_each_has_its_own(self):
        """`back` does not touch. The shortest memory is that of the inclusions, whatever would stand for all."""
        own = {**OWN, "friction_matrix_time": 6e-7, "friction_inclusion_time": 1e-7}
        none = {"friction_coefficient": None, "friction_time": None}
        self.run_scene({**SCENE, **own, "output_folder": "all"})
        outcome = self.run_scene({**SCENE, **own, **none, "output_folder": "own"}, ranks=2)
        self.assertIn("friction: regularized, in matrix: mu 0.2, T 600.0 ns, in inclusion: mu 0.6, T 100.0 ns", outcome.out)
        self.assert_same_bits("all", "own")
        falling = {**own, **none, **FALLING, "friction_kinetic": None, "friction_slip_rate": None}
        for region in REGIONS:
            falling |= {f"friction_{region}_kinetic": 0.1, f"friction_{region}_slip_rate": 1}
        self.run_scene({**SCENE, **falling}, ranks=2)
        for missing in ("friction_inclusion_time", "friction_matrix_coefficient", "friction_matrix_kinetic", "friction_inclusion_slip_rate"):
            outcome = self.slide(*arguments_of({**SCENE, **falling, missing: None}), ranks=2)
            key = missing.split("_", 2)[2].replace("time", "length")
            self.assert_refused("slide", outcome, [f"-friction_{key}"], 2)

    def test_constants_that_act_nowhere_and_friction_that_rises_are_told(self):
        """Once, on any number of ranks; `back` does not touch the surface."""
        short = {"time_end": 1e-7, "fields_every": None}
        own = {**OWN, "friction_matrix_time": 6e-7, "friction_inclusion_length": 1.2e-6}
        for ranks in (1, 2):
            out = self.run_scene({**SCENE, **own, **short}, ranks=ranks).out
            for name in ("coefficient", "time"):
                sentence = f"note: -friction_{name} acts nowhere: every region that touches the surface ('matrix', 'inclusion')"
                self.assertEqual(out.count(sentence), 1, out)
            out = self.run_scene({**SCENE, **FALLING, **short, "friction_kinetic": 0.6, "friction_inclusion_kinetic": 0.5},
                                 ranks=ranks).out
            # Two stripes of matrix of three edges, and the three nodes between two stripes.
            self.assertEqual(out.count("-friction_kinetic is above -friction_coefficient, the static one, at 8 of 13 contact nodes"),
                             1, out)
        own = {"friction_matrix_coefficient": 0.4, "friction_matrix_time": 5e-7}
        out = self.run_scene({**SCENE, **own, **FALLING, **short}).out
        self.assertNotIn("acts nowhere", out)
        self.assertNotIn("rises with", out)

    def test_the_shortest_memory_is_that_of_the_phase_that_has_it(self):
        """Remarks on a memory below the step, and below two edges, are those of one law with the shorter memory."""
        for short in (1e-9, 5e-8):
            said = []
            for times in ({"friction_time": short}, {"friction_time": 6e-7, "friction_inclusion_time": short},
                          {"friction_time": None, "friction_matrix_time": 6e-7, "friction_inclusion_time": short},
                          {"friction_time": None, "friction_matrix_time": short, "friction_inclusion_time": 6e-7},
                          {"friction_time": short / 100, "friction_matrix_time": short, "friction_inclusion_time": 6e-7}):
                outcome = self.slide(*arguments_of({**SCENE, "time_end": 1e-6, **times}), ranks=2)
                self.assertEqual(outcome.codes, [0, 0], outcome.err)
                said.append([line for line in (outcome.out + outcome.err).splitlines()
                             if re.match("note: .*(relaxation time of friction|memory spans)", line)])
            self.assertEqual(len(said[0]), 1, said)
            self.assertEqual(said, said[:1] * len(said))

    def test_a_coefficient_that_falls(self):
        """Without a difference it is the regularised law; a run goes on with the same bits."""
        self.run_scene({**SCENE, "friction_threshold": None, "output_folder": "one"})
        level = {**SCENE, **FALLING, "friction_kinetic": 0.5}
        self.run_scene({**level, "output_folder": "level"}, ranks=2)
        self.assert_same_bits("one", "level")
        falls = {**SCENE, **FALLING, "friction_kinetic": "0.3 + 0.1*x/L"}
        self.run_scene(falls, output_folder="whole")
        self.run_scene({**falls, "time_end": 10e-6}, ranks=2, output_folder="halves")
        outcome = self.slide("-restart", "halves", "-time_end", falls["time_end"])
        self.assertEqual(outcome.codes, [0], outcome.err)
        self.assert_same_bits("whole", "halves")
        history = datasets(self.folder / "whole" / "history.h5")
        self.assertLess(np.abs(history["energy/residual"] / history["energy/flowed"])[1:].max(), 1e-10)
        self.assertTrue((np.diff(history["energy/friction_heat"]) >= 0).all())

    def test_one_phase_alone_differs(self):
        """The others have the constants of all; a memory of its own as well, and a formula of the place."""
        self.run_scene({**SCENE, "friction_matrix_coefficient": 0.5, "friction_inclusion_time": 1e-7, "output_folder": "a"})
        self.run_scene({**SCENE, "friction_inclusion_length": 2e-7, "output_folder": "b"}, ranks=2)  # T = L*/|V|, V = 2 m/s
        self.assert_same_bits("a", "b")
        self.run_scene({**SCENE, "output_folder": "c"})
        with self.assertRaises(AssertionError):
            self.assert_same_bits("a", "c")
        self.run_scene({**SCENE, "friction_matrix_coefficient": "0.5 + 0.1*x/L", "output_folder": "d"}, ranks=2)

    def test_a_run_goes_on(self):
        scene = {**SCENE, **OWN, "friction_inclusion_time": 1e-7}
        self.run_scene(scene, output_folder="whole")
        self.run_scene({**scene, "time_end": 10e-6}, ranks=2, output_folder="halves")
        outcome = self.slide("-restart", "halves", "-time_end", scene["time_end"])
        self.assertEqual(outcome.codes, [0], outcome.err)
        self.assert_same_bits("whole", "halves")

    def test_refused(self):
        for changes, words in (
                ({"friction_back_coefficient": 0.3}, ["-friction_back_coefficient has no effect", "no edge of region 'back'"]),
                ({"friction_matrix_coefficient": -1}, ["-friction_matrix_coefficient", ">= 0"]),
                ({"friction_matrx_coefficient": 1}, ["did you mean -friction_matrix_coefficient?"]),
                ({**COULOMB, "friction_matrix_time": 1e-7}, ["-friction_matrix_time has no effect with -friction_law coulomb"]),
                ({"friction_law": "none", "friction_coefficient": None, "friction_time": None, "friction_threshold": None,
                  "friction_matrix_coefficient": 0.3}, ["-friction_matrix_coefficient has no effect with -friction_law none"]),
                ({**BY_SLIP_RATE, "friction_matrix_time": 1e-7}, ["-friction_matrix_time", "with -friction_rate slip"]),
                ({**FALLING, "friction_time": 0}, ["-friction_time is 0", "needs a memory"]),
                ({**FALLING, "friction_inclusion_time": 0}, ["-friction_inclusion_time is 0", "needs a memory"]),
                ({**FALLING, "friction_slip_rate": 0}, ["-friction_slip_rate", "> 0"]),
                ({"friction_inclusion_kinetic": 0.1}, ["-friction_inclusion_kinetic has no effect with -friction_law regularized"]),
                ({**FALLING, "friction_threshold": "regularized"}, ["-friction_threshold has no effect with -friction_law exponential"]),
                ({"friction_matrix_time": 1e-7, "friction_matrix_length": 1e-7}, ["contradicts"])):
            with self.subTest(changes=changes):
                outcome = self.slide(*arguments_of({**SCENE, **changes}), ranks=2)
                self.assert_refused("slide", outcome, words, 2)


if __name__ == "__main__":
    unittest.main()
