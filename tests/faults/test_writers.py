"""The programs that write whole files, killed in the middle: nothing half-written has a final name."""

import os
import random
import shutil
import unittest

from faulty import Faults, block, contents
from drawing import DISCS, MORPHOLOGY
from homogenising import HOMOGENIZE
from relocalizing import CELL, RELOCALIZE, RUN, Relocalising

SEED = int(os.environ.get("SLIPSCALE_SEED", "1"))


def content_of(path):
    """What counts of a file: the datasets of an HDF5 file, the text of another but for times and dates."""
    if path.suffix == ".h5":
        return {name: values.tobytes() for name, values in contents(path).items()}
    lines = path.read_bytes().splitlines()
    return [line for line in lines if b"time" not in line and b"seconds" not in line and b"memory" not in line]


class Writers(Faults, Relocalising):
    most = 4

    def setUp(self):
        super().setUp()
        block(self.folder / "block.msh", regions=("matrix", "inclusion"))

    def check(self, program, scene):
        code, err = self.finish(self.start(scene, program=program))
        self.assertEqual(code, 0, err)
        out = self.folder / "out"
        whole = {file.name: content_of(file) for file in out.iterdir()}
        shutil.rmtree(out)
        calls = self.calls(scene, "out/", program=program)
        shutil.rmtree(out)
        numbers = sorted(random.Random(SEED).sample(range(1, len(calls) + 1), min(self.most, len(calls))))
        if len(calls) not in numbers:
            numbers.append(len(calls))
        left = 0
        for number in numbers:
            code, err = self.finish(self.start(scene, program=program, path="out/", kill_at=number, half=1))
            with self.subTest(program=program.rsplit("/", 1)[-1], call=number, of=len(calls), what=calls[number - 1]):
                self.assertEqual(code, -9, err)
                for file in out.iterdir() if out.exists() else ():
                    if ".partial" not in file.name and file.name != ".slipscale-lock":
                        left += 1
                        self.assertEqual(content_of(file), whole[file.name], file.name)
                # What a killed run leaves is in nobody's way.
                code, err = self.finish(self.start(scene, program=program))
                self.assertEqual(code, 0, err)
                self.assertEqual({file.name for file in out.iterdir()}, set(whole))
            shutil.rmtree(out, ignore_errors=True)
        name = program.rsplit("/", 1)[-1]
        print(f"kills in calls of {name}: {len(numbers)} of {len(calls)}; whole files left: {left}", flush=True)

    def test_morphology(self):
        self.check(MORPHOLOGY, {**DISCS, "output_folder": "out"})

    def test_homogenize(self):
        self.draw_cell(self.folder / "cell.msh")
        self.check(HOMOGENIZE, {**CELL, "mesh_file": "cell.msh", "output_folder": "out"})

    def test_relocalize(self):
        self.make_runs()
        self.check(RELOCALIZE, {**RUN, "output_folder": "out"})


class WritersOften(Writers):
    most = 60


if __name__ == "__main__":
    unittest.main()
