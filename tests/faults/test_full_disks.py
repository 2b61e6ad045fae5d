"""A disk that is full for one of the output files, from the start or after some bytes, and cannot reserve room.

What such a run has left as a checkpoint goes on to the same bits once there is room again.
"""

import os
import random
import shutil
import unittest

from faulty import SCENE, Faults

SEED = int(os.environ.get("SLIPSCALE_SEED", "1"))
FULL = (r"\Aslide: out/\S+ cannot be written: [^\n]*No space left on device; "
        r"see that -output_folder is writable and its disk has room\n")


class Full(Faults):
    scene = {**SCENE, "time_end": 12e-6}

    def check(self, files, rooms, ranks):
        """`rooms` of each file: what it may grow by, in parts of what it grows to; None: a random part."""
        whole = self.reference(self.scene, ranks)
        scene = self.checkpointed(self.scene)
        chance = random.Random(SEED)
        stopped = went_on = 0
        for part in files:
            size = sum(count for call, count, path in self.calls(scene, part) if call == "write")
            shutil.rmtree(self.folder / "out")
            for room in rooms:
                room = int(size * (chance.random() if room is None else room))
                with self.subTest(file=part, room=room, of=size, ranks=ranks):
                    code, err = self.run_job(scene, ranks, path=part, room=room)
                    if (self.folder / "out").exists():
                        self.assertEqual(self.check_left(self.folder / "out", whole), 0)
                    if code == 0:  # the file is smaller than what is written: parts of it are written again
                        self.assertGreater(room, size / 3)
                    else:
                        self.assertEqual(code, 1, err)
                        self.assertRegex(err, FULL)
                    for noise in ("egmentation", "MPI_ABORT", "what():"):
                        self.assertNotIn(noise, err)
                    if code != 0 and (self.folder / "out").exists():
                        stopped += 1
                        went_on += self.check_restart(whole, chance.choice((1, 2)))
                shutil.rmtree(self.folder / "out", ignore_errors=True)
        print(f"full disks, ranks {ranks}: {len(files) * len(rooms)} runs, stopped {stopped}, of which went on with the "
              f"same bits {went_on}", flush=True)

    def test_alone(self):
        self.check(["out/history.h5", "out/contact.h5", "out/fields.h5"], [0, None], 1)

    def test_for_a_checkpoint(self):
        """All rows before it are kept, and the one before goes on."""
        self.check(["out/checkpoint"], [0, 0.4], 2)


class FullOften(Full):
    def test_alone(self):
        self.check(["out/history.h5", "out/contact.h5", "out/fields.h5", "out/fields.xdmf", "out/statistics.h5",
                    "out/run.yaml", "out/summary.yaml", "out/"], [0, 1e-3, *[None] * 8], 1)

    def test_for_a_checkpoint(self):
        for ranks in (1, 2):
            self.check(["out/checkpoint"], [0, 1e-3, 0.1, *[None] * 8], ranks)

    def test_two_ranks(self):
        files = ["out/history.h5", "out/contact.h5", "out/fields.h5", "out/statistics.h5", "out/"]
        self.check(files, [0, *[None] * 4], 2)

    def test_journals_need_not_be(self):
        """Where only they find no room, the run goes on without."""
        whole = self.reference(self.scene)
        for room in (0, 100, 5000):
            code, err = self.run_job(self.scene, path=".journal", room=room)
            self.assertEqual((code, err), (0, ""))
            self.check_left(self.folder / "out", whole)


if __name__ == "__main__":
    unittest.main()
