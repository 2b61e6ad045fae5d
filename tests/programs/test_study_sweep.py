"""The sweep in small: what its table holds, options of every program, failures, what is run again, the command line."""

import subprocess

import studies

NOT_MEASURED = ("wall_seconds", "energy_residual")  # rounding of sums over the body
TINY = {"scene": {"time": {"end": 40e-6}, "history": {"every": 2}}, "compare": None}


class Sweep(studies.StudyCase):
    study = "sweep"

    def measured(self):
        return [{name: value for name, value in row.items() if name not in NOT_MEASURED} for row in self.table()]

    def fails(self, **changes):
        """What it said; it must fail with exit code 1."""
        done = subprocess.run(self.command(**changes), capture_output=True, text=True, env=self.environment(),
                              timeout=studies.SECONDS)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def test_a_map_on_any_number_of_ranks(self):
        self.run_study()
        rows = self.table()
        self.assertEqual([(row["friction_coefficient"], row["surface_speed"]) for row in rows],
                         [(mu, speed) for mu in ("0", "0.1", "0.5") for speed in ("2", "4")])
        self.assertEqual({row["status"] for row in rows}, {"ok"})
        for row in rows:
            # What the surface drags cannot exceed Coulomb's limit on average, and reaches it where all nodes slip.
            friction, mu = float(row["friction"]), float(row["friction_coefficient"])
            self.assertLess(friction, 1.02 * mu + 1e-9)
            if row["regime"] == "slip":
                self.assertAlmostEqual(friction, mu, delta=2e-3 * mu + 1e-9)
            self.assertAlmostEqual(sum(float(row[state]) for state in ("stick", "slip", "open")), 1, delta=1e-9)
            self.assertLess(float(row["energy_residual"]), 1e-9)
            # A window that study.yaml leaves open is the second half.
            self.assertAlmostEqual(float(row["window_begin"]) / 120e-6, 0.5, delta=0.01)
        self.assertGreater(float(rows[-1]["amplitude"]), 100 * float(rows[2]["amplitude"]))  # it squeals at 0.5 only
        self.assertGreater((self.out / "picture" / "picture.png").stat().st_size, 20000)
        self.assertIn("6 runs, 0 failed", (self.out / "report.md").read_text())
        self.assertIn("Nothing to be done", self.run_study())

        one_rank = self.measured()
        self.run_study(ranks=2)
        self.assertEqual(self.measured(), one_rank)  # same bits
        outcome = next((self.out / "run").glob("*/outcome.yaml")).read_text()
        self.assertIn("command: mpirun -n 2 ", outcome)

    def test_options_of_every_program_and_rows(self):
        mesh = {"size": 1e-3, "block_height": 2e-3}
        composite = {"mesh": {"shape": "disc", "fraction": 0.2, "diameter": 1e-3, "size": 0.5e-3, "block_width": 5e-3,
                              "block_height": 2e-3, "gap": 0.1e-3, "clearance": 0.1e-3},
                     "options": {"cell_boundary": "kubc", "material": {
                         "matrix": {"young": 30e9, "poisson": 0.25, "density": 1800},
                         "inclusion": {"young": 80e9, "poisson": 0.25, "density": 1800}}}}
        scene = {**TINY["scene"], "material": None, "boundary": {"top": {"x": "fixed", "y": -0.5e-6, "ramp": 10e-6}}}
        none = {"friction_coefficient": None, "surface_speed": None, "size": None}
        words = {**TINY, "scene": scene, "mesh": mesh, "homogenize": composite,
                 "sweep": {**none, "fraction": [0.1, 0.3], "material_inclusion_young": [80e9]},
                 "list": [{"surface_speed": 1, "initial_velocity": [0, -0.5]}]}
        self.run_study(**words)
        rows = self.table()
        self.assertEqual([row["status"] for row in rows], ["ok"] * 3, rows)
        self.assertEqual([(row["fraction"], row["material_inclusion_young"], row["surface_speed"]) for row in rows],
                         [("0.1", "80000000000.0", "2"), ("0.3", "80000000000.0", "2"), ("0.2", "80000000000.0", "1")])
        self.assertEqual([row["initial_velocity"] for row in rows], ["", "", "0,-0.5"])
        # More of the stiffer phase carries more at the same displacement.
        self.assertGreater(float(rows[1]["normal_force"]), 1.05 * float(rows[0]["normal_force"]))

        before = self.written()
        words["sweep"]["fraction"] = [0.1, 0.3, 0.2]
        self.run_study(**words)
        again = {name.split("/")[0] for name in self.run_again(before)}
        self.assertEqual(again, {"run"})  # the mesh and the effective material of fraction 0.2 are there
        self.assertEqual(len(self.table()), 4)

    def test_failures_are_rows(self):
        sweep = {"friction_coefficient": [0.3, -0.5], "surface_speed": 2, "time_step": ["auto", 1e-5]}
        self.run_study(**{**TINY, "sweep": {**sweep, "size": 1e-3}})
        rows = self.table()
        self.assertEqual([row["status"] for row in rows], ["ok", "failed", "failed", "failed"])
        self.assertIn("-time_step", rows[1]["reason"])
        self.assertIn("-friction_coefficient", rows[2]["reason"])
        self.assertEqual(rows[1]["friction"], "")
        self.assertIn("4 runs, 3 failed", (self.out / "report.md").read_text())
        self.assertGreater((self.out / "picture" / "picture.png").stat().st_size, 10000)

        # A window without rows is a failure of its run as well, and one more value adds its runs only. Failures alone
        # are no result, today and tomorrow: table and report are there, and the study fails with a sentence.
        before = self.written()
        sweep["friction_coefficient"] = [0.3, -0.5, 0.4]
        changes = {**TINY, "sweep": {**sweep, "size": 1e-3}, "window": [1.0, 2.0]}
        for _ in range(2):
            self.assertIn("None of the 6 rows of out/sweep-reduced/table.csv is of a run that came to its end; the "
                          "first: Only 0 rows", self.fails(**changes))
        self.assertEqual(len([name for name in self.run_again(before) if name.startswith("run/")]), 2)
        self.assertEqual([row["status"] for row in self.table()], ["failed"] * 6)
        self.assertIn("choose another window", self.table()[0]["reason"])
        self.assertIn("6 runs, 6 failed", (self.out / "report.md").read_text())

    def test_few_rows_give_what_they_know(self):
        """Of 16 rows of history friction is known, a frequency is not."""
        self.run_study(**{**TINY, "scene": {"time": {"end": 40e-6, "step": 20e-9}, "history": {"every": 62}},
                          "sweep": {"friction_coefficient": [0.3], "surface_speed": 2, "size": 1e-3}})
        row = self.table()[0]
        self.assertEqual((row["status"], row["frequency"]), ("ok", ""))
        self.assertRegex(row["reason"], "^Only 1[67] rows are recorded")
        self.assertLess(float(row["friction"]), 0.3)
        for name in ("friction_error", "amplitude", "stick", "slip", "open", "regime", "settled"):
            self.assertNotEqual(row[name], "", name)
        self.assertIn("In part: ", (self.out / "report.md").read_text())

    def test_a_mistake_is_one_sentence_before_anything_runs(self):
        for sweep, sentence in (({"friction_coeficient": [0.1]}, "is -friction_coefficient meant?"),
                                ({"surface_speed": "1:0:2"}, "1:0:2 never ends: its step is 0."),
                                ({"surface_speed": "fast"}, "-surface_speed fast is not a number")):
            done = subprocess.run(self.command(sweep=sweep), capture_output=True, text=True, env=self.environment(),
                                  timeout=studies.SECONDS)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(sentence, done.stdout + done.stderr)
            self.assertNotIn("Traceback", done.stdout + done.stderr)
            self.assertFalse(self.out.exists())

    def test_goes_on_after_it_was_killed(self):
        self.check_going_on_after_a_kill(runs=8, at_work=2, sweep={
            "friction_coefficient": "0.1:0.1:0.8", "surface_speed": 2, "size": 1e-3})


