"""A study's table as text: columns that were varied, rows that are asked for, their order, mistakes."""

import contextlib
import io
import tempfile
import unittest
from pathlib import Path

from slipscale.mistakes import Mistake
from slipscale.reports import table_command
from slipscale.running.table import write_csv


class Table(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        write_csv(self.folder / "table.csv", [
            {"mu": mu, "size": 1, "status": status, "reason": reason, "wall_seconds": 1.5, "friction": friction}
            for mu, status, reason, friction in ((0.1, "ok", None, 0.0987654), (0.3, "failed", "too large", None),
                                                 (0.2, "ok", None, 0.05))])

    def said(self, *words):
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            self.assertEqual(table_command.main([str(self.folder), *words]), 0)
        return [line.split() for line in out.getvalue().splitlines()]

    def test_what_was_varied_and_found(self):
        self.assertEqual(self.said(), [["mu", "friction", "status", "reason"], ["0.1", "0.0987654", "ok"],
                                       ["0.3", "failed", "too", "large"], ["0.2", "0.05", "ok"]])

    def test_rows_and_their_order(self):
        self.assertEqual(self.said("--sort", "friction", "--columns", "mu"), [["mu"], ["0.2"], ["0.1"], ["0.3"]])
        self.assertEqual(self.said("--where", "mu=0.2", "--columns", "friction"), [["friction"], ["0.05"]])
        self.assertEqual(self.said("--where", "mu=0.2", "--columns", "mu", "--markdown")[0], ["|", "mu", "|"])

    def test_mistakes(self):
        for words, sentence in ((["--columns", "no"], "no column no"), (["--where", "mu=9"], "no row has mu 9"),
                                (["--sort", "no"], "no column no")):
            with self.assertRaisesRegex(Mistake, sentence):
                self.said(*words)


if __name__ == "__main__":
    unittest.main()
