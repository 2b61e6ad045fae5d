"""Reads what the programs leave in their output folders, measures, compares and plots it. All quantities in SI units.

Reading     the files of a run, meshes, effective materials
Measuring   regime (what a run did in a window), spectrum (Welch), distance (of signals, spectra, portraits),
            surface_motion (power through the contact), convergence (orders, Richardson), window. Draws nothing.
Planning    plan (command): wishes, case, pilots (coarse runs), values, errors (order, constant, scatter), costs,
            proposal, refusals, answer
Adapting    adapt (command), relaxation (formulas), search, trials
Wearing     wear (command): constants by region, depth (Archard, energy), flash (temperature of a half-space)
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

# The command, and what studies use.
STARTED = ("slipscale.__main__", "slipscale.running.attempt", "slipscale.running.ended")


def _module_started():
    """The module of this package that Python was told to run, by `-m` or as a file, or None."""
    words = getattr(sys, "orig_argv", [])
    if sys.argv[:1] == ["-m"] and "-m" in words[:-1]:
        name = words[words.index("-m") + 1]
        return name if name.startswith("slipscale.") else None
    file, here = os.path.abspath(sys.argv[0] if sys.argv else ""), os.path.dirname(os.path.abspath(__file__))
    return file[len(os.path.dirname(here)) + 1:-3].replace(os.sep, ".") if file.startswith(here + os.sep) else None


if _module_started() not in (None, *STARTED):
    print(f"{_module_started()} is a library, no command: slipscale -h lists the commands.", file=sys.stderr)
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
