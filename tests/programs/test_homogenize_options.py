"""Every option that `homogenize -help` lists changes the result as expected, or is refused where it has no effect."""

import re
import unittest
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from every_option import ALL_NAMED, ALWAYS, Answer, Idle, Row, becomes, grows, less, more, same
from homogenising import ONE_REGION, RUN, Homogenising
from running import arguments_of

RANKS = 2
AT_ONCE = 2
YOUNG, POISSON, DENSITY = (RUN[f"material_inclusion_{key}"] for key in ("young", "poisson", "density"))
SHEAR = YOUNG / (2 * (1 + POISSON))
LAME = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))
FOUR_TIMES = ",".join(str(4 * c) for c in (LAME + 2 * SHEAR, LAME + 2 * SHEAR, LAME, SHEAR, 0, 0))
BY_FILE = {**ONE_REGION, "OPTION": "four_times.yaml"}
ISOTROPIC = {"material_inclusion_young": None, "material_inclusion_poisson": None}
BLOCK_JACOBI = {"cell_ksp_type": "cg", "cell_pc_type": "bjacobi"}  # one block for each rank


# The numbers: functions of a run.
def diagonal(run):
    """C11, C22, C66: no more under a softer condition or with softer phases."""
    return np.array([run.effective["stiffness"][k] for k in (0, 1, 3)])


def inclusion(run):
    """C11 and C66 of the inclusion's material."""
    return np.array([run.phase("inclusion")["stiffness"][k] for k in (0, 3)])


def density_of_inclusions(run):
    """From that of the whole."""
    fraction = run.phase("inclusion")["fraction"]
    return (run.effective["density"] - RUN["material_matrix_density"] * (1 - fraction)) / fraction


def close(before, after):
    return np.allclose(after, before, rtol=1e-9)


CELLS = lambda run: run.facts["cells"]
CONDITIONS = lambda run: len({"periodic", "kubc", "subc"} & set(run.facts))
ITERATIONS = lambda run: np.array(run.facts["periodic"]["cost"]["iterations"])
ERROR_BARS = lambda run: int("discretisation_error_xx" in run.facts["periodic"])
CONTRADICTED = Idle({"material_inclusion_file": "four_times.yaml"}, "contradicts -material_inclusion_file; give one")

RUBS = {"friction_matrix_coefficient": 0.5, "friction_inclusion_coefficient": 0.5}


def becomes_mean(before, after):
    """Of .5 and 0 by the fractions of matrix and inclusion, from .5."""
    return abs(before - 0.5) < 1e-9 and 0.2 < after < 0.45


