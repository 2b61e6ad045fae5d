"""Where the programs are found, and commands whose program is missing."""

import os
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from slipscale.mistakes import Mistake
from slipscale.running import programs


class Programs(unittest.TestCase):
    def test_what_is_given_counts_first(self):
        with tempfile.TemporaryDirectory() as folder, mock.patch.dict(os.environ, {"SLIPSCALE_PROGRAMS": "/elsewhere"}):
            self.assertEqual(programs.folder(folder), Path(folder).resolve())
            self.assertEqual(programs.folder(), Path("/elsewhere"))
            self.assertEqual(programs.program("slide"), Path("/elsewhere/slide"))

    def test_those_built_or_installed_here(self):
        with tempfile.TemporaryDirectory() as folder, mock.patch.dict(os.environ), mock.patch.object(
                programs, "PLACES", (Path(folder) / "build", Path(folder) / "bin")):
            os.environ.pop("SLIPSCALE_PROGRAMS", None)
            # That is what a message names when none is there.
            self.assertEqual(programs.folder(), Path(folder) / "build")
            (Path(folder) / "bin").mkdir()
            (Path(folder) / "bin" / "slide").touch()
            self.assertEqual(programs.folder(), Path(folder) / "bin")

    def test_commands(self):
        self.assertEqual(programs.words_of(f"'{sys.executable}' -n 2"), [sys.executable, "-n", "2"])
        for command, words in (("nothing -n 2", "no program nothing"),
                               (f"{sys.executable} -n 2 a/slide", "no program a/slide"),
                               ("", "no program is named")):
            with self.assertRaisesRegex(Mistake, words):
                programs.words_of(command)


if __name__ == "__main__":
    unittest.main()
