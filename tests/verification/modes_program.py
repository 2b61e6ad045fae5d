"""Runs `modes` and reads what it found. The environment says where it is: SLIPSCALE_MODES, SLIPSCALE_MPIEXEC."""

import os
import subprocess
import tempfile
import unittest
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import sliding_scenes

from slipscale.reading.yaml_file import load

ONLY_SLIDE = ("time_end", "boundary_top_ramp", "initial_sine_amplitude", "initial_sine_wavelength")


@dataclass
class Found:
    """p and, where it was asked for, that of the scheme, [k] 1/s, growing fastest first; residual [k]; all of modes.yaml;
    what the program said."""

    p: np.ndarray
    scheme: np.ndarray
    residual: np.ndarray
    yaml: dict
    said: str

    def nearest(self, p):
        return self.p[np.abs(self.p - p).argmin()]


def exponent(mode):
    return complex(float(mode["growth_rate"]), 2 * np.pi * float(mode["frequency"]))


class ModesCase(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = Path(temporary.name)

    def modes(self, options, ranks=1, **more):
        """Found, of a scene without what speaks of time steps only."""
        options = {name: value for name, value in options.items() if name not in ONLY_SLIDE}
        if not more.get("modes_scheme"):
            options = {name: value for name, value in options.items() if name not in ("time_step", "time_beta2")}
        out = self.folder / "modes"
        launcher = [os.environ["SLIPSCALE_MPIEXEC"], "-n", str(ranks)] if ranks > 1 else []
        command = [*launcher, os.environ["SLIPSCALE_MODES"], *sliding_scenes.words({**options, **more,
                                                                                    "output_folder": out})]
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=600)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        found = load(out / "modes.yaml", written=True)
        modes = found["modes"] or []
        return Found(np.array([exponent(mode) for mode in modes]),
                     np.array([exponent(mode["scheme"]) for mode in modes if "scheme" in mode]),
                     np.array([float(mode["residual"]) for mode in modes]), found, done.stdout + done.stderr)

    def assert_close(self, found, expected, tolerance, said=""):
        """Of exponents, relative to |p|."""
        self.assertLessEqual(abs(found - expected) / abs(expected), tolerance, f"{said}: {found} for {expected}")
