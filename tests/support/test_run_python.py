"""run_python.py: what passes, and that nothing run is not a success."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

RUN = Path(__file__).with_name("run_python.py")
CASE = "import unittest\n\n\nclass Case(unittest.TestCase):\n    def {name}(self):\n        {body}\n"


class RunPython(unittest.TestCase):
    def code(self, text, *names):
        """Exit code and standard error of run_python.py with a file that holds `text`, and cases of it."""
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "test_a.py"
            file.write_text(text)
            done = subprocess.run([sys.executable, "-B", RUN, file, *names], capture_output=True, text=True)
        return done.returncode, done.stderr

    def test_success_and_failure(self):
        self.assertEqual(self.code(CASE.format(name="test_it", body="pass")), (0, ""))
        self.assertEqual(self.code(CASE.format(name="test_it", body="self.fail()"))[0], 1)
        self.assertNotEqual(self.code("import nowhere_to_be_found")[0], 0)

    def test_cases_by_name(self):
        text = CASE.format(name="test_it", body="pass") + "\n    def test_other(self):\n        self.fail()\n"
        self.assertEqual(self.code(text, "Case.test_it"), (0, ""))
        self.assertEqual(self.code(text, "Case.test_other")[0], 1)
        self.assertEqual(self.code(text, "Case.test_gone")[0], 1)

    def test_nothing_run_is_a_failure(self):
        for text in ("", CASE.format(name="check_it", body="pass"),
                     CASE.format(name="test_it", body="self.skipTest('not here')")):
            code, said = self.code(text)
            self.assertEqual(code, 1, text)
            self.assertIn("no test was run", said)


if __name__ == "__main__":
    unittest.main()
