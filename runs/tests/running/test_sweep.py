"""Ranges and lists spelled out, combinations, and options checked against a manual."""

import tempfile
import unittest
from pathlib import Path

from slipscale.mistakes import Mistake
from slipscale.running import sweep
from slipscale.running.sweep import values_of

MANUALS = {
    "slide": sweep.options_in("""slide: says what it is
Options may stand anywhere.

friction
  -friction_law  none, coulomb or regularized; required
      law of friction
  -friction_coefficient  a number >= 0 (ratio); required
      -mu, see above
  -boundary_<boundary>_x  free, fixed or a number (m); default free
  -boundary_<boundary>_pressure  a number (Pa); default 0
  -surface_speed  a number |x| < 1e100 or a formula of t (m/s); required
  -initial_velocity  numbers separated by commas (m/s); default 0,0
  -time_end  a number > 0 (s); required
  -time_step  auto or a number > 0 (s); default auto
"""),
    "morphology": sweep.options_in("""
  -seed  a whole number >= 0; default 1
  -fraction  a number above 0 (ratio); required
"""),
}


class Values(unittest.TestCase):
    def test_ranges_without_rounding_errors(self):
        for text, expected in (("0.1:0.1:0.8", [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8]), ("1:1:4", [1, 2, 3, 4]),
                               ("0.8:-0.2:0.1", [0.8, 0.6, 0.4, 0.2]), ("0:0.1:0.35", [0.0, 0.1, 0.2, 0.3]),
                               ("1e-6:5e-7:2e-6", [1e-6, 1.5e-6, 2e-6]), ("-1:0.5:0", [-1.0, -0.5, 0.0]),
                               ("3:1:3", [3]), ("3:0:3", [3]), ("0:0.33333333333:1", [0.0, 0.33333333333,
                                                                                    0.66666666666, 0.99999999999])):
            self.assertEqual(values_of(text), expected, text)
        self.assertIsInstance(values_of("1:1:4")[0], int)  # a seed is not 1.0

    def test_the_stop_is_met_to_rounding(self):
        self.assertEqual(len(values_of("0:0.1:0.99999999999")), 11)
        self.assertEqual(len(values_of("0:0.1:0.9999")), 10)

    def test_ranges_by_a_factor(self):
        self.assertEqual(values_of("1:*2:16"), [1, 2, 4, 8, 16])
        self.assertEqual(values_of("0.25:*2:3"), [0.25, 0.5, 1.0, 2.0])
        self.assertEqual(values_of("8:*0.5:1"), [8, 4, 2, 1])
        self.assertEqual(values_of("-1:*3:-9"), [-1, -3, -9])

    def test_lists(self):
        self.assertEqual(values_of("1,2,5:5:15"), [1, 2, 5, 10, 15])
        self.assertEqual(values_of([0.5, "1:1:3", "coulomb"]), [0.5, 1, 2, 3, "coulomb"])
        self.assertEqual(values_of("coulomb,none"), ["coulomb", "none"])
        self.assertEqual(values_of(0.5), [0.5])
        self.assertEqual(values_of(True), [True])
        self.assertEqual(values_of("out/a:b.msh"), ["out/a:b.msh"])

    def test_a_list_that_is_one_value(self):
        self.assertEqual(values_of("[0,-1],[0,-2]"), [[0, -1], [0, -2]])
        self.assertEqual(values_of([[0, -1], [0, -2]]), [[0, -1], [0, -2]])
        self.assertEqual(values_of("0,-1", takes_list=True), [[0, -1]])
        self.assertEqual(values_of([0, -1], takes_list=True), [[0, -1]])
        self.assertEqual(values_of("[0,-1],[0,-2]", takes_list=True), [[0, -1], [0, -2]])
        self.assertEqual(values_of([[0, -1], [0, -2]], takes_list=True), [[0, -1], [0, -2]])

    def test_nonsense_is_one_sentence(self):
        for text, sentence in (("1:2", "start:step:stop"), ("1:2:3:4", "start:step:stop"), ("1:0:2", "never ends"),
                               ("1:-1:2", "leads away"), ("2:1:1", "leads away"), ("0:1e-9:1", "values"),
                               ("1:*1:2", "never ends"), ("0:*2:8", "never ends"), ("1:*2:-8", "never ends"),
                               ("8:*2:1", "never ends"), ("1,,2", "no list"), ("", "no list"), ("[0,1", "no list"),
                               ("[0,[1]]", "no list"), ("[0,1]2", "comma"), (None, "no value"), ({"a": 1}, "no value")):
            with self.assertRaisesRegex(Mistake, sentence, msg=text) as raised:
                values_of(text)
            self.assertNotIn("\n", str(raised.exception))


