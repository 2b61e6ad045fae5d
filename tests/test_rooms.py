"""The check of the rooms finds what it is there for: each fault, put into a copy of src/ and include/, is named."""

import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import rooms

CLONE = Path(__file__).resolve().parents[1]


class Rooms(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.root = Path(temporary.name).resolve()
        for folder in ("src", "include"):
            shutil.copytree(CLONE / folder, self.root / folder)
        for name in rooms.NAMED.findall((CLONE / "src/README.md").read_text()):  # what it names elsewhere
            if not rooms.is_there(self.root, name):
                (self.root / name).parent.mkdir(parents=True, exist_ok=True)
                (self.root / name).touch()

    def assert_found(self, *words):
        """Exactly one fault, which says all these words, and exit code 1."""
        found = rooms.faults(self.root)
        self.assertEqual(len(found), 1, found)
        for word in words:
            self.assertIn(word, found[0])
        done = subprocess.run([sys.executable, "-B", rooms.__file__, self.root], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout.strip()), (1, found[0]))

    def add_line(self, file, line):
        path = self.root / file
        path.write_text(f"{line}\n{path.read_text()}")

    def in_readme(self, old, new):
        path = self.root / "src/README.md"
        text = path.read_text()
        self.assertEqual(text.count(old), 1, old)
        path.write_text(text.replace(old, new))

    def test_the_house_as_it_stands(self):
        self.assertEqual(rooms.faults(CLONE), [])
        self.assertEqual(rooms.faults(self.root), [])

    def test_an_include_against_an_arrow(self):
        self.add_line("include/slipscale/contact/friction.hpp", '#include "slipscale/dynamics/scheme.hpp"')
        self.assert_found("include/slipscale/contact/friction.hpp:1", "contact includes dynamics")

    def test_siblings_do_not_know_one_another(self):
        self.add_line("src/relocalize/tiling.cpp", '#include "slipscale/homogenize/effective.hpp"')
        self.assert_found("src/relocalize/tiling.cpp:1", "relocalize includes homogenize")

    def test_an_arrow_turned_round(self):
        """Drawn from `contact` to `dynamics`: every include of `dynamics` that it carried is against it."""
        text = (self.root / "src/README.md").read_text()
        (row,) = [line for line in text.splitlines() if line.startswith("| `dynamics`")]
        self.assertIn("`contact`", row)
        self.in_readme(row, row.replace("`contact`, ", ""))
        (below,) = [line for line in text.splitlines() if line.startswith("| `contact`")]
        self.in_readme(below, below.replace("| `base`", "| `dynamics`, `base`"))
        found = "\n".join(rooms.faults(self.root))
        self.assertIn("dynamics includes contact, which no arrow", found)
        self.assertIn("the arrow from contact to dynamics is drawn, but nothing uses it", found)

    def test_a_circle(self):
        (row,) = [line for line in (self.root / "src/README.md").read_text().splitlines()
                  if line.startswith("| `base`")]
        self.in_readme(row, row.replace("| `base` | ", "| `base` | `mesh`", 1))
        self.add_line("include/slipscale/base/box.hpp", '#include "slipscale/mesh/mesh.hpp"')
        found = rooms.faults(self.root)
        self.assertEqual(found, [f"src/README.md: {room} knows itself in a circle" for room in ("mesh", "base")], found)

    def test_a_private_header(self):
        self.add_line("src/homogenize.cpp", '#include "homogenize/cell_solver.hpp"')
        self.assert_found("src/homogenize.cpp:1", "not among its public ones")

    def test_a_room_without_a_row(self):
        (self.root / "src/attic").mkdir()
        self.assert_found("no row for room attic")

    def test_a_name_that_has_gone(self):
        self.add_line("src/README.md", "See `src/contact/nowhere.cpp`.")
        self.assert_found("src/contact/nowhere.cpp")


if __name__ == "__main__":
    unittest.main()
