"""What is said of a sweep's table."""

import unittest

from slipscale.reports import sweep_report


def row(mu, size, friction, frequency=1e5, regime="slip", status="ok"):
    return {"mu": mu, "size": size, "seed": 1, "status": status, "reason": None if status == "ok" else "no such thing",
            "wall_seconds": 1.0, "friction": friction, "frequency": frequency, "amplitude": 0.1, "stick": 0.0,
            "open": 0.0, "power_ratio": 0.0, "settled": "true", "amplitude_ratio": 1.0,
            "regime": regime if status == "ok" else None}


ROWS = [row(0.1, 2, 0.10), row(0.1, 1, 0.12), row(0.1, 4, 0.11, 1.2e5), row(0.2, 1, 0.2, 0.0),
        row(0.2, 2, 0.25, regime="stick-slip"), row(0.2, 4, None, None, status="failed")]


class Report(unittest.TestCase):
    def test_pairs_are_neighbours_and_differ_in_one_option(self):
        pairs = [[(r["mu"], r["size"]) for r in pair] for pair in sweep_report.changes(ROWS, "size")]
        self.assertEqual(sorted(pairs), [[(0.1, 1), (0.1, 2)], [(0.1, 2), (0.1, 4)], [(0.2, 1), (0.2, 2)]])

    def test_changes(self):
        lines = sweep_report.change_table(ROWS, "size").splitlines()[2:]
        self.assertEqual(lines, ["| mu 0.1 | 2 | 0.0150 | 0.0200 | 1 | 0 |",
                                 "| mu 0.2 | 1 | 0.0500 | 0.0500 | 0 | 1 |"])

    def test_the_whole(self):
        text = sweep_report.report(ROWS, "size")
        for words in ("6 runs, 1 failed; regimes: 4 slip, 1 stick-slip.", "Friction from 0.1000 (mu 0.1, size 2) to",
                      "Failed: mu 0.2, size 4, seed 1: no such thing", "neighbouring values of size",
                      "| 0.2 | 4 | 1 | - |"):
            self.assertIn(words, text)
        self.assertNotIn("neighbouring", sweep_report.report(ROWS))
        self.assertNotIn("neighbouring", sweep_report.report(ROWS, "seed"))

    def test_what_has_not_settled(self):
        quiet, grows, decays = ({**ROWS[0], **change} for change in (
            {"amplitude": 0.001, "settled": "false"}, {"settled": "false"}, {"settled": "true"}))
        self.assertIn("2 runs vibrate (amplitude above 0.01); 1 of these, and 1 of the others, had not settled",
                      sweep_report.unsettled([quiet, grows, decays, ROWS[-1]]))
        self.assertIn("5 runs vibrate (amplitude above 0.01); 0 of these, and 0 of the others,",
                      sweep_report.unsettled(ROWS))

    def test_what_few_rows_lack(self):
        few = {**row(0.3, 1, 0.3, None), "reason": "Only 8 rows are recorded"}
        text = sweep_report.report([*ROWS, few])
        self.assertIn("In part: mu 0.3, size 1, seed 1: Only 8 rows are recorded", text)
        self.assertIn("7 runs, 1 failed", text)

    def test_nothing_but_failures(self):
        rows = [row(mu, 1, None, None, status="failed") for mu in (1, 2)]
        self.assertIn("2 runs, 2 failed; regimes: none.", sweep_report.report(rows, "mu"))


if __name__ == "__main__":
    unittest.main()
