"""How a study ends: with a sentence, and as a failure if none of its runs came to its end."""

import contextlib
import io
import tempfile
import unittest
from pathlib import Path

from slipscale.running import ended
from slipscale.running.table import write_csv


class Ended(unittest.TestCase):
    def said_of(self, *statuses):
        with tempfile.TemporaryDirectory() as folder:
            table, file = Path(folder) / "table.csv", Path(folder) / "ended.txt"
            write_csv(table, [{"mu": k, "status": status, "reason": "too slow" if status == "failed" else None}
                              for k, status in enumerate(statuses)] or [{"mu": None, "status": None}])
            said = io.StringIO()
            with contextlib.redirect_stderr(said):
                code = ended.main([str(table), str(file)])
            self.assertEqual(said.getvalue().count("\n"), 1)
            return code, file.is_file(), said.getvalue()

    def test_one_that_is_ok_is_enough(self):
        code, written, said = self.said_of("failed", "ok")
        self.assertEqual((code, written), (0, True))
        self.assertIn("1 of the 2 rows", said)

    def test_failures_alone(self):
        code, written, said = self.said_of("failed", "failed")
        self.assertEqual((code, written), (1, False))
        self.assertIn("None of the 2 rows", said)
        self.assertIn("the first: too slow", said)


if __name__ == "__main__":
    unittest.main()
