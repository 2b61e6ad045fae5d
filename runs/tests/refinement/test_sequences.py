"""Sequences spelled out into runs, and what is refused."""

import unittest

from refinement.sequences import OPTIONS, chains

BASE = {"name": "a", "scene": "r", "family": "block", "variants": "coulomb", "window": ["1.0e-6", 2e-6]}


def one(**entries):
    return chains([{**BASE, **entries}])[0]


def pairs(chain):
    return [(run["size"], run["step"]) for run in chain.runs]


class Spelling(unittest.TestCase):
    def test_step_in_proportion_from_coarse_to_fine(self):
        chain = one(size=[1e-4, "2.5e-4", 5e-4], step_per_size=20e-6)
        self.assertEqual(pairs(chain), [(5e-4, 1e-8), (2.5e-4, 5e-9), (1e-4, 2e-9)])
        self.assertEqual((chain.along, chain.reference, tuple(chain.runs[0])), ("size", chain.runs[-1], OPTIONS))
        self.assertTrue(chain.has_own_reference())
        self.assertEqual(chain.entries["window"], [1e-6, 2e-6])

    def test_one_of_both_is_kept(self):
        mesh = one(size=[2, 1], step=0.5)
        self.assertEqual((mesh.along, pairs(mesh)), ("size", [(2, 0.5), (1, 0.5)]))
        step = one(size=2, step=[0.1, 0.4])
        self.assertEqual((step.along, pairs(step)), ("step", [(2, 0.4), (2, 0.1)]))
        automatic = one(size=[2, 1], step="auto")
        self.assertEqual(pairs(automatic), [(2, "auto"), (1, "auto")])

    def test_pairs(self):
        self.assertEqual(pairs(one(size=[1, 2], step=[0.1, 0.3])), [(2, 0.3), (1, 0.1)])

    def test_every_variant_by_itself(self):
        found = chains([{**BASE, "variants": ["x", "y"], "size": [2, 1], "step": 1},
                        {**BASE, "name": "b", "size": 1, "step": 1}])
        self.assertEqual([(each.name, each.variant) for each in found], [("a", "x"), ("a", "y"), ("b", "coulomb")])
        self.assertEqual([run["variant"] for run in found[1].runs], ["y", "y"])

    def test_every_family_by_itself(self):
        both = {**BASE, "family": ["squares", "discs"], "size": [2, 1], "step": 1}
        found = chains([both])
        self.assertEqual([(each.variant, each.runs[0]["family"], each.runs[0]["variant"]) for each in found],
                         [("squares", "squares", "coulomb"), ("discs", "discs", "coulomb")])
        self.assertEqual([each.reference["family"] for each in found], ["squares", "discs"])
        self.assertEqual([each.variant for each in chains([{**both, "variants": ["x", "y"]}])],
                         ["squares-x", "squares-y", "discs-x", "discs-y"])

    def test_another_reference(self):
        chain = one(size=[2, 1], step_per_size=0.1, reference={"size": 0.5, "family": "other"})
        self.assertEqual(chain.reference, {"scene": "r", "family": "other", "variant": "coulomb", "size": 0.5,
                                           "step": 0.05})
        self.assertFalse(chain.has_own_reference())
        self.assertEqual(one(size=[2, 1], step=3, reference={"size": 0.5}).reference["step"], 3)

    def test_refused(self):
        for words, entries in (("unknown entry 'sizes'", {"size": 1, "step": 1, "sizes": 1}),
                               ("step or step_per_size", {"size": 1}),
                               ("step or step_per_size", {"size": 1, "step": 1, "step_per_size": 1}),
                               ("'T = 1' names files", {"size": 1, "step": 1, "variants": ["x", "T = 1"]}),
                               ("lacks size", {"step": 1}),
                               ("2 steps do not go with 3 sizes", {"size": [1, 2, 3], "step": [1, 2]}),
                               ("stands there twice", {"size": [1, 2, 1], "step": 1}),
                               ("'h' in its reference", {"size": 1, "step": 1, "reference": {"h": 2}})):
            with self.assertRaisesRegex(ValueError, words):
                one(**entries)


if __name__ == "__main__":
    unittest.main()
