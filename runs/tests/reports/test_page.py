"""report.html: whole, alone in its file, and with everything a reader of the run needs."""

import contextlib
import io
import re
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path

from slipscale.reports import page
from slipscale.reports.commented_yaml import group_of, rows_of
from tests import fake_run

VOID = {"meta", "img", "br", "hr", "link", "input"}


class Balanced(HTMLParser):
    """Whether every element is closed in order; and what refers to anything outside the file."""

    def __init__(self, text):
        super().__init__()
        self.open, self.outside, self.pictures = [], [], 0
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        if tag not in VOID:
            self.open.append(tag)
        self.pictures += tag == "img"
        self.outside += [value for name, value in attributes if name == "src" and not value.startswith("data:")]

    def handle_endtag(self, tag):
        if tag in VOID:
            return
        if self.open.pop() != tag:
            raise AssertionError(f"</{tag}> closes another element")


class OfARun(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name) / "a run <1>"
        fake_run.write_run(self.folder)

    def text(self):
        return page.page(self.folder)

    def test_stands_alone(self):
        found = Balanced(self.text())
        self.assertEqual((found.open, found.outside, found.pictures), ([], [], 1))

    def test_says_what_it_is(self):
        (self.folder / "run.yaml").write_text(
            "friction_coefficient: 0.5\nhistory_boundary: top\nsurface_speed: 2\ntime_end: 4e-4\n"
            "# what the run found; not options\nrun:\n  ranks: 2\n  nodes: 941\n  stable_step: 1e-9  # s\n")
        text = self.text()
        for said in ("a run &lt;1&gt;", "399.9 µs of sliding contact, 941 nodes, 2 ranks", "stick-slip-separated",
                     "mpirun -n 2 slide -options_file_yaml", "friction_coefficient", "stable_step", "impact loss"):
            self.assertTrue(said in text, said)
        self.assertFalse("had not settled" in text or "misses" in text)
        cards = dict(re.findall(r'<div class="card"><b>(.*?)</b><span>(.*?)</span>', text))
        told = {what.split(";")[0]: number for number, what in cards.items()}
        self.assertEqual(told["settled"], "yes")
        for share in ("sticks", "slips", "is open"):
            self.assertRegex(told[f"of the contact {share}"], r"^\d+\.\d+ ± 0\.\d+ %$")

    def test_few_rows_have_cards_too(self):
        fake_run.write_run(self.folder, end=1e-6)
        text = self.text()
        for said in ("not known", "mean tangential over mean normal force", "a spectrum needs 32"):
            self.assertIn(said, text)

    def test_warns(self):
        (self.folder / "summary.yaml").write_text(
            "notes:\n  note_1: the body never touches the surface\naliases: 1 MHz may be an alias\n"
            "energy:\n  largest_relative_residual: 1e-3\n")
        text = self.text()
        self.assertFalse("note_1&#x27;" in text)
        for said in ("the body never touches the surface", "1 MHz may be an alias",
                     "The energy balance misses 1.0e-03 of what flowed"):
            self.assertTrue(said in text, said)

    def test_written_where_asked(self):
        for output, words in ((self.folder / "report.html", []),
                              (self.folder.parent / "mine.html", ["--output", str(self.folder.parent / "mine.html")])):
            with contextlib.redirect_stdout(io.StringIO()):
                self.assertEqual(page.main([str(self.folder), *words]), 0)
            self.assertTrue(output.read_text().startswith("<!DOCTYPE html>"))

    def test_units_of_the_summary(self):
        (self.folder / "summary.yaml").write_text(
            "# Headline\nstep: 9.6e-09  # s\nload:  # at boundary top\n  mean: 7.1  # N/m\npeaks: [1, 2]  # Hz\n")
        self.assertEqual(rows_of(self.folder / "summary.yaml"),
                         [("step", "9.6e-09", "s"), ("load: at boundary top",), ("mean", "7.1", "N/m"),
                          ("peaks", "[1, 2]", "Hz")])
        self.assertEqual(group_of(self.folder / "summary.yaml", "load"), [("mean", "7.1", "N/m")])


class OfAStudy(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        (self.folder / "picture.png").write_bytes(b"\x89PNG not really")

    def test_readme(self):
        (self.folder / "README.md").write_text("# Study\n\n![p](picture.png)\n\n| a | b |\n|---|---|\n| 1 | 2 |\n")
        text = page.page(self.folder)
        found = Balanced(text)
        self.assertEqual((found.open, found.outside, found.pictures), ([], [], 1))
        self.assertIn("<td>1</td>", text)

    def test_table(self):
        (self.folder / "table.csv").write_text("name,friction\n" + "".join(f"r{k},0.4\n" for k in range(501)))
        text = page.page(self.folder)
        self.assertEqual(Balanced(text).pictures, 1)
        self.assertIn("The table has 501 rows; the first 500 are shown.", text)
        self.assertEqual(len(re.findall("<tr>", text)), 501)

    def test_nothing(self):
        from slipscale.mistakes import Mistake
        with self.assertRaisesRegex(Mistake, "neither a run"):
            page.page(self.folder)
        with self.assertRaisesRegex(Mistake, "There is no folder"):
            page.page(self.folder / "none")


if __name__ == "__main__":
    unittest.main()
