"""Tables drawn over the options that were varied: axes, colours, failures, panels."""

import tempfile
import unittest
from pathlib import Path

import numpy as np
from matplotlib.colors import to_hex

from slipscale.pictures import maps, scales
from slipscale.pictures.drawing import plt
from slipscale.reading import UnreadableRun
from slipscale.running.table import write_csv


def row(mu, speed, friction=None, regime=None, status="ok", **options):
    return {"mu": mu, "speed": speed, **options, "status": status, "reason": None if status == "ok" else "no",
            "wall_seconds": 1.0, "friction": friction, "regime": regime}


ROWS = [row(0.1, 1, 0.1, "slip"), row(0.2, 1, 0.19, "slip"), row(0.3, 1, 0.28, "slip"),
        row(0.1, 2, 0.09, "slip"), row(0.2, 2, status="failed"), row(0.3, 2, 0.25, "slip-separated"),
        row(0.1, 4, 0.08, "slip"), row(0.2, 4, None, "slip"), row(0.3, 4, 0.2, "slip-separated")]


class Scales(unittest.TestCase):
    def test_numbers_ascend_and_names_keep_their_order(self):
        rows = [{"a": 10, "b": "z"}, {"a": 9, "b": "y"}, {"a": 10, "b": "z"}, {"a": None, "b": "x"}]
        self.assertEqual(scales.values_of(rows, "a"), [9, 10])
        self.assertEqual(scales.values_of(rows, "b"), ["z", "y", "x"])

    def test_geometric(self):
        for values, expected in (([1, 2, 4, 8], True), ([0.1, 0.2, 0.3, 0.4], False), ([0.1, 0.3, 1, 3], True),
                                 ([1, 2], False), ([0, 1, 2], False), ([1, 2, 5], True), (["a", "b", "c"], False)):
            self.assertEqual(scales.geometric(values), expected, values)

    def test_edges_lie_between_the_values(self):
        scale = scales.Scale([{"v": v} for v in (4, 1, 2)], "v", {})
        np.testing.assert_allclose(scale.edges, [2**-0.5, 2**0.5, 2**1.5, 2**2.5])
        scale = scales.Scale([{"v": v} for v in (0, 1, 3)], "v", {})
        np.testing.assert_allclose(scale.edges, [-0.5, 0.5, 2, 4])
        np.testing.assert_allclose(scales.Scale([{"v": 7}], "v", {}).edges, [6.5, 7.5])
        np.testing.assert_allclose(scales.Scale([{"v": "a"}, {"v": "b"}], "v", {}).edges, [-0.5, 0.5, 1.5])

    def test_units(self):
        units = {"f": "Hz", "length": "m", "mu": "1"}
        for name, values, factor, label in (("f", [1e3, 3.8e5], 1e-3, "f [kHz]"),
                                            ("length", [1.2e-6, 0], 1e6, "length [µm]"), ("mu", [1e-3], 1, "mu [1]"),
                                            ("other", [1e9], 1, "other"), ("length", [0.4, 2.0], 1, "length [m]")):
            found = scales.scaled(name, values, units)
            self.assertAlmostEqual(found[0] / factor, 1)
            self.assertEqual(found[1], label)

    def test_in_words(self):
        units = {"size": "m", "mu": "1"}
        for name, value, said in (("size", 1.25e-4, "size 125 µm"), ("mu", 0.5, "mu 0.5"), ("seed", 3, "seed 3"),
                                  ("law", "coulomb", "law coulomb"), ("size", None, "size None")):
            self.assertEqual(scales.in_words(name, value, units), said)

    def test_what_was_varied(self):
        rows = [{"h": h, "step": 20 * h, "seed": 1, "law": law, "status": "ok"} for h in (1, 2, 4) for law in "ab"]
        self.assertEqual(scales.options_of(rows), ["h", "step", "seed", "law"])
        self.assertEqual(scales.varied(rows, scales.options_of(rows)), ["h", "law"])
        rows[0] = {**rows[0], "step": 99}  # no longer in proportion
        self.assertEqual(scales.varied(rows, scales.options_of(rows)), ["h", "step", "law"])


