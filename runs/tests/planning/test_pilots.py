"""What is kept of pilot runs, and what is run again."""

import tempfile
import unittest
from pathlib import Path

import yaml

from slipscale.planning import pilots


class Kept(unittest.TestCase):
    def test_only_what_was_good_is_kept(self):
        with tempfile.TemporaryDirectory() as name:
            folder, command = Path(name), ["slide", "-time_end", "1e-6"]
            self.assertIsNone(pilots.kept(folder, command))
            for status, good in (("ok", True), ("failed", False)):
                (folder / "outcome.yaml").write_text(yaml.safe_dump({"status": status, "command": "slide -time_end 1e-6"}))
                self.assertEqual(bool(pilots.kept(folder, command)), good)
                self.assertIsNone(pilots.kept(folder, [*command, "-progress", "none"]))


if __name__ == "__main__":
    unittest.main()
