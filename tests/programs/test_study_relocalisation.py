"""The study of relocalisation in small: what its table holds, what is run again, and what a failure leaves."""

import numpy as np

import studies


class Relocalisation(studies.StudyCase):
    study = "relocalisation"

    def one(self, measure, part, component="yy", **options):
        """The row of a run that differs in these options from the default one."""
        wanted = {"case": "stable", "seed": "1", "macro": "24", "tensors": "kubc", "recovery": "nodal", "strip": "0",
                  **options, "measure": measure, "part": part, "component": component}
        found = [row for row in self.table() if all(row[name] == value for name, value in wanted.items())]
        self.assertEqual(len(found), 1, wanted)
        return {name: float(found[0][name] or "nan") for name in ("reference", "relocalised", "homogeneous")}

    def test_relocalisation_and_what_is_run_again(self):
        self.run_study()
        self.assertEqual({row["status"] for row in self.table()}, {"ok"})
        for case in ("stable", "transient"):
            error = self.one("error", "bulk", case=case)
            self.assertLess(error["relocalised"], 0.1 * error["homogeneous"], case)
            for component in ("normal", "shear"):
                error = self.one("interface_error", "all", component, case=case)
                self.assertLess(error["relocalised"], 0.6 * error["homogeneous"], (case, component))
        # The tensors of a block know nothing of a contact. The correction ends half a strip above it, below the bulk.
        before, after = (self.one("error", "layer", "xx", strip=strip)["relocalised"] for strip in ("0", "0.001"))
        self.assertLess(after, 0.6 * before)
        np.testing.assert_equal(self.one("error", "bulk", strip="0.001"), self.one("error", "bulk"))

        # A homogeneous body does not know which phase carries the load; a cell of another draw does.
        for tensors, macro in (("kubc", "24"), ("periodic", "12")):
            soft, stiff = (self.one("average", phase, tensors=tensors, macro=macro)
                           for phase in ("matrix", "inclusion"))
            ratio = {source: stiff[source] / soft[source] for source in soft}
            self.assertTrue(1 < ratio["reference"] < 80 / 30, ratio)  # between equal stress and equal strain
            missed, left = (abs(ratio[source] - ratio["reference"]) for source in ("homogeneous", "relocalised"))
            self.assertLess(left, 0.4 * missed, ratio)

        text = (self.out / "report.md").read_text()
        for words in ("| stable | 1 | 24 | subc | nodal | 0.001 |", "Transient, σ_yy all", "matrix at 2.5, 0.25 mm"):
            self.assertIn(words, text)
        for name in ("stable", "transient", "histories"):
            self.assertGreater((self.out / "picture" / name / "picture.png").stat().st_size, 50000)

        before = self.written()
        self.assertIn("Nothing to be done", self.run_study())
        # What is new is run, nothing else; a failure, here a strip as deep as the block, becomes a row.
        runs = {**self.reduced["runs"], "strips": {"macro": 24, "strip": 9.0}}
        late = {"stable": {"run": {"macro": 24}, "words": "--time 1"}}  # a time that has no frame
        self.run_study(runs=runs, pictures=late)
        self.assertEqual(self.run_again(before), {"run/stable_1_24_kubc_nodal_9.0", "picture/stable"})
        failed = [row for row in self.table() if row["status"] != "ok"]
        self.assertEqual([(row["strip"], row["measure"]) for row in failed], [("9.0", "")])
        self.assertIn("strip", failed[0]["reason"])
        text = (self.out / "report.md").read_text()
        for words in (f"strip 9.0: {failed[0]['reason']}", "No picture: "):
            self.assertIn(words, text)


if __name__ == "__main__":
    studies.main()
