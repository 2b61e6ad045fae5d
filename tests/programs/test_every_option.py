"""Every option that `slide -help` lists changes the result as expected, or is refused where it has no effect."""

import os
import pty
import re
import shutil
import subprocess
import unittest
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import yaml
from every_option import COULOMB, DENSITY, FOUR_TIMES, FRICTIONLESS, ROWS, SCENE
from running import SLIDE, InScratch, arguments_of, datasets, h5py, yaml_of
from scenes import SIDE, block

RANKS_OF_REFUSALS = 2
AT_ONCE = 2  # starting and ending a parallel job is mostly waiting


def scene_of(changes, option, base=None):
    """SCENE with changes, `OPTION` among them named."""
    name = option.replace("<region>", "block").replace("<boundary>", "top").replace("<parameter>", "v")
    named = {name if key == "OPTION" else key: value for key, value in {**(base or {}), **changes}.items()}
    return {**SCENE, **named}


class Run:
    """What a run left behind."""

    def __init__(self, folder, outcome):
        out = folder / "out"
        self.history, self.contact, self.fields, self.statistics, self.interfaces = (
            datasets(out / file) if (out / file).exists() else {}
            for file in ("history.h5", "contact.h5", "fields.h5", "statistics.h5", "interfaces.h5"))
        if self.statistics:
            with h5py.File(out / "statistics.h5") as file:
                self.samples = file["statistics"].attrs["samples"]
        self.facts = yaml.safe_load((out / "run.yaml").read_text())["run"] if (out / "run.yaml").exists() else {}
        self.summary = yaml.safe_load((out / "summary.yaml").read_text()) if (out / "summary.yaml").exists() else {}
        self.files = {str(path.relative_to(out)) for path in out.rglob("*")}
        cut = re.search(r"edge cut (\d+)", outcome.out)
        self.edge_cut = int(cut[1]) if cut else None


class EveryOption(InScratch):
    def setUp(self):
        super().setUp()
        block(self.folder / "block.msh")
        block(self.folder / "fine.msh", divisions=16)
        block(self.folder / "ring.msh", periodic=True)
        block(self.folder / "two.msh", regions=("block", "fibre"))
        (self.folder / "four_times.yaml").write_text(f"stiffness: [{FOUR_TIMES}]\ndensity: {DENSITY}\n")
        (self.folder / "sheared.csv").write_text("x,y,ux\n" + "".join(f"{x},{y},{1e-7 * y / SIDE}\n" for x in (0, SIDE) for y in (0, SIDE)))
        body = {name: value for name, value in SCENE.items() if name.startswith(("mesh_", "material_"))}
        self.run_scene({**body, "body_acceleration": "0,1e6", "time_end": 1e-7, "fields_every": 1, "output_folder": "rising"})
        self.runs = {}

    def result(self, scene, ranks):
        """Of a scene, run once."""
        key = (repr(sorted(scene.items())), ranks)
        if key not in self.runs:
            shutil.rmtree(self.folder / "out", ignore_errors=True)
            (self.folder / "out").mkdir()
            self.runs[key] = Run(self.folder, self.run_scene(scene, ranks=ranks))
        return self.runs[key]

    def test_the_table_has_every_option(self):
        listed = re.findall(r"^  -(\S+)  ", self.slide("-help").out, re.MULTILINE)
        self.assertEqual(sorted(listed), sorted([*ROWS, "restart"]))  # of a run, not of a scene: test_restart.py

    def test_answers(self):
        for option, row in ROWS.items():
            for answer in row.answers:
                with self.subTest(option=option, changes=answer.changes):
                    before = answer.number(self.result(scene_of({}, option, answer.base), answer.ranks))
                    after = answer.number(self.result(scene_of(answer.changes, option, answer.base), answer.ranks))
                    self.assertTrue(answer.expectation(before, after), f"{before} has become {after}")

    def test_refused_where_idle(self):
        with ThreadPoolExecutor(AT_ONCE) as pool:
            refusals = [(option, idle, pool.submit(self.slide, *arguments_of(scene_of(idle.changes, option)),
                                                   ranks=RANKS_OF_REFUSALS))
                        for option, row in ROWS.items() for idle in row.idle]
            for option, idle, refusal in refusals:
                with self.subTest(option=option, words=idle.words):
                    outcome = refusal.result()
                    self.assertEqual(outcome.codes, [2] * RANKS_OF_REFUSALS, outcome.out)
                    self.assertRegex(outcome.err, r"\Aslide: -[^\n]+; [^\n]+\n\Z")
                    self.assertIn(idle.words, outcome.err)
        self.assertFalse((self.folder / "out").exists(), "files were touched")


