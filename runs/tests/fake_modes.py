"""Writes an output folder as `modes` does, with made-up modes, to try the reading and the plots; as a program, with
growth rates that are inverse to the relaxation time.

    python3 -m tests.fake_modes -friction_time 1e-6 -output_folder FOLDER
"""

import sys
from pathlib import Path

import h5py
import numpy as np

from tests import fake_run

MODES = [(372.6e3, 5.6e4), (512.0e3, 2.1e4), (128.0e3, -4.4e3)]  # Hz, 1/s
NODES = 61


def yaml_of(modes, scheme):
    text = "state:\n  nodes_in_contact: 59\n  nodes_open: 2\n  normal_force: 71573.8\n  tangential_force: 35786.9\nmodes:"
    for frequency, growth in modes:
        text += f"""
  - frequency: {frequency}
    growth_rate: {growth}
    damping_ratio: 0.01
    time_to_tenfold: null
    near_contact_energy: 0.2
    friction_work:
      matrix: 0.1
    residual: 1e-12"""
        if scheme:
            text += f"\n    scheme:\n      frequency: {1.0001 * frequency}\n      growth_rate: {1.001 * growth}"
    return text + ("\n" if modes else " []\n")


def write_modes(folder, modes=tuple(MODES), scheme=False, shift=0.0, more=""):
    """Shapes are standing waves along x, the k-th with k + 1 nodes, turned by a phase; `shift` spoils them."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "modes.yaml").write_text(yaml_of(modes, scheme) + more)
    fake_run.write_fields(folder, [0.0], "triangles", divisions=24)
    with h5py.File(folder / "fields.h5") as fields, h5py.File(folder / "modes.h5", "w") as file:
        fields.copy("mesh", file)
        x, y = fields["mesh/coordinates"][:, :2].T / fake_run.SIDE
        along = np.linspace(0, 1, NODES)
        file["contact/x"] = along * fake_run.SIDE
        tractions = []
        for k in range(len(modes)):
            wave = np.cos((k + 1) * np.pi * x + shift) * (1 - y)
            shape = np.exp(0.7j * k) * np.column_stack([wave, 0.5j * wave, 0 * wave])
            file[f"shape/mode_{k + 1}/real"], file[f"shape/mode_{k + 1}/imaginary"] = shape.real, shape.imag
            tractions.append(np.exp(1j * (k + 1) * np.pi * along))
        for name, factor in (("normal", 1.0), ("tangential", 0.4 - 0.2j)):
            values = factor * np.array(tractions).reshape(len(modes), NODES)
            file[f"contact/{name}_real"], file[f"contact/{name}_imaginary"] = values.real, values.imag


def main(words):
    options = {name[1:]: value for name, value in zip(words[::2], words[1::2])}
    factor = 1e-6 / float(options["friction_time"])
    damping = 1e6 if float(options.get("friction_coefficient", 0.5)) == 0 else 0  # 1/s
    write_modes(options["output_folder"], [(frequency, factor * growth - damping) for frequency, growth in MODES])
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
