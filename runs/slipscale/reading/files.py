"""Opens the files of a run. A run that is still going, or was killed, can be read too."""

import h5py

from slipscale.mistakes import Mistake
from slipscale.reading.recovery import make_good
from slipscale.reading.yaml_file import load


class UnreadableRun(Mistake):
    """What is missing or wrong in an output folder, in one sentence."""


def open_hdf5(path, program="slide"):
    """An open, read-only `h5py.File`. Raises UnreadableRun when there is none or it cannot be read."""
    if not path.is_file():
        raise UnreadableRun(f"There is no {path.name} in {path.parent}: give the output folder of a `{program}` run.")
    make_good(path)
    try:
        return h5py.File(path, "r")
    except OSError as error:
        raise UnreadableRun(f"{path} cannot be read ({error}): was it copied or written completely?") from error


def read_dataset(file, name):
    """The dataset `name` of an open file. Raises UnreadableRun when it is not there."""
    if name not in file:
        raise UnreadableRun(f"{file.filename} has no dataset {name}: it was not written, or not by this version.")
    return file[name][()]


def read_yaml(path):
    """A YAML file of flat keys as a dict; empty when there is no such file (a run writes its summary at the end)."""
    if not path.is_file():
        return {}
    return load(path, written=True) or {}


def grows(dataset):
    """Whether the writer appends rows to it; where a node lies, say, is written once."""
    return dataset.maxshape[:1] == (None,)
