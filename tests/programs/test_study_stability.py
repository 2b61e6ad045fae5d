"""The study of stability in small: growth that is seen is that of a mode, and what its tables hold."""

import csv

import studies


class Stability(studies.StudyCase):
    study = "stability"

    def rows(self, name):
        with (self.out / name).open(newline="") as file:
            return list(csv.DictReader(file))

    def test_growth_map_and_equivalence(self):
        self.run_study()
        growth = self.rows("table.csv")
        self.assertEqual([(row["model"], row["status"]) for row in growth],
                         [("plain", "ok"), ("composite", "ok"), ("homogenised", "ok")])
        for row in growth:
            self.assertLess(abs(float(row["growth_seen"]) / float(row["growth_scheme"]) - 1), 1e-6, row)
            self.assertLess(abs(float(row["frequency_seen"]) / float(row["frequency_scheme"]) - 1), 1e-8, row)
            self.assertEqual(row["closed_seen"], row["closed"])
        swept = self.rows("map.csv")
        self.assertEqual(len(swept), 4)
        self.assertEqual({row["status"] for row in swept}, {"ok"})
        for row in swept:  # more friction grows faster
            self.assertEqual(row["growing"] == "0", row["coefficient"] == "0.1", row)
        judged = self.rows("equivalence.csv")
        self.assertEqual({row["status"] for row in judged}, {"ok"})
        for row in judged:  # little friction: next to nothing grows, in one of the bodies at most
            self.assertEqual(row["expected"] in ("nothing grows", "only one grows"), row["coefficient"] == "0.2", row)
        self.assertTrue(all(float(row["likeness"]) <= 1 for row in self.rows("pairs.csv") if row["likeness"]))
        for name in ("growth", "map"):
            self.assertGreater((self.out / "picture" / name / "picture.png").stat().st_size, 20000)
        report = (self.out / "report.md").read_text()
        for words in ("(a) 3 runs of slide, 3 with a stretch", "(b) 4 points of the sweep", "(c) "):
            self.assertIn(words, report)
        self.assertIn("Nothing to be done", self.run_study())


if __name__ == "__main__":
    studies.main()
