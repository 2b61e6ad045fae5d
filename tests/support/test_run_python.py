"""run_python.py: what passes, and that nothing run is not a success."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

RUN = Path(__file__).with_name("run_python.py")
CASE = "import unittest\n\n\nclass Case(unittest.TestCase):\n    def {name}(self):\n        {body}\n"


class RunPython(unittest.TestCase):
    def code(self, *words, **files):
        """Exit code and standard error of run_python.py in a folder that holds `files`, {name: text}."""
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                (Path(folder) / f"{name}.py").write_text(text)
            done = subprocess.run([sys.executable, "-B", RUN, *words], cwd=folder, capture_output=True, text=True)
        return done.returncode, done.stderr

    def test_a_file(self):
        self.assertEqual(self.code("test_a.py", test_a=CASE.format(name="test_it", body="pass")), (0, ""))
        self.assertEqual(self.code("test_a.py", test_a=CASE.format(name="test_it", body="self.fail()"))[0], 1)

    def test_a_folder(self):
        self.assertEqual(self.code(".", test_a=CASE.format(name="test_it", body="pass")), (0, ""))
        self.assertEqual(self.code(".", test_a=CASE.format(name="test_it", body="self.fail()"))[0], 1)
        self.assertEqual(self.code(".", test_a="import nowhere_to_be_found")[0], 1)

    def test_nothing_run_is_a_failure(self):
        for words, files in ((["."], {}), (["."], {"other": CASE.format(name="test_it", body="pass")}),
                             (["test_a.py"], {"test_a": CASE.format(name="check_it", body="pass")}),
                             (["test_a.py"], {"test_a": CASE.format(name="test_it", body="self.skipTest('not here')")})):
            code, said = self.code(*words, **files)
            self.assertEqual(code, 1, (words, files))
            self.assertIn("no test was run", said)
        self.assertNotEqual(self.code("nowhere.py")[0], 0)


if __name__ == "__main__":
    unittest.main()