class Manuals(unittest.TestCase):
    def test_whose_option_it_is(self):
        for name, program in (("friction_law", "slide"), ("boundary_top_left_x", "slide"), ("seed", "morphology"),
                              ("log_view", "slide")):
            self.assertEqual(sweep.owner(name, MANUALS), program)
        with self.assertRaisesRegex(Mistake, "-friction_coeficient; is -friction_coefficient meant"):
            sweep.owner("friction_coeficient", MANUALS)
        with self.assertRaisesRegex(Mistake, r"has an option -xyz\.$"):
            sweep.owner("xyz", MANUALS)
        self.assertTrue(sweep.takes_list("initial_velocity", MANUALS))
        self.assertFalse(sweep.takes_list("friction_law", MANUALS))

    def test_a_manual_that_is_not_there(self):
        with self.assertRaisesRegex(Mistake, "is it built"):
            sweep.manual("/nowhere/slide")

    def test_what_every_run_would_refuse(self):
        for name, value in (("friction_coefficient", "a lot"), ("boundary_top_pressure", [1, 2]), ("seed", "1:x:2"),
                            ("surface_speed", "fast"), ("surface_speed", "V")):
            with self.assertRaisesRegex(Mistake, f"-{name} .* is not a"):
                sweep.check(name, value, MANUALS)
        sweep.check("surface_speed", "V", MANUALS, sweep.parameters_in({"parameters_V": 2, "time_end": 1}))
        with self.assertRaisesRegex(Mistake, "gives each run a folder"):
            sweep.check("output_folder", "here", MANUALS)
        for name, value in (("friction_coefficient", "0.5"), ("friction_coefficient", -1), ("time_step", "auto"),
                            ("boundary_top_x", "fixed"), ("surface_speed", "2*(1 + 0.1*sin(t))")):
            sweep.check(name, value, MANUALS)  # -1 is refused by slide, and a row says so


class Combinations(unittest.TestCase):
    def test_the_last_varies_first(self):
        wanted = {"friction_coefficient": "0.1:0.1:0.2", "seed": [1, 2], "time_end": None}
        runs = sweep.combinations(wanted, [], MANUALS)
        self.assertEqual(runs, [{"friction_coefficient": mu, "seed": seed} for mu in (0.1, 0.2) for seed in (1, 2)])

    def test_rows_come_after_and_may_lack_options(self):
        rows = [{"friction_law": "none"}, {"initial_velocity": [0, -1], "seed": None}]
        self.assertEqual(sweep.combinations({"seed": 3}, rows, MANUALS),
                         [{"seed": 3}, {"friction_law": "none"}, {"initial_velocity": [0, -1]}])
        self.assertEqual(sweep.combinations({}, rows[:1], MANUALS), [{"friction_law": "none"}])
        self.assertEqual(sweep.combinations(None, None, MANUALS), [{}])

    def test_rows_of_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "rows.csv"
            path.write_text("friction_coefficient,seed\n0.5,1\n,2\n")
            self.assertEqual(sweep.combinations({}, str(path), MANUALS),
                             [{"friction_coefficient": 0.5, "seed": 1}, {"seed": 2}])
            with self.assertRaisesRegex(Mistake, "There is no .*none.csv"):
                sweep.combinations({}, f"{folder}/none.csv", MANUALS)

    def test_mistakes(self):
        for wanted, rows, sentence in (({"sed": 1}, [], "-sed; is -seed meant"), ({"seed": []}, [], "over no value"),
                                       ({}, [{"sed": 1}], "-sed"), ({}, [3], "one set of options"),
                                       ({"seed": "1:1:1000", "fraction": "1:1:1000"}, [], "more than 100000")):
            with self.assertRaisesRegex(Mistake, sentence):
                sweep.combinations(wanted, rows, MANUALS)

    def test_names(self):
        runs = [{"mu": 0.1, "v": [0, -1]}, {"mesh": "a/b c.msh"}, {"mesh": "a-b/c.msh"}, {"mu": 0.1, "v": [0, -1]}, {}]
        self.assertEqual(sweep.named(runs), {"mu_0.1-v_0--1": runs[0], "mesh_a-b-c.msh": runs[1],
                                             "mesh_a-b-c.msh-2": runs[2], "only": {}})


if __name__ == "__main__":
    unittest.main()
