"""Reads what the programs leave in their output folders, measures, compares and plots it. All quantities in SI units.

Reading     the files of a run, meshes, effective materials
Measuring   regime (what a run did in a window), spectrum (Welch), distance (of signals, spectra, portraits),
            surface_motion (power through the contact), convergence (orders, Richardson), window. Draws nothing.
Adapting    adapt (command), relaxation (formulas), search, trials
Running     attempt (a program whose failure is a result), commands (options as words), table (runs by name, rows),
            sweep, sweep_plan, sweep_command
Reports     what is said about a table in Markdown; compare (runs side by side), pages of HTML (a run, a study)
Pictures    picture (a run at a glance), scene (before it is run), maps (a table over options), cell_picture,
            relocalized_picture; what they share

For scripts and notebooks:

    import slipscale
    run = slipscale.Run("out/first")                  # run.time, run.friction, run.points[0].u, run.contact, …
    run = slipscale.slide("scene.yaml", ranks=2, folder="out/mine", friction_coefficient=0.3)

What serves one study alone lies beside that study's Snakefile.
"""

import os
import sys

os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")  # before h5py: a running job holds its files open

STARTED = ("slipscale", "slipscale.running.attempt")  # what `python3 -m` may name: the command, and what studies use


def _module_named():
    """The module that `python3 -m` is about to run, or None."""
    words = getattr(sys, "orig_argv", [])
    return words[words.index("-m") + 1] if sys.argv[:1] == ["-m"] and "-m" in words[:-1] else None


if (_module_named() or "").startswith("slipscale.") and _module_named() not in STARTED:
    print(f"{_module_named()} is a library, no command: slipscale -h lists the commands.", file=sys.stderr)
    sys.exit(2)

_PUBLIC = {"Run": "slipscale.run", "Spectrum": "slipscale.run", "Frame": "slipscale.run", "Contact": "slipscale.run",
           "slide": "slipscale.running.start", "RunFailed": "slipscale.running.start",
           "UnreadableRun": "slipscale.reading", "OPEN": "slipscale.reading", "STICK": "slipscale.reading",
           "SLIP": "slipscale.reading", "MEASURES": "slipscale.measuring.regime"}
__all__ = sorted(_PUBLIC)


def __getattr__(name):
    """What users of the package need, loaded when it is first asked for."""
    if name not in _PUBLIC:
        raise AttributeError(f"slipscale has no {name}; it has {', '.join(__all__)}")
    import importlib
    return getattr(importlib.import_module(_PUBLIC[name]), name)


def __dir__():
    return [*globals(), *__all__]
