"""The commands that READMEs show, and how each is tried: as it stands where that is cheap, as a plan where the program
has one (snakemake -n, sweep --dry-run), else word by word: the program, its options and the files exist.

    Place(folder).attempt(line)    raises Fault, a sentence, for a command that would not run
"""

import csv
import json
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ["SLIPSCALE_SLIDE"]).parent
PROGRAMS = ("morphology", "slide", "homogenize", "relocalize")
BUILDS = ("runs/first/run.sh", "tests/run.sh", "cmake/install-dependencies.sh")  # install, build and take minutes
NO_COMMANDS = ("find_package(", "[a-z_]+: ")  # of CMake, of YAML
ALONE = ("slipscale", "snakemake", "cmake", "ctest", "cp", "gmsh", "mpirun", "python3", *PROGRAMS)  # found in the path
FOLDERS = ("runs/", "tests/", "cmake/", "build/release/", "src/", "meshes/", "include/")

sys.path.insert(0, str(TOP / "runs"))


class Fault(Exception):
    """What is wrong with a command of a README."""


def without_report(text):
    """A page without what a study wrote."""
    return re.sub(r"<!-- report: begin.*?<!-- report: end -->", "", text, flags=re.DOTALL)


def indented(text):
    """The indented lines outside of lists, those that end with a backslash joined, without comments and what is YAML or
    CMake: a YAML block may nest."""
    found, yaml = [], False
    for line in without_report(text).replace("\\\n", " ").splitlines():
        if not line.startswith("    "):
            yaml = False
            continue
        line = re.sub(r"\s+# .*", "", line[4:]).rstrip()
        yaml = yaml or re.match("|".join(map(re.escape, NO_COMMANDS[:1])) + f"|{NO_COMMANDS[1]}", line)
        if line and not yaml:
            found.append(line)
    return found


def inline(text):
    """What stands in the running text between backticks and begins with a program or with a path of the repository."""
    pieces = re.findall(r"(?<!`)`([^`\n]+)`", re.sub(r"```.*?```", "", without_report(text), flags=re.DOTALL))
    return [piece for piece in pieces if piece.split()[0] in ALONE and len(piece.split()) > 1
            or piece.startswith(FOLDERS) and not re.search("[<…]", piece.split()[0])]


def links_of(folder, *names):
    for name in names:
        (folder / name).symlink_to(TOP / name)


