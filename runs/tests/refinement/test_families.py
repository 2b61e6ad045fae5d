"""Which mesh is made for a size, with which command, and what is refused."""

import unittest

from refinement.families import file_command, file_of, is_drawn, made_and_refined, morphology_options

DRAWN = {"morphology": {"shape": "none"}}


class Families(unittest.TestCase):
    def test_drawn_with_its_size(self):
        self.assertEqual(made_and_refined("a", DRAWN, 1e-4), (1e-4, 0))
        self.assertTrue(is_drawn(DRAWN))
        self.assertEqual(morphology_options(DRAWN, 1e-4), {"shape": "none", "size": 1e-4})
        scaled = {**DRAWN, "scaled": {"size": 2, "size_interface": 0.5}}
        self.assertEqual(morphology_options(scaled, 1e-4), {"shape": "none", "size": 2e-4, "size_interface": 5e-5})

    def test_halved(self):
        family = {**DRAWN, "refine_from": "0.5e-3"}
        self.assertEqual([made_and_refined("a", family, size) for size in (5e-4, 2.5e-4, 6.25e-5)],
                         [(5e-4, 0), (5e-4, 1), (5e-4, 3)])
        for size in (1e-3, 1e-4):
            with self.assertRaisesRegex(ValueError, "halving 0.0005 does not lead to"):
                made_and_refined("a", family, size)

    def test_files(self):
        family = {"files": {"0.5e-3": "coarse.msh", 2.5e-4: "fine.geo"}, "numbers": {"Mesh.RecombineAll": 1}}
        self.assertFalse(is_drawn(family))
        self.assertEqual([file_of("a", family, size) for size in (5e-4, 2.5e-4)], ["coarse.msh", "fine.geo"])
        with self.assertRaisesRegex(ValueError, "none for the size 0.001"):
            file_of("a", family, 1e-3)
        self.assertEqual(file_command("coarse.msh", family, 5e-4, "out/mesh.msh"), ["cp", "coarse.msh", "out/mesh.msh"])
        words = " ".join(file_command("fine.geo", family, 2.5e-4, "out/mesh.msh"))
        self.assertIn("-setnumber h 0.00025 -setnumber Mesh.RecombineAll 1 -o out/mesh.msh fine.geo", words)

    def test_one_file(self):
        self.assertEqual(file_of("a", {"file": "x.geo"}, 0.1), "x.geo")
        self.assertEqual(made_and_refined("a", {"file": "x.msh", "refine_from": 4}, 1), (4, 2))

    def test_refused(self):
        for words, family in (("give one of", {}), ("give one of", {**DRAWN, "file": "x.geo"}),
                              ("unknown entry 'recipe'", {"recipe": "x"}), ("refine_from", {"file": "x.msh"})):
            with self.assertRaisesRegex(ValueError, words):
                made_and_refined("a", family, 1.0)


if __name__ == "__main__":
    unittest.main()
