"""What a study is asked to do: overlays that merge or replace, the README, and what is said before anything runs."""

import tempfile
import unittest
from pathlib import Path

from slipscale.mistakes import Mistake
from slipscale.running.studies import finder, settings_of, what_is_run

STUDY = """
output: out/mine
readme: true
scene: {speed: 2, law: none}
runs:
  many: {seed: [1, 2, 3], load: [1, 2]}
  few: {seed: 1}
"""


class Settings(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        (self.folder / "study.yaml").write_text(STUDY)

    def settings(self, *overlays, **more):
        files = []
        for k, text in enumerate(overlays):
            files.append(self.folder / f"over {k}.yaml")
            files[-1].write_text(text)
        return settings_of(self.folder / "study.yaml", files, **more)

    def test_as_it_stands(self):
        found = self.settings()
        self.assertTrue(found["readme"])
        self.assertEqual(what_is_run(found, range(7)),
                         "7 runs: many 6, few 1; they and the table are written to out/mine")

    def test_an_overlay_adds_and_it_is_said(self):
        found = self.settings("runs: {own: {seed: 4}}\nscene: {law: coulomb}\n")
        self.assertEqual(found["scene"], {"speed": 2, "law": "coulomb"})
        self.assertEqual(list(found["runs"]), ["many", "few", "own"])
        self.assertFalse(found["readme"])  # own runs do not go into the README of the study
        self.assertIn("not of what is laid over it: many, few; `replace: [runs]`", what_is_run(found, range(8)))

    def test_an_overlay_replaces(self):
        found = self.settings("replace: [runs]\nruns: {own: {seed: [4, 5]}}\n")
        self.assertEqual(found["runs"], {"own": {"seed": [4, 5]}})
        self.assertEqual(what_is_run(found, range(2)), "2 runs: own 2; they and the table are written to out/mine")
        with self.assertRaisesRegex(Mistake, "replaces figures but has no entry"):
            self.settings("replace: [figures]\n")

    def test_the_command_line_is_laid_over_all(self):
        found = self.settings("output: out/other\n", given={"output": "out/third", "scene": {"speed": 3}, "study": "x"},
                              words=["output=out/third", "scene={speed: 3}", "study=x"])
        self.assertEqual((found["output"], found["scene"]), ("out/third", {"speed": 3, "law": "none"}))
        self.assertNotIn("study", found)

    def test_equal_keys_in_an_overlay(self):
        with self.assertRaisesRegex(Mistake, "gives 'runs' twice"):
            self.settings("runs: {a: {seed: 1}}\nruns: {b: {seed: 2}}\n")

    def test_files_from_here_or_of_the_study(self):
        found = finder(self.folder)
        self.assertEqual(found("study.yaml"), str(self.folder / "study.yaml"))
        self.assertEqual(found("nothing.yaml"), "nothing.yaml")


if __name__ == "__main__":
    unittest.main()