class Place:
    """A folder that looks like the top of a clone that was built, with what a reader has after the first study."""

    def __init__(self, folder):
        self.folder = Path(folder)
        (self.folder / "build").mkdir()
        (self.folder / "build" / "release").symlink_to(BUILD)
        links_of(self.folder, "runs", "tests", "cmake", "src", "meshes", "include", "CMakeLists.txt",
                 "CMakePresets.json")
        self.manuals = {}

    def fill(self):
        """A mesh, some runs and the table of the sweep: made up, but for the mesh, and with every column."""
        from slipscale.measuring.regime import MEASURES
        from slipscale.reading import yaml_file
        from slipscale.running.sweep import products, values_of
        from tests import fake_run
        for name in ("first", "second", "profile", "phases", "halfspace"):
            fake_run.write_run(self.folder / "out" / name)
        self.run(["build/release/morphology", "-options_file_yaml", "runs/first/block.yaml", "-size", "2e-4",
                  "-output_folder", "out/first/mesh"])
        for name in ("scene", "block"):
            (self.folder / f"{name}.yaml").write_text((TOP / "runs" / "first" / f"{name}.yaml").read_text())
        lines = (TOP / "runs" / "equivalence" / "README.md").read_text().split("## Your own composite")[1].splitlines()
        (self.folder / "mine.yaml").write_text("\n".join(
            line[4:] for line in lines if line.startswith("    ") and "snakemake" not in line))
        varied = yaml_file.options(TOP / "runs" / "sweep" / "study.yaml")["sweep"]
        varied = {name: values_of(values) for name, values in varied.items()}
        (self.folder / "out" / "sweep").mkdir()
        with (self.folder / "out" / "sweep" / "table.csv").open("w", newline="") as file:
            table = csv.writer(file)
            table.writerow([*varied, "status", "reason", "wall_seconds", *MEASURES])
            table.writerows([*run, "ok", "", 1.0, *[0.1] * len(MEASURES)] for run in products(varied))
        (self.folder / "bin").mkdir()
        sbatch = self.folder / "bin" / "sbatch"
        sbatch.write_text("#!/bin/sh\necho 7\n")
        sbatch.chmod(0o755)
        (self.folder / "bin" / "slipscale").symlink_to(BUILD / "slipscale")

    def run(self, words):
        environment = {**os.environ, "PATH": f"{self.folder / 'bin'}:{os.environ['PATH']}", "MPLBACKEND": "Agg",
                       "SLIPSCALE_PROGRAMS": str(BUILD), "HOME": str(self.folder)}
        try:
            done = subprocess.run(words, cwd=self.folder, capture_output=True, text=True, env=environment,
                                  stdin=subprocess.DEVNULL, timeout=300)
        except OSError as error:
            raise Fault(f"{words[0]}: {error.strerror}") from error
        if done.returncode != 0:
            raise Fault(f"{shlex.join(words)} ends with {done.returncode}: {(done.stdout + done.stderr)[-1500:]}")
        return done.stdout + done.stderr

    def attempt(self, line):
        """Tries the commands of a line. Raises Fault."""
        for part in line.split(" && "):
            words = shlex.split(part)
            name = Path(words[0]).name
            if words[0] == "grep":
                continue
            if name not in ALONE and not self.exists(words[0]):
                raise Fault(f"{part}: there is no {words[0]}")
            if "/" in words[0] and name in ALONE and not self.exists(words[0]):
                raise Fault(f"{part}: {words[0]} is not there")
            getattr(self, f"try_{name}", self.try_file)(words)

    def exists(self, path):
        return any(self.folder.glob(path)) if "*" in path else (self.folder / path).exists()

    def said_by(self, *words):
        """What a program says of itself, whatever its exit code."""
        if words not in self.manuals:
            done = subprocess.run(words, cwd=self.folder, capture_output=True, text=True, stdin=subprocess.DEVNULL)
            self.manuals[words] = done.stdout + done.stderr
        return self.manuals[words]

    @staticmethod
    def check_options(words, manual, what):
        """Every option is a whole word of a text."""
        for word in words:
            known = rf"(?<![\w-]){re.escape(word.split('=')[0])}(?![\w-])"
            if re.match(r"--?[A-Za-z]", word) and not re.search(known, manual):
                raise Fault(f"{what} has no option {word}")

    # --- by program

    def try_snakemake(self, words):
        self.run([*words, "--dry-run", "--quiet", "all"])

    def try_slipscale(self, words):
        command = [str(BUILD / "slipscale"), *words[1:]]
        mentioned = len(words) < 3 or any(word == "…" or re.fullmatch("[A-Z]{3,}", word) for word in words)
        if mentioned:
            self.check_options(words[2:], self.run([*command[:2], "-h"]), " ".join(words[:2]))
        elif words[1] in ("sweep", "plan") and "--dry-run" not in words:
            self.run([*command, "--dry-run"])
        else:
            self.run(command)

    def try_program(self, words):
        """Of the four: options by the manual, values of the right kind. A mention may leave out words, or a value."""
        from slipscale.mistakes import Mistake
        from slipscale.running.sweep import SET_BY_THE_STUDY, check, manual
        name = Path(words[0]).name
        if name not in self.manuals:
            self.manuals[name] = manual(BUILD / name)
        for k, word in enumerate(words):
            if re.match("-[a-z]", word) and word[1:] not in SET_BY_THE_STUDY:
                value = words[k + 1] if k + 1 < len(words) and not re.match("-[a-z]|…", words[k + 1]) else None
                try:
                    check(word[1:], "1" if value is None else value, {name: self.manuals[name]})
                except Mistake as mistake:
                    if value is not None or "has an option" in str(mistake):
                        raise Fault(f"{shlex.join(words)}: {mistake}") from mistake

    try_morphology = try_slide = try_homogenize = try_relocalize = try_program

    def try_mpirun(self, words):
        self.attempt(shlex.join(words[3:]))

    def try_gmsh(self, words):
        self.check_options(words, self.said_by("gmsh", "-help"), "gmsh")

    def try_cp(self, words):
        if missing := [word for word in words[1:-1] if not word.startswith("-") and not self.exists(word)]:
            raise Fault(f"{shlex.join(words)}: there is no {missing[0]}")

    def try_cmake(self, words):
        manual = self.said_by("cmake", "--help") + self.said_by("cmake", "--install") + self.said_by("cmake", "--build")
        self.check_options(words, manual, "cmake")
        presets = [preset["name"] for preset in json.loads((TOP / "CMakePresets.json").read_text())["configurePresets"]]
        own = "".join(file.read_text() for file in (TOP / "CMakeLists.txt", *(TOP / "cmake").glob("*.cmake")))
        for before, word in zip(words, words[1:]):
            if before == "--preset" and word not in presets or word.startswith("build/") and word[6:] not in presets:
                raise Fault(f"{shlex.join(words)}: there is no preset for {word}: there are {presets}")
            if before == "-D" and word.startswith("SLIPSCALE_") and not re.search(rf"\b{word.split('=')[0]}\b", own):
                raise Fault(f"{shlex.join(words)}: nothing knows {word.split('=')[0]}")
            if before == "--component" and not re.search(rf"COMPONENT {word}\b", own):
                raise Fault(f"{shlex.join(words)}: there is no component {word}")

    def try_ctest(self, words):
        """That the tests are there which are chosen; they are listed, not run."""
        self.check_options(words, self.said_by("ctest", "--help"), "ctest")
        chosen = [word for before, word in zip(words, words[1:]) if "--test-dir" not in (before, word)]
        if "Total Tests: 0" in self.run(["ctest", "--test-dir", str(BUILD), "-N", *chosen]):
            raise Fault(f"{shlex.join(words)} chooses no test")

    def try_python3(self, words):
        self.try_file(words[1:])

    def try_file(self, words):
        """A script, a test program, or nothing but the path of a file."""
        file = self.folder / words[0]
        if file.name == "array.sh":
            self.run(words)
        elif file.suffix in (".sh", ".py"):
            if file.suffix == ".sh":
                self.run(["bash", "-n", str(file)])
            self.check_options(words, file.read_text(), words[0])
        elif file.is_file() and os.access(file, os.X_OK) and file.is_relative_to(self.folder / "build"):
            sources = (TOP / file.parent.relative_to(self.folder / "build" / "release")).glob("*.cpp")
            self.check_options(words, "".join(source.read_text() for source in sources), words[0])
        elif missing := [word for word in words if not self.exists(word)]:
            raise Fault(f"there is no {missing[0]}")
