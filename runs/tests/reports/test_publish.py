"""What a study puts into its README."""

import tempfile
import unittest
from pathlib import Path

from PIL import Image

from slipscale.reports.publish import bullets, failures, publish


class Publish(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        for name in ("readme", "good", "bad"):
            (self.folder / name).mkdir()
        (self.folder / "readme" / "README.md").write_text(
            "before\n<!-- report: begin -->\nold\n<!-- report: end -->\nafter\n")
        (self.folder / "good" / "outcome.yaml").write_text("{status: ok, reason: null}")
        Image.new("RGB", (8, 8), "red").save(self.folder / "good" / "picture.png")
        (self.folder / "bad" / "outcome.yaml").write_text("{status: failed, reason: no frame}")

    def test_readme_and_pictures_are_renewed(self):
        publish("found", self.folder / "report.md", self.folder / "readme",
                [self.folder / "good" / "outcome.yaml", self.folder / "bad" / "outcome.yaml"])
        self.assertEqual((self.folder / "readme" / "README.md").read_text(),
                         "before\n<!-- report: begin -->\n\nfound\n<!-- report: end -->\nafter\n")
        self.assertEqual({file.name for file in (self.folder / "readme").glob("*.png")}, {"good.png"})
        self.assertIn("bad/outcome.yaml: no frame", (self.folder / "report.md").read_text())

    def test_no_readme_where_none_is_asked_for(self):
        publish("found", self.folder / "report.md", None, [self.folder / "good" / "picture.png"])
        self.assertEqual((self.folder / "report.md").read_text(), "found")
        self.assertEqual(list((self.folder / "readme").glob("*.png")), [])

    def test_failures_and_lists(self):
        rows = [{"mu": 0.1, "status": "ok", "reason": None}, {"mu": 0.2, "status": "failed", "reason": "too stiff"}]
        self.assertEqual(bullets(failures(rows, ("mu", "seed"))), "- Failed: mu 0.2: too stiff\n")


if __name__ == "__main__":
    unittest.main()
