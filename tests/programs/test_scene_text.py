"""Scenes as text and the process around a run: what YAML means, where options come from, signals, pipes, versions."""

import os
import re
import resource
import signal
import subprocess
import time
import unittest
from pathlib import Path

import yaml

from running import SLIDE, InScratch, arguments_of, datasets, yaml_of
from scenes import block

MATERIAL = {"material_block_young": 30e9, "material_block_poisson": 0.25, "material_block_density": 1800}
SCENE = {"mesh_file": "block.msh", **MATERIAL, "boundary_top_pressure": 1e6, "time_end": 1e-6}
PROGRAMS = {name: os.environ["SLIPSCALE_" + name.upper()]
            for name in ("slide", "homogenize", "relocalize", "morphology")}
NOISE = ("PETSC ERROR", "Caught signal", "MPI_ABORT", "WARNING!", "what():")


def grains(path, count):
    """A row of squares, each a region of its own, as MSH 4.1."""
    side, nodes = 1e-3, 2 * (count + 1)
    names = ['1 1 "bottom"', '1 2 "top"'] + [f'2 {10 + k} "grain{k}"' for k in range(count)]
    entities = ["1 0 0 0 0 0 0 1 1 0", "2 0 0 0 0 0 0 1 2 0"]
    entities += [f"{k + 1} 0 0 0 0 0 0 1 {10 + k} 0" for k in range(count)]
    points = [f"{k * side} {y} 0" for y in (0, side) for k in range(count + 1)]
    elements = []
    for curve, first in ((1, 1), (2, count + 2)):
        elements.append(f"1 {curve} 1 {count}")
        elements += [f"{(curve - 1) * count + k + 1} {first + k} {first + k + 1}" for k in range(count)]
    for k in range(count):
        elements += [f"2 {k + 1} 3 1", f"{2 * count + k + 1} {k + 1} {k + 2} {count + k + 3} {count + k + 2}"]
    path.write_text("\n".join(
        ["$MeshFormat", "4.1 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names)), *names, "$EndPhysicalNames",
         "$Entities", f"0 2 {count} 0", *entities, "$EndEntities",
         "$Nodes", f"1 {nodes} 1 {nodes}", f"2 1 0 {nodes}", *map(str, range(1, nodes + 1)), *points, "$EndNodes",
         "$Elements", f"{count + 2} {3 * count} 1 {3 * count}", *elements, "$EndElements", ""]))


