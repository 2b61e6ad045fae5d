"""A program that takes options as `slide` does and leaves a made-up run, whose power falls with the relaxation time.

    python3 -m tests.fake_slide -friction_time 1e-6 … -output_folder FOLDER

Power into the body over drive power is .44/(1 + (T/1 µs)²), the amplitude of friction grows with it. With a
friction_coefficient of 9 it fails. Each run adds a line to calls.txt beside the folder.
"""

import sys
from pathlib import Path

import h5py
import numpy as np
import yaml

from tests import fake_run


def power_ratio(time):
    return 0.44 / (1 + (time / 1e-6)**2)


def write(options):
    folder = Path(options["output_folder"])
    folder.mkdir(parents=True, exist_ok=True)
    fake_run.write_history(folder, 5e-8 * np.arange(2000))  # 100 µs
    ratio = power_ratio(float(options["friction_time"]))
    with h5py.File(folder / "history.h5", "a") as file:
        tangential = file["boundary/top/tangential_force"]
        mean = fake_run.FRICTION * file["boundary/top/normal_force"][:]
        tangential[:] = mean + (tangential[:] - mean) * ratio / 0.22
        file["surface/power_into_body"][:] = ratio * file["surface/drive_power"][:]
    (folder / "run.yaml").write_text(yaml.safe_dump(options))
    with (folder.parent / "calls.txt").open("a") as calls:
        calls.write(f"{options['friction_time']}\n")


def main(words):
    options = {name[1:]: value for name, value in zip(words[::2], words[1::2])}
    if float(options.get("friction_coefficient", 0.5)) == 9:
        print("slide: this coefficient is too large")
        return 2
    write(options)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
