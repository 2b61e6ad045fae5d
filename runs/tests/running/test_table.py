"""Runs spelled out, and rows written and read back."""

import tempfile
import unittest
from pathlib import Path

from slipscale.running import table
from slipscale.running.attempt import attempt

DEFAULTS = {"mesh": "fine", "speed": 1.0, "repeat": 1}


class Runs(unittest.TestCase):
    def test_grid(self):
        self.assertEqual(table.grid({"a": [1, 2], "b": 3, "c": ["x", "y"]}),
                         [{"a": a, "b": 3, "c": c} for a in (1, 2) for c in ("x", "y")])
        self.assertEqual(table.grid({}), [{}])
        self.assertEqual(table.grid({"a": []}), [])

    def test_named_and_without_duplicates(self):
        runs = table.named_runs({"speeds": {"speed": [1.0, 2.0]}, "meshes": {"mesh": ["fine", "coarse"]},
                                 "off": {"speed": 3.0, "repeat": []}}, DEFAULTS)
        self.assertEqual(list(runs), ["fine_1.0_1", "fine_2.0_1", "coarse_1.0_1"])
        self.assertEqual(runs["coarse_1.0_1"], {"mesh": "coarse", "speed": 1.0, "repeat": 1})

    def test_name_of_one_run(self):
        runs = table.named_runs({"one": {"mesh": "coarse"}}, DEFAULTS)
        self.assertEqual([table.run_name(options) for options in runs.values()], list(runs))

    def test_refuses_an_option_without_default(self):
        with self.assertRaisesRegex(ValueError, "unknown option 'sped' .* mesh, speed, repeat"):
            table.named_runs({"speeds": {"sped": 1}}, DEFAULTS)


class Rows(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def test_collected_written_and_read(self):
        outcomes = [self.folder / name / "outcome.yaml" for name in "ab"]
        attempt(outcomes[0], ["sh", "-c", 'echo "no, \\"never\\"," ; exit 2'], {"size": 8, "rtol": 1e-10})
        attempt(outcomes[1], ["true"], {"size": 16, "rtol": 1e-10})
        rows = table.collect(outcomes, lambda folder: {"found": 0.1 + 0.2, "at": folder.name})
        table.write_csv(self.folder / "table.csv", rows)
        read = table.read_csv(self.folder / "table.csv")
        self.assertEqual(list(read[0]), ["size", "rtol", "status", "reason", "wall_seconds", "found", "at"])
        shown = [[row[name] for name in ("size", "rtol", "status", "reason", "found", "at")] for row in read]
        self.assertEqual(shown, [[8, 1e-10, "failed", 'no, "never",', None, None],
                                 [16, 1e-10, "ok", None, 0.1 + 0.2, "b"]])
        self.assertFalse(list(self.folder.glob("*.unfinished")))
        with self.assertRaisesRegex(ValueError, "b/outcome.yaml: 'size' is both an option and a result"):
            table.collect(outcomes, lambda folder: {"size": 1.0})

    def test_quickest(self):
        rows = [{"size": size, "repeat": k, "seconds": seconds, "status": status} for size, k, seconds, status in (
            (8, 1, 3.0, "ok"), (8, 2, 2.0, "ok"), (16, 1, 1.0, "failed"), (16, 2, 9.0, "ok"), (32, 1, None, "failed"))]
        self.assertEqual([(row["size"], row["repeat"]) for row in table.quickest(rows, ("size",))], [(8, 2), (16, 2)])

    def test_markdown(self):
        self.assertEqual(table.markdown(["a", "b"], [[1, "x"]]), "| a | b |\n| --- | --- |\n| 1 | x |\n")

    def test_replaced_between_its_lines(self):
        path = self.folder / "README.md"
        path.write_text("top\n<!-- report: begin, by hand -->\nold\n<!-- report: end -->\nbottom\n")
        for text in ("new\nlines\n", "newer\n"):
            table.replace_between(path, "report", text)
            self.assertEqual(path.read_text(),
                             f"top\n<!-- report: begin, by hand -->\n{text}<!-- report: end -->\nbottom\n")

    def test_refuses_a_file_without_the_lines(self):
        path = self.folder / "README.md"
        begin, end = "<!-- report: begin -->\n", "<!-- report: end -->\n"
        for text in ("", end + begin, 2 * (begin + end)):
            path.write_text(text)
            with self.assertRaisesRegex(ValueError, "needs one line"):
                table.replace_between(path, "report", "new\n")
            self.assertEqual(path.read_text(), text)


if __name__ == "__main__":
    unittest.main()
