"""bench_parts counts from the parts of the cells what ranks hold; that plain strips are the order of the mesh, and
rectangles as good as they can be."""

import csv
import os
import subprocess
import unittest

PARTS = os.environ["BENCH_PARTS"]


def printed(*command):
    done = subprocess.run(command, capture_output=True, text=True, timeout=100)
    assert done.returncode == 0, f"exit code {done.returncode}\n{done.stdout}{done.stderr}"
    return done.stdout.splitlines()


def lines(nodes, parts, ways):
    """{(way, parts): row as numbers}"""
    rows = csv.DictReader(printed(PARTS, "-nodes", str(nodes), "-parts", ",".join(map(str, parts)), "-ways", ways))
    return {(row.pop("way"), int(row.pop("parts"))): {name: float(value) for name, value in row.items()}
            for row in rows}


class Parts(unittest.TestCase):
    def test_what_ranks_hold(self):
        for way in ("metis", "order"):
            for ranks in ("2", "4"):
                counted = printed(PARTS, "-nodes", "400", "-ways", way, "-parts", ranks, "-each", "true")
                held = printed(os.environ["MPIEXEC"], "-n", ranks, PARTS, "-nodes", "400", "-ways", way)
                self.assertEqual(counted, held, f"{way}, {ranks} ranks")
                self.assertEqual(len(held), int(ranks))

    def test_strips_are_the_order_of_the_mesh(self):
        found = lines(2500, [2, 7, 100], "order,strips")
        for parts in (2, 7, 100):
            order, strips = ({name: value for name, value in found[way, parts].items() if name != "seconds"}
                             for way in ("order", "strips"))
            self.assertEqual(order, strips)

    def test_by_hand(self):
        """33 rows of 33 nodes: 4 strips of 8 rows of cells, 2 by 2 rectangles of 16 cells."""
        found = lines(33 * 33, [4], "strips,rectangles")
        strips, squares = found["strips", 4], found["rectangles", 4]
        # a seam's nodes belong to the strip above; it holds two more rows below it and one above
        self.assertEqual((strips["owned"], strips["border"], strips["ghosts"], strips["needed"], strips["senders"],
                          strips["stretch"]), (9 * 33, 2 * 33, 3 * 33, 2 * 33, 2, 33))
        self.assertEqual((squares["owned"], squares["border"], squares["senders"], squares["stretch"]),
                         (17 * 17, 33, 3, 16.5))
        self.assertEqual((squares["ghosts"], squares["needed"]), (18 * 18 - 16 * 16, 17 + 17 + 1))


if __name__ == "__main__":
    unittest.main()
