"""Runs the programs as a user does and looks at what they say, return and write.

The environment says where they are: SLIPSCALE_SLIDE, SLIPSCALE_MPIEXEC, and others where they are used.
"""

import os

os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")  # before h5py: a running job holds its files open

import subprocess
import tempfile
import unittest
from dataclasses import dataclass
from pathlib import Path

import h5py

SLIDE = os.environ["SLIPSCALE_SLIDE"]
MPIEXEC = os.environ["SLIPSCALE_MPIEXEC"]
SECONDS = 180  # a run that takes longer hangs

# mpiexec ends all ranks after the first that fails, so each rank leaves its own exit code in a file.
KEEP_CODE = '"$0" "$@"; echo $? > "$CODES/$OMPI_COMM_WORLD_RANK"'


@dataclass
class Outcome:
    """What one run left behind: exit codes by rank, and what it said."""

    codes: list
    out: str
    err: str


class InScratch(unittest.TestCase):
    """A test with a folder of its own, where it runs `slide`."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def environment(self, **more):
        """The caller's, without what would change a run behind its back."""
        kept = {name: value for name, value in os.environ.items() if not name.startswith("PETSC_OPTIONS")}
        return {**kept, "HOME": str(self.folder), **more}

    def launch(self, program, *arguments, ranks=1, folder=None):
        """Runs to the end, in the test's own folder or another. One rank runs without mpiexec, as on a laptop."""
        arguments = [str(argument) for argument in arguments]
        folder = folder or self.folder
        if ranks == 1:
            return run([program, *arguments], folder, self.environment())
        with tempfile.TemporaryDirectory() as codes:
            command = [MPIEXEC, "-n", str(ranks), "bash", "-c", KEEP_CODE, program, *arguments]
            outcome = run(command, folder, self.environment(CODES=codes))
            outcome.codes = [int((Path(codes) / str(rank)).read_text()) for rank in range(ranks)]
        return outcome

    def slide(self, *arguments, ranks=1, folder=None):
        return self.launch(SLIDE, *arguments, ranks=ranks, folder=folder)

    def run_scene(self, scene, ranks=1, **changes):
        """Runs a scene (a dict of options, see `arguments_of`) that must succeed without a word on stderr."""
        outcome = self.slide(*arguments_of({**scene, **changes}), ranks=ranks)
        self.assertEqual((outcome.codes, outcome.err), ([0] * ranks, ""), outcome.out)
        return outcome

    def assert_refused(self, program, outcome, words, ranks):
        """One sentence with all these words, and exit code 2 on every rank."""
        said = f"\nout: {outcome.out}\nerr: {outcome.err}"
        self.assertEqual(outcome.codes, [2] * ranks, said)
        self.assertRegex(outcome.err, rf"\A{program}: [^\n]+\n\Z", said)
        for word in words:
            self.assertIn(word, outcome.err, said)
        for noise in ("PETSC ERROR", "what():", "WARNING!", "Traceback"):
            self.assertNotIn(noise, outcome.out + outcome.err)


def run(command, folder, environment):
    done = subprocess.run(command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, capture_output=True,
                          text=True, timeout=SECONDS)
    return Outcome([done.returncode], done.stdout, done.stderr)


def arguments_of(scene):
    """A dict of options as command-line arguments; None leaves an option out."""
    return [word for name, value in scene.items() if value is not None for word in ("-" + name, str(value))]


def yaml_of(scene):
    """The same as a YAML file of flat keys."""
    return "".join(f"{name}: {value}\n" for name, value in scene.items() if value is not None)


def snapshot(folder):
    """Every file and folder below, with what the files hold."""
    return {path.relative_to(folder): path.read_bytes() if path.is_file() else None for path in folder.rglob("*")}


def datasets(path):
    """All datasets of an HDF5 file by path, as arrays."""
    found = {}
    with h5py.File(path, "r") as file:
        file.visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
    return found
