"""Every option that `relocalize -help` lists changes the result as expected, or is refused where it has no effect."""

import re
import shutil
import unittest
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from every_option import ALWAYS, Answer, Idle, Row, becomes, differs, grows, more, same
from homogenising import RUN as MICRO
from homogenising import SIDE as PERIOD
from relocalizing import COMPARED, RUN, Relocalising, replace
from running import arguments_of, datasets, h5py
from scenes import block

RANKS = 2
AT_ONCE = 2
ORIGIN = np.array([0.3e-3, 0.2e-3])
TILED = {"relocalize_tensors": "torus"}
STRIP = {"relocalize_correction": "strip", "relocalize_strip": 2e-3}
STRONG = {"interfaces_region": "inclusion", "interfaces_normal_strength": 1e6, "interfaces_shear_strength": 1e6}
NO_REGION = "without -interfaces_region"
ALONE = "without -relocalize_reference"
ROWS_OF_CELLS = 8


# The numbers: functions of a run.
def stress(run):
    return run.local["frames/00003/stress"]


def index(run):
    return run.interfaces["index"].sum()


def off_the_origin(run):
    """From the chosen origin to the nearest point of the mesh, in periods: each tile has one at its corner."""
    return np.linalg.norm(run.local["mesh/coordinates"] - ORIGIN, axis=1).min() / PERIOD


def share(part):
    return lambda run: run.comparison["area"][part]["share"]


def bulk(rows):
    """Of the area, without so many rows of cells at every edge."""
    return (1 - 2 * rows / ROWS_OF_CELLS)**2


# `OPTION` among the changes stands for the option itself.
ROWS = {
    "relocalize_run": Row([Answer({"OPTION": "twice"}, stress, grows(2))], ALWAYS),
    "relocalize_tensors": Row([Answer({"OPTION": "stiffer"}, stress, grows(3))], ALWAYS),
    "relocalize_reference": Row([Answer({**COMPARED, "OPTION": "heterogeneous"},
                                        lambda run: int("comparison.yaml" in run.files), more)], ALWAYS),
    "relocalize_origin": Row([Answer({"OPTION": ",".join(map(str, ORIGIN))}, off_the_origin,
                                     lambda before, after: before > 1e-3 and after < 1e-9, base=TILED)], ALWAYS),
    "relocalize_recovery": Row([Answer({"OPTION": "element"}, stress, differs(1e-3, 1))], ALWAYS),
    "relocalize_points": Row([Answer({"OPTION": "1e-3,1e-3,2e-3,2e-3"},
                                     lambda run: int("points/1/stress" in run.local), more)], ALWAYS),
    "relocalize_correction": Row([Answer({**STRIP, "OPTION": "strip"}, stress, differs(1e-3, 10))], ALWAYS),
    "relocalize_strip": Row([Answer({"OPTION": 3e-3}, stress, differs(1e-3, 10), base=STRIP)],
                            [Idle({"OPTION": 2e-3}, "with -relocalize_correction none")]),
    # A cell of the block's mesh is 0.625 mm high.
    "relocalize_layer": Row([Answer({"OPTION": 1.3e-3}, share("layer"), becomes(2 / ROWS_OF_CELLS), base=COMPARED)],
                            [Idle({"OPTION": 1e-3}, ALONE)]),
    "relocalize_bulk": Row([Answer({"OPTION": 1.3e-3}, share("bulk"), becomes(bulk(2)), base=COMPARED),
                            Answer({"OPTION": 0}, share("bulk"), becomes(1), base=COMPARED)],
                           [Idle({"OPTION": 1e-3}, ALONE)]),
    # Of which the numbers are looked at in test_relocalize_interfaces.py.
    "interfaces_region": Row([Answer({"OPTION": "inclusion"}, lambda run: int("interfaces.yaml" in run.files), more)],
                             [Idle({"OPTION": "fibre"}, "the mesh has the regions 'matrix', 'inclusion'")]),
    "interfaces_normal_strength": Row([Answer({"OPTION": 5e5}, index, more, base={**STRONG, "relocalize_run": "pulled"})], [Idle({"OPTION": 1e6}, NO_REGION)]),
    "interfaces_shear_strength": Row([Answer({"OPTION": 5e5}, index, more, base=STRONG)], [Idle({"OPTION": 1e6}, NO_REGION)]),
    "output_folder": Row([Answer({"OPTION": "out/deeper"}, lambda run: int("deeper/relocalized.h5" in run.files),
                                 more)], ALWAYS),
    # For people in front of a terminal.
    "progress": Row([Answer({"OPTION": "none"}, stress, same)], ALWAYS),
    # A place for information; the only option that promises to do nothing.
    "run_<entry>": Row([Answer({"run_note": "mine"}, stress, same)], ALWAYS),
}


