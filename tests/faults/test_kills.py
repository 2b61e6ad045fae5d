"""kill -9, at random moments and in the middle of each write, and what is left then."""

import os
import random
import shutil
import time
import unittest

from faulty import SCENE, Faults

SEED = int(os.environ.get("SLIPSCALE_SEED", "1"))
MOST = int(os.environ.get("SLIPSCALE_MOST", "100"))  # calls of one kind at which a program is killed, in the long tests


class AtRandom(Faults):
    """Of one rank, and of all, anywhere between start and end."""

    def check(self, moments, ranks, everybody):
        begin = time.monotonic()
        whole = self.reference(SCENE, ranks)
        lasts = time.monotonic() - begin
        chance = random.Random(SEED)
        torn = went_on = 0
        for _ in range(moments):
            job = self.start(self.checkpointed(SCENE), ranks)
            time.sleep(chance.uniform(0.05, lasts))
            processes = self.processes()
            chance.shuffle(processes)
            for process in processes if everybody else processes[:1]:
                try:
                    os.kill(process, 9)
                except ProcessLookupError:
                    pass
            code, err = self.finish(job)
            if (self.folder / "out").exists():
                torn += self.check_left(self.folder / "out", whole)
                went_on += self.check_restart(whole, chance.choice((1, 2)))
            shutil.rmtree(self.folder / "out", ignore_errors=True)
        print(f"random kills: {moments}, ranks {ranks}, {'all' if everybody else 'one'}: files made good {torn}, "
              f"runs that went on {went_on}")

    def test_alone(self):
        self.check(moments=3, ranks=1, everybody=True)

    def test_one_of_two(self):
        self.check(moments=2, ranks=2, everybody=False)


class AtRandomOften(AtRandom):
    def test_alone(self):
        self.check(moments=50, ranks=1, everybody=True)

    def test_one_of_two(self):
        self.check(moments=25, ranks=2, everybody=False)

    def test_two_of_two(self):
        self.check(moments=25, ranks=2, everybody=True)


class Aimed(Faults):
    """Before, and half through, a call that changes an output file."""

    scene = {**SCENE, "time_end": 12e-6}

    def check(self, part, most, half):
        whole = self.reference(self.scene)
        scene = self.checkpointed(self.scene)
        calls = self.calls(scene, part)
        self.assertGreater(len(calls), 0, part)
        shutil.rmtree(self.folder / "out")
        numbers = list(range(1, len(calls) + 1))
        if len(numbers) > most:
            numbers = sorted(random.Random(SEED).sample(numbers, most))
        torn = went_on = missed = 0
        for number in numbers:
            fault = {"half": 1} if half else {}
            code, err = self.run_job(scene, path=part, kill_at=number, **fault)
            if code == 0:  # rows go to the disk by the clock: it made fewer calls than the run that counted them
                missed += 1
                self.check_left(self.folder / "out", whole)
                shutil.rmtree(self.folder / "out")
                continue
            self.assertEqual(code, -9, f"{part}, call {number} of {len(calls)}: {err}")
            with self.subTest(file=part, call=number, of=len(calls)):
                torn += self.check_left(self.folder / "out", whole)
                went_on += self.check_restart(whole)
            shutil.rmtree(self.folder / "out")
        print(f"kills in calls that change {part}: {len(numbers) - missed} of {len(calls)}, files made good {torn}, "
              f"runs that went on {went_on}", flush=True)
        self.assertLess(missed, max(2, len(numbers) / 2))

    def test_any(self):
        self.check("out/", most=12, half=True)


class AimedOften(Aimed):
    def test_any(self):
        pass

    def test_history(self):
        self.check("out/history.h5", most=MOST, half=True)
        self.check("out/history.h5", most=MOST, half=False)

    def test_contact(self):
        self.check("out/contact.h5", most=MOST, half=True)

    def test_fields(self):
        self.check("out/fields.h5", most=MOST, half=True)
        self.check("out/fields.h5", most=MOST, half=False)

    def test_journals(self):
        self.check(".journal", most=MOST, half=True)

    def test_xdmf(self):
        self.check("out/fields.xdmf", most=MOST // 2, half=True)

    def test_statistics(self):
        self.check("out/statistics", most=MOST // 2, half=True)

    def test_yaml(self):
        self.check(".yaml", most=MOST // 10, half=True)

    def test_checkpoints(self):
        if not self.knows_restart():
            self.skipTest("slide knows no checkpoints")
        self.check("out/checkpoint", most=MOST, half=True)


if __name__ == "__main__":
    unittest.main()
