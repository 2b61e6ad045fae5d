"""What cannot be told is said as early as it is known, in one sentence that names the cure."""

import unittest

from slipscale.mistakes import Mistake
from slipscale.planning import demands
from slipscale.planning.wishes import wishes_of
from tests.planning.test_case import SCENE


class Demands(unittest.TestCase):
    def test_of_the_scene(self):
        of_point = {**SCENE, "history_points": [2.5e-3, 0]}
        for text in ("velocity:1%", "displacement:1%", "portrait:5%"):
            with self.assertRaisesRegex(Mistake, "the scene has none: name one, as -history_points"):
                demands.of_scene(wishes_of(text), SCENE)
            demands.of_scene(wishes_of(text), of_point)
        with self.assertRaisesRegex(Mistake, "give it, --before"):
            demands.of_scene(wishes_of("trajectory_velocity:1%"), of_point)
        demands.of_scene(wishes_of("trajectory_velocity:1%"), of_point, (1e-5, 3e-5))
        free = {name: value for name, value in SCENE.items() if name != "surface_boundary"}
        with self.assertRaisesRegex(Mistake, "no surface_boundary"):
            demands.of_scene(wishes_of("stick:1%"), free)

    def test_of_the_mesh(self):
        demands.of_regions(wishes_of("friction:1%,stress_inclusion:5%"), ["matrix", "inclusion"])
        with self.assertRaisesRegex(Mistake, "no region fibre, whose stress is wished for: the mesh has matrix, inclusion$"):
            demands.of_regions(wishes_of("stress_fibre:5%"), ["matrix", "inclusion"])
        with self.assertRaisesRegex(Mistake, "is stress_inclusion meant"):
            demands.of_regions(wishes_of("stress_inclusions:5%"), ["matrix", "inclusion"])

    def test_of_the_pilots(self):
        demands.of_size(wishes_of("velocity:0.1")[0], 0.5)
        with self.assertRaisesRegex(Mistake, "no less than the result itself, which is 0.5 .* is velocity:2% meant"):
            demands.of_size(wishes_of("velocity:2")[0], 0.5)


if __name__ == "__main__":
    unittest.main()