class CommandLine(studies.StudyCase):
    study = "sweep"

    def sweep(self, *words):
        return subprocess.run([studies.RUNS / "sweep" / "run.sh", "--programs", self.folder / "programs", *words],
                              cwd=self.folder, capture_output=True, text=True, timeout=studies.SECONDS,
                              env=self.environment())

    def test_from_a_scene_and_a_recipe(self):
        """In any directory; the files are found from there, the table where it is said to be."""
        (self.folder / "scene.yaml").write_text("""
mesh: {file: nowhere.msh}
material: {all: {young: 45e9, poisson: 0.25, density: 1800}}
surface: {boundary: bottom, speed: 2}
friction: {law: regularized, coefficient: 0.5, length: 1.2e-6}
boundary: {top: {x: fixed, y: -1e-6, ramp: 10e-6}}
time: {end: 40e-6}
history: {every: 2}
output: {folder: nowhere}
""")
        (self.folder / "block.yaml").write_text("block: {width: 5e-3, height: 5e-3}\nshape: none\nsize: 1e-3\n")
        out = self.folder / "my own" / "sweep"
        words = ("-options_file_yaml", "scene.yaml", "--recipe", "block.yaml", "-friction_coefficient", "0.1:0.1:0.3",
                 "-time_beta2", "0.6", "--output", "my own/sweep", "--", "-c2")
        before = {path.name for path in self.folder.iterdir()}
        done = self.sweep(*words)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("3 runs", done.stdout)
        self.assertIn(str(out / "table.csv"), done.stdout)
        self.out = out
        self.assertEqual([(row["friction_coefficient"], row["status"]) for row in self.table()],
                         [("0.1", "ok"), ("0.2", "ok"), ("0.3", "ok")])
        run = next((out / "run").glob("*/run.yaml")).read_text()
        self.assertIn("beta2: 0.6", run)

        # Nothing beside it, neither here nor in the folder of the study.
        home = {".cache", ".config", ".fltk"}  # of the programs that snakemake and morphology are made of
        self.assertEqual({path.name for path in self.folder.iterdir()} - before - home, {"my own"})
        self.assertEqual([path.name for path in (self.folder / "my own").iterdir()], ["sweep"])
        self.assertFalse((studies.RUNS / "sweep" / ".snakemake").exists() or (studies.RUNS / "sweep" / "out").exists())
        again = self.sweep(*words)
        self.assertIn("Nothing to be done", again.stdout + again.stderr)

    def test_mistakes(self):
        (self.folder / "twice.yaml").write_text("boundary: {top: {y: -1e-6}}\nboundary: {right: {x: fixed}}\n")
        (self.folder / "joined.yaml").write_text("boundary: {top: {x: fixed}}\nboundary_top_x: free\n")
        (self.folder / "octal.yaml").write_text("surface: {speed: 010}\n")
        for words, sentence in ((("-friction_coeficient", "0.1:0.1:0.3"), "is -friction_coefficient meant?"),
                                (("-friction_coefficient",), "-friction_coefficient needs a value."),
                                (("-options_file_yaml", "no.yaml"), "no.yaml cannot be read"),
                                (("-surface_speed", "1:1"), "1:1 is no range"),
                                (("-options_file_yaml", "twice.yaml"), "twice.yaml gives 'boundary' twice"),
                                (("joined.yaml",), "boundary_top_x is given twice"),
                                (("octal.yaml",), "octal.yaml has '010' near line 1"),
                                (("-mesh_file", "no.msh", "-surface_speed", "1,2"), "There is no no.msh")):
            done = self.sweep(*words)
            self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
            self.assertIn(sentence, done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)


if __name__ == "__main__":
    studies.main()
