"""The first study, killed twice and continued on other numbers of ranks, against the same without a fault: equal bits in
every dataset, equal numbers in the summary, an equal picture."""

import os
import subprocess
import time
import unittest

import yaml
from faulty import GROWING, ROOT, Faults, contents
from running import run

END = float(os.environ.get("SLIPSCALE_END", "400e-6"))  # s, of the study's scene


class FirstStudy(Faults):
    def scene(self, folder):
        return {"options_file_yaml": ROOT / "runs/first/scene.yaml", "mesh_file": "mesh/mesh.msh", "time_end": END,
                "output_folder": folder, "checkpoint_every": 1000}

    def kill(self, job, seconds):
        """All ranks, so many seconds after a checkpoint was written anew."""
        path = self.folder / "out" / "checkpoint.h5"
        before = path.stat().st_mtime_ns if path.exists() else None
        while job.poll() is None and (not path.exists() or path.stat().st_mtime_ns == before):
            time.sleep(0.01)
        time.sleep(seconds)
        for process in self.processes():
            os.kill(process, 9)
        code, _ = self.finish(job)
        self.assertNotEqual(code, 0, "the run had ended before it was killed")

    def picture(self, folder):
        subprocess.run([os.environ["SLIPSCALE_COMMAND"], "picture", folder, folder + ".png"], cwd=self.folder, check=True,
                       stdout=subprocess.DEVNULL)
        return (self.folder / (folder + ".png")).read_bytes()

    def test_killed_twice(self):
        made = run([os.environ["SLIPSCALE_MORPHOLOGY"], "-options_file_yaml", str(ROOT / "runs/first/block.yaml"),
                    "-output_folder", "mesh"], self.folder, self.environment())
        self.assertEqual(made.codes, [0], made.err)
        self.assertEqual(self.run_job(self.scene("whole"), ranks=2)[0], 0)
        self.kill(self.start(self.scene("out"), ranks=2), 0.4)
        self.kill(self.start({"restart": "out"}, ranks=1), 0.7)
        code, err = self.run_job({"restart": "out"}, ranks=3)
        self.assertEqual(code, 0, err)
        for name in GROWING:
            whole, found = contents(self.folder / "whole" / name), contents(self.folder / "out" / name)
            self.assertEqual(set(found), set(whole))
            for key, values in found.items():
                self.assertEqual(values.tobytes(), whole[key].tobytes(), f"{name}: {key}")
        whole, found = (yaml.safe_load((self.folder / folder / "summary.yaml").read_text()) for folder in ("whole", "out"))
        for part in set(whole) - {"cost"}:
            self.assertEqual(found[part], whole[part], part)
        # The picture bears the folder's name: both are drawn under one.
        picture = self.picture("out")
        (self.folder / "out").rename(self.folder / "killed")
        (self.folder / "whole").rename(self.folder / "out")
        self.assertEqual(self.picture("out"), picture)


if __name__ == "__main__":
    unittest.main()