# `OPTION` among the changes stands for the option itself, `<region>` is `inclusion`.
ROWS = {
    "mesh_file": Row([Answer({"OPTION": "fine.msh"}, CELLS, more)], ALWAYS),
    # How a mesh is cut changes the way to the result, and not the result.
    "mesh_partitioner": Row([Answer({"OPTION": "simple"}, diagonal, close, ranks=2),
                             Answer({"OPTION": "simple"}, ITERATIONS, lambda before, after: np.any(after != before),
                                    base=BLOCK_JACOBI, ranks=2)], ALWAYS),
    "mesh_refine": Row([Answer({"OPTION": 1}, CELLS, grows(4))], ALWAYS),

    "material_<region>_young": Row([Answer({"OPTION": 4 * YOUNG}, inclusion, grows(4)),
                                    Answer({"OPTION": 4 * YOUNG}, diagonal, more)],
                                   [Idle({"material_all_young": YOUNG}, ALL_NAMED), CONTRADICTED]),
    # With E the same, C11 grows with ν and C66 goes down.
    "material_<region>_poisson": Row([Answer({"OPTION": 0.4}, lambda run: diagonal(run)[:2], more),
                                      Answer({"OPTION": 0.4}, lambda run: diagonal(run)[2], less)],
                                     [Idle({"material_all_poisson": POISSON}, ALL_NAMED)]),
    "material_<region>_stiffness": Row([Answer({**ISOTROPIC, "OPTION": FOUR_TIMES}, inclusion, grows(4)),
                                        Answer({**ISOTROPIC, "OPTION": FOUR_TIMES}, diagonal, more)],
                                       [Idle({"material_all_stiffness": FOUR_TIMES}, ALL_NAMED),
                                        Idle({"OPTION": FOUR_TIMES}, "contradicts -material_inclusion_stiffness")]),
    "material_<region>_density": Row([Answer({"OPTION": 2 * DENSITY}, density_of_inclusions, becomes(2 * DENSITY))],
                                     [Idle({"material_all_density": DENSITY}, ALL_NAMED)]),
    "material_<region>_file": Row([Answer(BY_FILE, inclusion, grows(4)),
                                   Answer(BY_FILE, density_of_inclusions, becomes(3 * DENSITY))],
                                  [Idle({"material_all_file": "four_times.yaml"}, ALL_NAMED)]),
    "material_file": Row([Answer(BY_FILE, inclusion, grows(4)),
                          Answer(BY_FILE, density_of_inclusions, becomes(3 * DENSITY))],
                         [Idle({"OPTION": "four_times.yaml"}, ALL_NAMED)]),

    "cell_boundary": Row([Answer({"OPTION": "kubc"}, diagonal, more), Answer({"OPTION": "subc"}, diagonal, less),
                          Answer({"OPTION": "all"}, CONDITIONS, becomes(3))], ALWAYS),
    "cell_estimate_error": Row([Answer({"OPTION": "false"}, ERROR_BARS, becomes(0)),
                                Answer({"OPTION": "false"}, diagonal, same)], ALWAYS),
    "friction_<region>_coefficient": Row(
        [Answer({"OPTION": 0}, lambda run: run.facts["friction_mean"], becomes_mean, base=RUBS),
         Answer({"OPTION": 0}, lambda run: run.facts["friction_coefficient"] / run.facts["friction_mean"], less, base=RUBS),
         Answer({"OPTION": 0.5}, lambda run: run.facts["friction_coefficient"], same, base=RUBS)],
        [Idle({"OPTION": 0.5}, "needs that of every phase; give -friction_matrix_coefficient")]),
    "output_folder": Row([Answer({"OPTION": "out/deeper"}, lambda run: int("deeper/effective.yaml" in run.files),
                                 more)], ALWAYS),
    # A place for information; the only option that promises to do nothing.
    "run_<entry>": Row([Answer({"run_note": "mine"}, diagonal, same)], ALWAYS),
}


def run_of(changes, option, base=None):
    """RUN with changes, `OPTION` among them named."""
    name = option.replace("<region>", "inclusion")
    return {**RUN, **(base or {}), **{name if key == "OPTION" else key: value for key, value in changes.items()}}


class Run:
    """What a run left behind."""

    def __init__(self, test, out):
        self.effective = test.effective(out)
        self.facts = self.effective["homogenize"]
        self.files = {str(path.relative_to(test.folder / "out")) for path in (test.folder / "out").rglob("*")}

    def phase(self, region):
        return self.facts["phases"][region]


class EveryOption(Homogenising):
    def setUp(self):
        super().setUp()
        self.draw_cell(self.folder / "cell.msh")
        self.draw_cell(self.folder / "fine.msh", size=7e-5)
        (self.folder / "four_times.yaml").write_text(f"stiffness: [{FOUR_TIMES}]\ndensity: {3 * DENSITY}\n")
        self.runs = {}

    def result(self, run, ranks):
        """Of a run, made once."""
        key = (repr(sorted(run.items(), key=str)), ranks)
        if key not in self.runs:
            self.run_cell(run, ranks=ranks)
            self.runs[key] = Run(self, run["output_folder"])
        return self.runs[key]

    def test_the_table_has_every_option(self):
        listed = re.findall(r"^  -(\S+)  ", self.homogenize("-help").out, re.MULTILINE)
        self.assertEqual(sorted(listed), sorted(ROWS))

    def test_answers(self):
        for option, row in ROWS.items():
            for answer in row.answers:
                with self.subTest(option=option, changes=answer.changes):
                    before = answer.number(self.result(run_of({}, option, answer.base), answer.ranks))
                    after = answer.number(self.result(run_of(answer.changes, option, answer.base), answer.ranks))
                    self.assertTrue(answer.expectation(before, after), f"{before} has become {after}")

    def test_refused_where_idle(self):
        with ThreadPoolExecutor(AT_ONCE) as pool:
            refusals = [(option, idle, pool.submit(self.homogenize, *arguments_of(run_of(idle.changes, option)),
                                                   ranks=RANKS))
                        for option, row in ROWS.items() for idle in row.idle]
            for option, idle, refusal in refusals:
                with self.subTest(option=option, words=idle.words):
                    self.assert_refused("homogenize", refusal.result(), [idle.words, "; "], RANKS)
        self.assertFalse((self.folder / "out").exists(), "files were touched")


if __name__ == "__main__":
    unittest.main()