class Overruled(InScratch):
    """What the command line makes idle in a file is set aside, and said so: a file serves for sweeps."""

    CHANGES = {  # of the command line; then what is set aside
        "another law": ({"friction_law": "coulomb"}, COULOMB),
        "no friction": ({"friction_law": "none"}, FRICTIONLESS),
        "length for time": ({"friction_length": 2e-6}, {"friction_time": None, "friction_length": 2e-6}),
        "nothing to ramp": ({"boundary_top_y": "fixed"}, {"boundary_top_y": "fixed", "boundary_top_ramp": None}),
    }

    def setUp(self):
        super().setUp()
        block(self.folder / "block.msh")
        (self.folder / "scene.yaml").write_text(yaml_of(SCENE))

    def test_set_aside(self):
        for name, (typed, meant) in self.CHANGES.items():
            with self.subTest(name):
                out = self.run_scene({"options_file_yaml": "scene.yaml", **typed, "output_folder": "read"}, ranks=2).out
                self.run_scene({**SCENE, **meant, "output_folder": "typed"}, ranks=2)
                read, plain = (yaml.safe_load((self.folder / folder / "run.yaml").read_text())
                               for folder in ("read", "typed"))
                self.assertEqual({**read, "output_folder": "typed"}, plain)
                aside = [option for option in SCENE if option in meant and meant[option] is None]
                notes = re.findall(r"^note: -(\S+) of scene.yaml .*\(the command line\); it is set aside$", out,
                                   re.MULTILINE)
                self.assertEqual(notes, aside)
                left, right = (datasets(self.folder / folder / "history.h5") for folder in ("read", "typed"))
                for dataset in left:
                    np.testing.assert_array_equal(left[dataset], right[dataset], dataset)

    def test_a_later_file_overrules_an_earlier_one(self):
        (self.folder / "coulomb.yaml").write_text("friction: {law: coulomb}\n")
        files = ["-options_file_yaml", "scene.yaml", "-options_file_yaml", "coulomb.yaml"]
        outcome = self.slide(*files)
        self.assertEqual(outcome.codes, [0], outcome.err)
        self.assertIn("note: -friction_time of scene.yaml has no effect with -friction_law coulomb (coulomb.yaml)",
                      outcome.out)
        outcome = self.slide(*files[2:], *files[:2])  # scene.yaml names the law last
        self.assertEqual(outcome.codes, [0], outcome.err)
        self.assertIn("friction: regularized", outcome.out)

    def test_the_command_line_is_not_overruled(self):
        (self.folder / "coulomb.yaml").write_text(yaml_of({**SCENE, **COULOMB}))
        outcome = self.slide("-options_file_yaml", "coulomb.yaml", "-friction_time", 1e-6, ranks=2)
        self.assertEqual(outcome.codes, [2, 2])
        self.assertIn("-friction_time has no effect with -friction_law coulomb", outcome.err)

    def test_capitals(self):
        """PETSc folds case: the second spelling must not win in silence, wherever either of them stands."""
        (self.folder / "capitals.yaml").write_text("Friction: {Coefficient: 0.1}\n")
        scene = ["-options_file_yaml", "scene.yaml"]
        for arguments in ([*scene, "-Friction_Coefficient", 0.1],
                          [*arguments_of(SCENE), "-Friction_Coefficient", 0.1],
                          ["-Friction_Coefficient", 0.1, *arguments_of(SCENE)],
                          [*scene, "-options_file_yaml", "capitals.yaml"],
                          ["-options_file_yaml", "capitals.yaml", *scene],
                          ["-options_file_yaml", "capitals.yaml", *arguments_of(SCENE)]):
            with self.subTest(arguments=arguments):
                outcome = self.slide(*arguments, ranks=2)
                self.assertEqual(outcome.codes, [2, 2], outcome.out)
                self.assertIn("-Friction_Coefficient differs in capitals", outcome.err)
        outcome = self.slide(*scene, "-material_Block_young", 1e9, ranks=2)
        self.assertEqual(outcome.codes, [2, 2], outcome.out)
        self.assertIn("write -material_block_young", outcome.err)


class Terminal(InScratch):
    def test_progress_is_for_terminals(self):
        block(self.folder / "block.msh")
        for progress, expected in (("auto", True), ("none", False)):
            # A few seconds: the line comes every half a second.
            scene = {**SCENE, "mesh_refine": 1, "time_step": 1e-9, "time_end": 1e-3,
                     "contact_every": 10**5, "history_every": 10**5, "progress": progress}
            with self.subTest(progress):
                self.assertEqual(" %  step " in self.seen_on_terminal(arguments_of(scene)), expected)

    def seen_on_terminal(self, arguments):
        ours, its = pty.openpty()
        with subprocess.Popen([SLIDE, *arguments], cwd=self.folder, env=self.environment(), stdin=subprocess.DEVNULL,
                              stdout=its) as job:
            os.close(its)
            seen = b""
            try:
                while part := os.read(ours, 4096):
                    seen += part
            except OSError:  # how a pseudo terminal says that nobody is left at its other end
                pass
        os.close(ours)
        self.assertEqual(job.returncode, 0)
        return seen.decode()


if __name__ == "__main__":
    unittest.main()
