"""The command: its table, its manual, its mistakes; and that modules of the library are no commands."""

import contextlib
import io
import os
import subprocess
import sys
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from slipscale import command

RUNS = Path(__file__).parents[1]


def said_by(*words):
    """Exit code, what went to stdout and to stderr."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            code = command.main(list(words))
        except SystemExit as stop:
            code = stop.code
    return code, out.getvalue(), err.getvalue()


def started(job):
    """What a file below runs/ says when Python is told to run it."""
    file, way = job
    words = ["-m", ".".join(file.relative_to(RUNS).with_suffix("").parts)] if way == "-m" else [str(file)]
    return file, way, subprocess.run([sys.executable, *words], cwd=RUNS, capture_output=True, text=True,
                                     env={**os.environ, "PYTHONPATH": str(RUNS)})


class Command(unittest.TestCase):
    def test_every_subcommand_has_a_manual(self):
        code, manual, _ = said_by("-h")
        self.assertEqual(code, 0)
        for name in command.known():
            self.assertIn(f"  {name} ", manual)
            code, out, _ = said_by(name, "-h")
            self.assertEqual(code, 0, name)
            self.assertIn(f"slipscale {name}", out)
            self.assertNotIn("python3 -m", out)

    def test_mistakes_are_one_sentence(self):
        for words, sentence in ((("pictur",), "is picture meant?"), (("picture", "a", "b.png", "--windw", "1", "2"),
                                                                    "--windw is not an option; is --window meant?"),
                                (("picture", "/nowhere", "b.png"), "There is no history.h5 in /nowhere"),
                                (("compare", "/nowhere", "/nowhere"), "There is no history.h5"),
                                (("table", "/nowhere"), "there is no /nowhere"),
                                (("maps", "/nowhere", "a.png"), "/nowhere"),
                                (("scene", "/nowhere", "a.png"), "/nowhere cannot be read"),
                                (("wear", "/nowhere", "a", "--energy", "1"), "There is no contact.h5"),
                                (("cell-picture", "/nowhere", "a.png"), "There is no localization.h5"),
                                (("adapt", "/nowhere", "/nowhere", "--output", "o", "--program", "nothing"),
                                 "there is no program nothing")):
            code, out, err = said_by(*words)
            self.assertEqual((code, out, err.count("\n")), (2, "", 1), (words, err))
            self.assertIn(sentence, err)
            self.assertTrue(err.startswith("slipscale"), err)

    def test_what_is_no_command_says_so(self):
        """A module is a command, with a parser of its own, or says in one sentence what the command is, started by
        `python3 -m` and as a file. None does nothing and ends well."""
        files = [file for file in RUNS.rglob("*.py") if not {"tests", "profiles"} & set(file.relative_to(RUNS).parts)
                 and not file.name.startswith("__")]
        tried = []
        for file in files:
            text, of_package = file.read_text(), file.is_relative_to(RUNS / "slipscale")
            if "sys.exit(main())" in text:
                self.assertIn(f'Parser("{".".join(file.relative_to(RUNS).with_suffix("").parts)}"', text)
            elif "raise SystemExit(" in text or not of_package:
                tried += [(file, "-m"), (file, "file")]
            else:  # refused by what the package does first when it is loaded, as those are that are tried
                self.assertRegex(text, r"(?m)^(from|import) slipscale", file)
        tried += [(RUNS / "slipscale" / "measuring" / "regime.py", way) for way in ("-m", "file")]
        self.assertGreater(len(tried), 60)
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            for file, way, done in pool.map(started, tried):
                self.assertNotEqual(done.returncode, 0, (file, way))
                self.assertEqual(done.stdout, "", (file, way))
                self.assertRegex(done.stderr, r"^[^\n]*no command: [^\n]*\n$", (file, way))

    def test_measuring_and_reading_draw_nothing(self):
        listed = ("import sys, slipscale.measuring.regime, slipscale.measuring.comparing, "
                  "slipscale.measuring.surface_motion; print([name for name in sys.modules if 'matplotlib' in name])")
        done = subprocess.run([sys.executable, "-c", listed],
                              cwd=RUNS, capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout.strip(), "[]")


if __name__ == "__main__":
    unittest.main()