class Panels(unittest.TestCase):
    def setUp(self):
        self.figure, self.axes = plt.subplots()
        self.addCleanup(plt.close, "all")

    def legend(self):
        return [text.get_text() for text in self.axes.get_legend().get_texts()] if self.axes.get_legend() else []

    def test_a_map_of_numbers(self):
        values = maps.map_panel(self.figure, self.axes, ROWS[::-1], "mu", "speed", "friction")
        nan = np.nan
        np.testing.assert_array_equal(values, [[0.1, 0.19, 0.28], [0.09, nan, 0.25], [0.08, nan, 0.2]])
        self.assertEqual((self.axes.get_xscale(), self.axes.get_yscale()), ("linear", "log"))
        hatched = [patch.get_bbox() for patch in self.axes.patches if patch.get_hatch()]
        self.assertEqual(len(hatched), 1)
        self.assertTrue(hatched[0].contains(0.2, 2) and not hatched[0].contains(0.2, 4))
        self.assertEqual(self.legend(), ["failed", "no value"])
        self.assertEqual(len(self.figure.axes), 2)  # with a colour bar
        self.assertEqual([text.get_text() for text in self.axes.texts][:2], ["0.1", "0.19"])

    def test_a_map_of_names(self):
        values = maps.map_panel(self.figure, self.axes, ROWS, "mu", "speed", "regime")
        np.testing.assert_array_equal(values, [[0, 0, 0], [0, np.nan, 1], [0, 0, 1]])
        self.assertEqual(self.legend(), ["slip", "slip-separated", "failed"])
        self.assertEqual(len(self.figure.axes), 1)
        shown = self.axes.collections[0].to_rgba(np.array([0.0, 1.0]))
        self.assertEqual([to_hex(colour).upper() for colour in shown],
                         [scales.REGIMES["slip"], scales.REGIMES["slip-separated"]])

    def test_status_is_a_value_too(self):
        values = maps.map_panel(self.figure, self.axes, ROWS, "mu", "speed", "status")
        np.testing.assert_array_equal(values, [[0, 0, 0], [0, 1, 0], [0, 0, 0]])

    def test_two_rows_at_one_place_are_refused(self):
        with self.assertRaisesRegex(ValueError, "mu 0.1, speed 1: they differ in friction"):
            maps.map_panel(self.figure, self.axes, [*ROWS, row(0.1, 1, 0.5, "slip")], "mu", "speed", "friction")

    def test_nothing_but_failures(self):
        values = maps.map_panel(self.figure, self.axes, [row(mu, 1, status="failed") for mu in (1, 2)], "mu", "speed",
                                "friction")
        self.assertTrue(np.isnan(values).all())

    def test_a_line(self):
        values = maps.line_panel(self.axes, ROWS[3:6], "mu", "friction", label="V = 2")
        np.testing.assert_array_equal(values, [0.09, np.nan, 0.25])
        self.assertTrue(any(patch.get_hatch() for patch in self.axes.patches))
        maps.line_panel(self.axes, ROWS[3:6], "mu", "regime")
        self.assertEqual([text.get_text() for text in self.axes.get_yticklabels()], ["slip", "slip-separated"])


class Pictures(unittest.TestCase):
    def setUp(self):
        self.addCleanup(plt.close, "all")

    def titles(self, figure):
        return [axes.get_title() for axes in figure.axes if axes.get_title()]

    def test_a_panel_for_each_value(self):
        self.assertEqual(self.titles(maps.draw(ROWS)), ["friction", "regime"])
        self.assertEqual(self.titles(maps.draw(ROWS, ["status"])), ["status"])

    def test_a_panel_for_each_combination_of_the_others(self):
        rows = [{"seed": seed, **entry, "friction": seed * entry["friction"] if entry["friction"] else None}
                for seed in (1, 3) for entry in ROWS]
        figure = maps.draw(rows, ["friction"])
        self.assertEqual(self.titles(figure), ["friction\nseed 1", "friction\nseed 3"])
        limits = [axes.collections[0].get_clim() for axes in figure.axes if axes.get_title()]
        np.testing.assert_allclose(limits, [[0.08, 0.84]] * 2)  # one scale for both
        figure = maps.draw(rows, ["friction"], where={"seed": 3})
        self.assertEqual(self.titles(figure), ["friction"])
        figure = maps.draw(rows, ["friction"], over=["seed", "mu"])
        self.assertEqual(self.titles(figure), [f"friction\nspeed {speed}" for speed in (1, 2, 4)])
        self.assertEqual(figure.axes[0].get_xlabel(), "seed")

    def test_a_line_over_one_option(self):
        figure = maps.draw(ROWS[:3])
        self.assertEqual([axes.get_xlabel() for axes in figure.axes], ["mu", "mu"])
        self.assertEqual(figure.axes[0].get_ylabel(), "friction [1]")

    def test_rows_of_one_measure_and_failed_runs(self):
        rows = [{"h": h, "status": "ok", "reason": None, "wall_seconds": 1, "measure": m, "error": h * k}
                for h in (1, 2) for k, m in enumerate(("mean", "peak"))]
        rows.append({"h": 3, "status": "failed", "reason": "no", "wall_seconds": 1, "measure": None, "error": None})
        with self.assertRaisesRegex(UnreadableRun, "differ in measure, error.*--where"):
            maps.draw(rows, ["error"])
        figure = maps.draw(rows, ["error"], where={"measure": "peak"})
        np.testing.assert_array_equal(figure.axes[0].lines[0].get_ydata(), [1, 2, np.nan])

    def test_what_cannot_be_drawn_is_said(self):
        for words, sentence in (({"values": ["sped"]}, "no column sped"), ({"over": ["sped"]}, "no column sped"),
                                ({"where": {"mu": 9}}, "No row has mu 9"), ({"where": {"sped": 9}}, "no column sped")):
            with self.assertRaisesRegex(UnreadableRun, sentence):
                maps.draw(ROWS, **words)
        with self.assertRaisesRegex(UnreadableRun, "No option was varied"):
            maps.draw(ROWS[:1])
        with self.assertRaisesRegex(UnreadableRun, "no table"):
            maps.draw([{"a": 1}])
        many = [{"seed": k, **entry} for k in range(30) for entry in ROWS[:4]]
        with self.assertRaisesRegex(UnreadableRun, "is the most"):
            maps.draw(many, over=["mu", "speed"])

    def test_from_the_command_line(self):
        with tempfile.TemporaryDirectory() as folder:
            table, picture = Path(folder) / "table.csv", Path(folder) / "picture.png"
            write_csv(table, ROWS)
            words = [str(table), str(picture), "--value", "friction", "--where", "speed=2", "--unit", "mu=1"]
            self.assertEqual(maps.main(words), 0)
            self.assertGreater(picture.stat().st_size, 5000)
            self.assertEqual(maps.main([*words, "--over", "sped"]), 2)


if __name__ == "__main__":
    unittest.main()
