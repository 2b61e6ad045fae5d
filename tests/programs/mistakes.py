"""Mistakes in a run of a program, each made in a folder of its own: what they share."""

import os
import shutil
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field

from running import arguments_of, snapshot, yaml_of

RANKS = int(os.environ.get("SLIPSCALE_RANKS", "1"))
AT_ONCE = 2  # starting and ending a parallel job is mostly waiting


@dataclass
class Mistake:
    """Words that the sentence must have, and how the run is spoiled."""

    words: list
    changes: dict = field(default_factory=dict)  # None leaves an option out
    arguments: list = field(default_factory=list)  # put behind the others
    yaml: str = ""  # put below them in a file


class Mistaken:
    """For an `InScratch` with `material`, the folder that every mistake gets a copy of; says of a program `program`
    what its sound options are (`options`), the files that it writes (`files`), and the `mistakes` by name."""

    def test_mistakes(self):
        with ThreadPoolExecutor(AT_ONCE) as pool:
            made = {name: pool.submit(self.make, mistake, self.folder / str(count), (count + RANKS) % 2 == 0)
                    for count, (name, mistake) in enumerate(self.mistakes.items())}
            for name, mistake in self.mistakes.items():
                with self.subTest(name):
                    outcome, before, after = made[name].result()
                    self.assert_refused(self.program, outcome, mistake.words, RANKS)
                    self.assertEqual(before, after, "files were touched")
        self.check_without_mistakes()

    def make(self, mistake, folder, older_run):
        """Spoils a run in its own folder: what was said, and what the folder held before and after.

        An older run may be in the output folder or not: each mistake meets both, on one rank or on two.
        """
        shutil.copytree(self.material, folder)
        (folder / "run.yaml").write_text(yaml_of(self.options) + mistake.yaml)
        if older_run:
            (folder / "out").mkdir()
            for file in (*self.files, "notes.txt"):
                (folder / "out" / file).write_text("of an older run")
        before = snapshot(folder)
        typed = arguments_of({**self.options, **mistake.changes})
        given = ["-options_file_yaml", "run.yaml"] if mistake.yaml else typed
        outcome = getattr(self, self.program)(*given, *mistake.arguments, ranks=RANKS, folder=folder)
        return outcome, before, snapshot(folder)