class SceneText(InScratch):
    def setUp(self):
        super().setUp()
        block(self.folder / "block.msh", regions=("block",))

    def refused(self, words, *arguments, ranks=1, seconds=20):
        start = time.monotonic()
        outcome = self.launch(SLIDE, *arguments, ranks=ranks)
        self.assertLess(time.monotonic() - start, seconds)
        self.assert_refused("slide", outcome, words, ranks)
        return outcome

    def refused_text(self, text, *words, **more):
        (self.folder / "scene.yaml").write_bytes(text if isinstance(text, bytes) else text.encode())
        return self.refused(words, "-options_file_yaml", "scene.yaml", **more)

    def test_one_scene_has_one_meaning(self):
        good = yaml_of(SCENE)
        self.refused_text(good + "boundary: {top: {x: fixed}}\nboundary: {bottom: {y: fixed}}\n",
                          "gives 'boundary' twice")
        self.refused_text(good.encode() + b"\0damping_mass: 1e5\n", "has a NUL byte near line 7",
                          "(?damping_mass: 1e5), so it is no text; remove it")
        self.refused_text(good.replace("1800", "01700"), "-material_block_density is 01700", "base 8")
        self.refused_text(good.replace("1800", "30:00"), "base 60")
        self.refused_text(good + "output_folder: 2026-01-31\n", "-output_folder is 2026-01-31", "a date", "in quotes")
        self.refused_text(good + "output_folder: no\n", "true or false", "in quotes")
        self.refused_text(good + '"mesh_a\\Lb": 3\n', "-mesh_a b is not an option")

    def test_python_reads_the_same(self):
        text = yaml_of({**SCENE, "mesh_file": "'block.msh'", "time_end": "1e-6"}) + \
            "output: {folder: 'on'}\nfields: {times: [0, 5.0e-7]}\n"
        (self.folder / "scene.yaml").write_text(text)
        outcome = self.slide("-options_file_yaml", "scene.yaml")
        self.assertEqual((outcome.codes, outcome.err), ([0], ""), outcome.out)
        run = yaml.safe_load((self.folder / "on" / "run.yaml").read_text())
        self.assertEqual(run["output_folder"], "on")
        for name, value in MATERIAL.items():
            self.assertEqual(float(run[name]), value)
        again = self.slide("-options_file_yaml", "on/run.yaml", "-output_folder", "2026-01-31")
        self.assertEqual((again.codes, again.err), ([0], ""), again.out)
        again = self.slide("-options_file_yaml", "2026-01-31/run.yaml")
        self.assertEqual((again.codes, again.err), ([0], ""), again.out)
        one, other = (datasets(self.folder / name / "history.h5") for name in ("on", "2026-01-31"))
        for name in one:
            self.assertEqual(one[name].tobytes(), other[name].tobytes(), name)

    def test_piles_do_not_hang(self):
        self.refused_text("a: " + "[" * 20000 + "]" * 20000 + "\n", "nested more than 50 levels deep")
        self.refused_text("{" * 20000 + "\n", "nested more than 50 levels deep")
        many = "".join(f"material_grain{k}_young: 1.0e+9\n" for k in range(250000))  # 8 MB
        self.refused_text(many + "a b\n", "is not valid YAML near line 250001")
        self.refused_text("a: {b: 1\n" + many, "is not valid YAML near line 1")
        self.refused_text("a:\n" + "- b\n" * 1000000, "-a is not an option of slide")

    def test_hundreds_of_materials(self):
        count = 300
        grains(self.folder / "many.msh", count)
        (self.folder / "many.yaml").write_text("mesh: {file: many.msh}\nmaterial:\n" + "".join(
            f"  grain{k}: {{young: {(30 + k) * 1e9:.6g}, poisson: 0.3, density: 1800}}\n" for k in range(count)) +
            "boundary: {top: {pressure: 1.0e+6}}\ntime: {end: 1.0e-7}\noutput: {folder: many}\n")
        for ranks, arguments in ((1, ["-options_file_yaml", "many.yaml"]),
                                 (1, ["-options_file_yaml", "many/run.yaml", "-output_folder", "again"]),
                                 (2, ["-options_file_yaml", "many/run.yaml", "-output_folder", "on_two"])):
            outcome = self.slide(*arguments, ranks=ranks)
            self.assertEqual((outcome.codes, outcome.err), ([0] * ranks, ""), outcome.out)
        one, other = (datasets(self.folder / name / "history.h5") for name in ("many", "again"))
        for name in one:
            self.assertEqual(one[name].tobytes(), other[name].tobytes(), name)
        options = yaml.safe_load((self.folder / "again" / "run.yaml").read_text())
        self.assertEqual(float(options["material_grain299_young"]), 329e9)
        many = ("-options_file_yaml", "many.yaml")
        self.refused(["-material_grain7_young is -1"], *many, "-material_grain7_young", "-1")
        self.refused(["did you mean -material_grain7_young?"], *many, "-material_grain7_yuong", "1")

    def test_petscs_own_files_are_named(self):
        good = arguments_of(SCENE)
        (self.folder / ".petscrc").write_text("-wind_speed 3\n")
        self.refused(["-wind_speed is not an option of slide", "(it stands in '.petscrc')"], *good)
        (self.folder / ".petscrc").write_text("-time_beta2 3\n")
        self.refused(["-time_beta2 is 3", "(it stands in '.petscrc')"], *good)
        (self.folder / ".petscrc").unlink()
        self.environment = lambda **more: {**InScratch.environment(self, **more), "PETSC_OPTIONS": "-wind_speed 3"}
        for ranks in (1, 2):
            self.refused(["(it stands in the variable PETSC_OPTIONS)"], *good, ranks=ranks)
        self.environment = lambda **more: {**InScratch.environment(self, **more), "PETSC_OPTIONS": "-ksp_type cg"}
        self.refused(["-ksp_type was given in the variable PETSC_OPTIONS", "has read it"], *good)
        self.environment = lambda **more: {**InScratch.environment(self, **more), "PETSC_OPTIONS": "-fp_trap cg"}
        self.refused(["PETSC_OPTIONS", "cg"], *good)

    def with_variable(self, text):
        self.environment = lambda **more: {**InScratch.environment(self, **more), "PETSC_OPTIONS": text}

    def test_what_petsc_collects_by_itself_is_told(self):
        (self.folder / "scene.yaml").write_text(yaml_of({**SCENE, "damping_mass": 100}))
        (self.folder / ".petscrc").write_text("-damping_mass 5e5\n-damping_stiffness 1e-9\n-log_view :profile.txt\n")
        self.with_variable("-time_beta2 0.6")
        for ranks in (1, 2):
            outcome = self.slide("-options_file_yaml", "scene.yaml", "-time_beta2", "0.7", ranks=ranks)
            self.assertEqual((outcome.codes, outcome.err), ([0] * ranks, ""), outcome.out)
            for note in ("-damping_mass 5e5 stands in '.petscrc' and gives way to that of scene.yaml",
                         "-damping_stiffness 1e-9 stands in '.petscrc'", "-log_view :profile.txt stands in '.petscrc'",
                         "-time_beta2 0.6 stands in the variable PETSC_OPTIONS and gives way to that of the command line"):
                self.assertEqual(outcome.out.split("\n").count("note: " + note), 1, outcome.out)
            options = yaml.safe_load((self.folder / "out" / "run.yaml").read_text())
            self.assertEqual([float(options[name]) for name in ("damping_mass", "damping_stiffness", "time_beta2")],
                             [100, 1e-9, 0.7])
        outcome = self.slide("-options_file_yaml", "scene.yaml", "-skip_petscrc")
        self.assertEqual((outcome.codes, outcome.err), ([0], ""), outcome.out)
        self.assertNotIn("petscrc'", outcome.out)

    def test_stray_words_and_bad_values_of_petscs_own_places(self):
        good = arguments_of(SCENE)
        for text in ("damping_mass 5e5", "-damping_mass 5e5 6e5", "-log_view :a :b"):
            self.with_variable(text)
            word = text.split()[0 if text[0] != "-" else 2]
            for ranks in (1, 2):
                self.refused([f"'{word}' in the variable PETSC_OPTIONS belongs to no option"], *good, ranks=ranks)
        self.with_variable("-options_view mumps")
        self.refused(["-options_view is 'mumps'", "in the variable PETSC_OPTIONS"], *good)
        self.with_variable("")
        (self.folder / "solver.txt").write_text("-log_view mumps\n")
        self.refused(["-log_view is 'mumps'", "in 'solver.txt'"], *good, "-options_file", "solver.txt")
        for option, value in (("log_view", ":none/such"), ("citations", "none/such"), ("options_view", "ascii:none/such")):
            for ranks in (1, 2):
                self.refused([f"-{option} is '{value}'", "a folder that can be written to"], *good, "-" + option, value,
                             ranks=ranks)

    def test_a_name_is_looked_at_before_its_value(self):
        self.refused(["-boundary_top_pressure_fi_x names the boundary 'top_pressure_fi', which the mesh does not have",
                      "did you mean"], *arguments_of(SCENE), "-boundary_top_pressure_fi_x", "load.txt", ranks=2)
        self.refused(["-boundary_top_x is 'load.txt'"], *arguments_of(SCENE), "-boundary_top_x", "load.txt")

    def test_a_limit_is_told_from_what_stands_next_to_it(self):
        near = {**SCENE, "material_block_poisson": 0.4999999}
        outcome = self.run_scene(near)
        self.assertIn("nu 0.4999999,", outcome.out)
        step = yaml.safe_load((self.folder / "out" / "run.yaml").read_text())["run"]["stable_step"]
        above = float(step) * (1 + 1e-9)
        outcome = self.refused(["-time_step is", "above the stable step of"],
                               *arguments_of({**near, "time_step": repr(above)}))
        given, limit = (float(word) for word in re.findall(r"(\S+) s(?=,| for)", outcome.err))
        self.assertGreater(given, limit)

    def test_values_that_petsc_cannot_read(self):
        good = arguments_of(SCENE)
        for option, value in {"log_view": "mumps", "options_left": "-1", "fp_trap": "cg", "malloc_debug": "aij",
                              "log_sync": "x", "checkstack": "maybe", "check_pointer_intensity": "aij",
                              "malloc_view_threshold": "big", "options_view": "mumps", "on_error_abort": "cg",
                              "no_signal_handler": "7", "log_view_memory": "7", "malloc_dump": "x"}.items():
            for ranks in (1, 2) if option == "log_view" else (1,):
                with self.subTest(option, ranks=ranks):
                    self.refused([f"-{option} is '{value}'"], *good, "-" + option, value, ranks=ranks)
        outcome = self.slide(*good, "-log_view", ":profile.txt", "-options_left", "no")
        self.assertEqual((outcome.codes, outcome.err), ([0], ""), outcome.out)
        self.assertIn("Summary of Stages", (self.folder / "profile.txt").read_text())

    def start(self, *arguments, **more):
        """A run that takes a minute, once it steps."""
        long = {**SCENE, "time_end": 1, "time_step": 1e-9, "history_every": 1000000}
        process = subprocess.Popen([SLIDE, *arguments_of(long), *arguments], cwd=self.folder, env=self.environment(),
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **more)
        self.addCleanup(lambda: (process.kill(), process.communicate()))
        said = ""
        while " steps to " not in said:
            line = process.stdout.readline()
            self.assertTrue(line, said + process.stderr.read() if process.poll() is not None else said)
            said += line
        return process

    def test_signals_end_without_a_dump(self):
        ending = (signal.SIGHUP, signal.SIGQUIT, signal.SIGTERM, signal.SIGINT)

        def as_in_a_terminal():
            """Whatever this test inherits from nohup or a shell's background; and no core."""
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            for number in ending:
                signal.signal(number, signal.SIG_DFL)

        for number in ending:
            with self.subTest(number):
                process = self.start("-output_folder", f"signal_{int(number)}", preexec_fn=as_in_a_terminal)
                process.send_signal(number)
                out, err = process.communicate(timeout=20)
                if number in (signal.SIGTERM, signal.SIGINT):  # noted, for the run to end in good order
                    self.assertEqual(process.returncode, 3)
                    self.assertRegex(err, r"\Aslide: interrupted by [^\n]+ go on with: [^\n]+\n\Z")
                else:
                    self.assertEqual((process.returncode, err), (-number, ""))
                for noise in NOISE:
                    self.assertNotIn(noise, out)

    def test_nohup_is_kept(self):
        process = self.start(preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        process.send_signal(signal.SIGHUP)
        time.sleep(0.5)
        self.assertIsNone(process.poll())

    def test_a_closed_pipe_ends_the_printing_not_the_run(self):
        command = " ".join([f"'{SLIDE}'", *map(str, arguments_of(SCENE)), "| head -1; echo ${PIPESTATUS[0]}"])
        done = subprocess.run(["bash", "-c", command], cwd=self.folder, env=self.environment(), capture_output=True,
                              text=True, timeout=60)
        self.assertEqual((done.stdout.splitlines()[-1], done.stderr), ("0", ""), done.stdout)
        self.assertTrue((self.folder / "out" / "summary.yaml").exists())

    def test_one_process_starts_no_other(self):
        process = self.start()
        children = Path(f"/proc/{process.pid}/task/{process.pid}/children")
        if not children.exists():
            self.skipTest("this kernel does not list children")
        self.assertEqual(children.read_text().split(), [])

    def test_versions(self):
        for name, program in PROGRAMS.items():
            for ranks in (1, 2):
                outcome = self.launch(program, "-version", ranks=ranks)
                libraries = r"PETSc \d+\.\d+\.\d+, Open MPI v[\d.]+, HDF5 \d+\.\d+\.\d+" + \
                    (r", gmsh \d+\.\d+\.\d+" if name == "morphology" else "")
                commit = r"( \(commit [0-9a-f]+(-dirty)?\))?"
                self.assertRegex(outcome.out, rf"\A{name} \d+\.\d+\.\d+{commit}, {libraries}\n\Z")


if __name__ == "__main__":
    unittest.main()