def run_of(changes, option, base=None):
    """RUN with changes, `OPTION` among them named."""
    return {**RUN, **(base or {}), **{option if key == "OPTION" else key: value for key, value in changes.items()}}


class Run:
    """What a run left behind."""

    def __init__(self, test, folder):
        self.local = test.local(folder)
        followed = (test.folder / folder / "interfaces.h5").exists()
        self.interfaces = test.local(folder, "interfaces.h5") if followed else None
        self.files = {str(path.relative_to(test.folder / "out")) for path in (test.folder / "out").rglob("*")}
        compared = (test.folder / folder / "comparison.yaml").exists()
        self.comparison = test.comparison(folder) if compared else None


class EveryOption(Relocalising):
    def setUp(self):
        super().setUp()
        block(self.folder / "block.msh", regions=("matrix", "inclusion"), divisions=ROWS_OF_CELLS)
        self.make_runs()
        self.draw_cell(self.folder / "cell.msh")
        self.run_cell(MICRO, output_folder="torus")
        for folder, factor in (("twice", 2), ("pulled", -1)):
            shutil.copytree(self.folder / "homogeneous", self.folder / folder)
            for name, rows in datasets(self.folder / folder / "fields.h5").items():
                if name.endswith("/strain"):
                    replace(self.folder / folder / "fields.h5", name, factor * rows)
        shutil.copytree(self.folder / "cell", self.folder / "stiffer")
        with h5py.File(self.folder / "stiffer" / "localization.h5", "r+") as file:
            file["region/stiffness"][...] *= 3
            file["effective/stiffness"][...] *= 3
        self.runs = {}

    def result(self, run, ranks):
        """Of a run, made once."""
        key = (repr(sorted(run.items(), key=str)), ranks)
        if key not in self.runs:
            self.run_relocalize(run, ranks=ranks)
            self.runs[key] = Run(self, run["output_folder"])
        return self.runs[key]

    def test_the_table_has_every_option(self):
        outcome = self.relocalize("-help", ranks=RANKS)
        self.assertEqual((outcome.codes, outcome.err), ([0] * RANKS, ""))
        self.assertEqual(sorted(re.findall(r"^  -(\S+)  ", outcome.out, re.MULTILINE)), sorted(ROWS))

    def test_answers(self):
        for option, row in ROWS.items():
            for answer in row.answers:
                with self.subTest(option=option, changes=answer.changes):
                    before = answer.number(self.result(run_of({}, option, answer.base), answer.ranks))
                    after = answer.number(self.result(run_of(answer.changes, option, answer.base), answer.ranks))
                    self.assertTrue(answer.expectation(before, after), f"{before} has become {after}")

    def test_refused_where_idle(self):
        with ThreadPoolExecutor(AT_ONCE) as pool:
            refusals = [(option, idle, pool.submit(self.relocalize, *arguments_of(run_of(idle.changes, option)),
                                                   ranks=RANKS))
                        for option, row in ROWS.items() for idle in row.idle]
            for option, idle, refusal in refusals:
                with self.subTest(option=option, words=idle.words):
                    self.assert_refused("relocalize", refusal.result(), [f"-{option} ", idle.words, "; "], RANKS)
        self.assertFalse((self.folder / "out").exists(), "files were touched")

    def test_the_command_line_wins(self):
        """What it makes idle in a file is set aside, and said so."""
        (self.folder / "run.yaml").write_text("".join(f"{name}: {value}\n" for name, value in {**RUN, **STRIP}.items()))
        said = self.run_relocalize({"options_file_yaml": "run.yaml", "relocalize_correction": "none"}, ranks=RANKS)
        self.assertIn("note: -relocalize_strip of run.yaml has no effect with -relocalize_correction none", said)


if __name__ == "__main__":
    unittest.main()
