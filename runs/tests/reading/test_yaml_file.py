"""YAML is read as the programs read it, or refused: equal keys, other bases, base 60, dates, NUL, two documents."""

import tempfile
import unittest
from pathlib import Path

from slipscale.mistakes import Mistake
from slipscale.reading.yaml_file import load, options, parse


class Read(unittest.TestCase):
    def refused(self, text, words, **how):
        with self.assertRaisesRegex(Mistake, words):
            parse(text, "f.yaml", **how)

    def test_numbers_are_those_of_the_programs(self):
        found = parse("a: 30e9\nb: -1e-6\nc: [2., .5, 1.2e+3]\nd: 7\ne: '017'\nf: auto\n", "f.yaml")
        self.assertEqual(found, {"a": 30e9, "b": -1e-6, "c": [2.0, 0.5, 1200.0], "d": 7, "e": "017", "f": "auto"})
        self.assertIsInstance(found["d"], int)

    def test_flags(self):
        self.assertEqual(parse("a: yes\nb: OFF\nc: 'no'\n", "f.yaml"), {"a": True, "b": False, "c": "no"})

    def test_equal_keys(self):
        self.refused("boundary: {top: {x: fixed}}\ntime: {end: 1}\nboundary: {right: {x: fixed}}\n",
                     "f.yaml gives 'boundary' twice, again near line 3")
        self.refused("a: {b: 1, c: 2, b: 3}", "gives 'b' twice")
        self.refused("a: 1\na: 2", "gives 'a' twice", written=True)

    def test_a_merge_may_be_overruled(self):
        self.assertEqual(parse("x: &x {a: 1, b: 1}\ny: {<<: *x, a: 2}\nz: {<<: *x, b: 3}\n", "f.yaml")["y"],
                         {"a": 2, "b": 1})

    def test_what_nobody_means(self):
        for text in ("017", "0x1F", "1:30", "1_000", "2026-01-31", ".inf", "0b11", "1:30.5"):
            self.refused(f"a: {text}", "write a decimal number, or put it in quotes")
            self.refused(f"a: [{text}]", "write a decimal number, or put it in quotes")
        self.assertEqual(parse("date: 2026-01-31T01:02:03Z\nx: .nan\n", "f.yaml", written=True).keys(), {"date", "x"})

    def test_keys_that_are_no_words(self):
        for key in ("yes", "1.5", "~", "[1, 2]"):
            self.refused(f"? {key}\n: 1", "key")
        self.assertEqual(parse("{y: 1, n: 2, 3: 4}", "f.yaml"), {"y": 1, "n": 2, 3: 4})

    def test_no_yaml(self):
        for text in ("a: [1, 2", "a: b: c", "a: 1\n---\nb: 2\n", "a: 1\x00\nb: 2", "a: *b"):
            self.refused(text, "f.yaml is not valid YAML")

    def test_files(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "a b.yaml"
            with self.assertRaisesRegex(Mistake, "a b.yaml cannot be read"):
                load(file)
            file.write_bytes(b"a: \xff\xfe")
            with self.assertRaisesRegex(Mistake, "no text in UTF-8"):
                load(file)
            file.write_text("- 1\n")
            with self.assertRaisesRegex(Mistake, "should hold options"):
                options(file)


if __name__ == "__main__":
    unittest.main()
