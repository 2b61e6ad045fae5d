"""What a command line wishes for."""

import unittest

from slipscale.mistakes import Mistake
from slipscale.planning.wishes import Wish, seconds_of, wishes_of


class Wishes(unittest.TestCase):
    def test_shares_and_values(self):
        self.assertEqual(wishes_of("friction:1%, stick:0.005,trajectory_velocity:0.05"),
                         [Wish("friction", share=0.01), Wish("stick", absolute=0.005),
                          Wish("trajectory_velocity", share=0.05)])
        self.assertEqual(wishes_of("stress_inclusion:5%")[0].kind, "stress")
        self.assertAlmostEqual(Wish("stick", absolute=0.005).allowed(0.1), 0.05)

    def test_mistakes_name_the_cure(self):
        for text, cure in (("fricton:1%", "is friction meant"), ("friction", "write friction:1%"),
                           ("friction:-1%", "write friction:1%"), ("friction:0", "write friction:1%"),
                           ("friction:1%,friction:2%", "twice"), ("stress_:1%", "can be wished for"),
                           ("friction:200%", "as large as the result"),
                           ("friction:2", "as large as the result"), ("spectrum:1", "as large as the result")):
            with self.assertRaisesRegex(Mistake, cure):
                wishes_of(text)

    def test_times(self):
        self.assertEqual([seconds_of(text) for text in ("90s", "10min", "2h", "1.5 min")], [90, 600, 7200, 90])
        for text in ("10", "0min", "-1h", "soon"):
            with self.assertRaisesRegex(Mistake, "write 90s"):
                seconds_of(text)


if __name__ == "__main__":
    unittest.main()
