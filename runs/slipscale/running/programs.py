"""Where slide, homogenize, relocalize and morphology are: those that were built or installed with this package."""

import os
import shlex
import shutil
from pathlib import Path

from slipscale.mistakes import Mistake

TOP = Path(__file__).resolve().parents[3]  # of a clone; installed: PREFIX/share/slipscale
PLACES = (TOP / "build" / "release", TOP.parents[1] / "bin")


def folder(given=None):
    """The folder of the programs, an absolute path: `given` (from where the user stands), else what SLIPSCALE_PROGRAMS
    says, as the command `slipscale` does for what it starts, else the one that was built or installed."""
    if chosen := given or os.environ.get("SLIPSCALE_PROGRAMS"):
        return Path(chosen).resolve()
    return next((place for place in PLACES if (place / "slide").is_file()), PLACES[0])


def program(name):
    return folder() / name


def words_of(command):
    """The words of a command as `mpirun -n 2 slide`. Raises Mistake when its program, or the one that it starts, is
    missing."""
    words = shlex.split(str(command))
    if not words:
        raise Mistake("no program is named")
    if not shutil.which(words[0]):
        raise Mistake(f"there is no program {words[0]}: build it, or say where it is with --program")
    for word in words[1:]:
        if Path(word).name in ("slide", "homogenize", "relocalize", "morphology") and not shutil.which(word):
            raise Mistake(f"there is no program {word}: build it, or say where it is with --program")
    return words
