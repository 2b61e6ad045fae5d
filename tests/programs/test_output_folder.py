"""An output folder that is in use, is taken away while the run goes on, or has a long name."""

import re
import shutil
import subprocess
import unittest

from long_runs import FOR_HOURS, RANKS, SCENE, InBlock
from running import SECONDS, arguments_of, datasets


class InUse(InBlock):
    def test_a_second_run_is_refused_and_a_killed_one_is_in_nobodys_way(self):
        for ranks in RANKS:
            job = self.start(FOR_HOURS, ranks)
            self.wait_for(self.folder / "out" / "history.h5")
            outcome = self.slide(*arguments_of(SCENE), ranks=ranks)
            self.assert_refused("slide", outcome, ["-output_folder 'out' belongs to a run that still goes on (process ",
                                                   "; wait for it or give another folder"], ranks)
            if ranks == 1:
                job.kill()
            else:
                holder = int(re.search(r"process (\d+)", outcome.err)[1])
                subprocess.run(["kill", "-9", str(holder)], check=True)
            job.communicate()
            self.assertTrue((self.folder / "out" / ".slipscale-lock").exists())
            self.run_scene(SCENE, ranks=ranks)
            self.assertFalse((self.folder / "out" / ".slipscale-lock").exists())
            shutil.rmtree(self.folder / "out")

    def test_removed_while_running(self):
        for ranks in RANKS:
            job = self.start(FOR_HOURS, ranks)
            self.wait_for(self.folder / "out" / "run.yaml")  # written last before the first step
            shutil.rmtree(self.folder / "out", ignore_errors=True)
            shutil.rmtree(self.folder / "out", ignore_errors=True)
            _, err = job.communicate(timeout=SECONDS)
            self.assertNotEqual(job.returncode, 0)
            self.assertRegex(err, r"slide: out/(history|contact).h5 cannot be written: .*No such file or directory; ")
            if ranks == 1:
                self.assertEqual(job.returncode, 1)


class LongNames(InBlock):
    def test_a_path_of_500_characters(self):
        folder = "/".join(letter * 120 for letter in "abcd")
        for ranks in RANKS:
            self.run_scene({**SCENE, "fields_every": 50}, ranks=ranks, output_folder=folder)
            self.assertEqual(len(datasets(self.folder / folder / "fields.h5")["time"]), 5)


if __name__ == "__main__":
    unittest.main()
