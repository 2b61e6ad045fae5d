"""The command `slipscale`: one table of subcommands, each a module with `main(arguments)` that gives the exit code.

A module is loaded when its subcommand is called, so that `-h` and `--version` need neither numpy nor matplotlib.
"""

import importlib
import importlib.util
import os
import sys
from pathlib import Path

from slipscale.parser import say

RUNS = Path(__file__).resolve().parents[1]  # the folder of the package, of the studies and of their rules

COMMANDS = {  # name: (module, what it does in one line)
    "picture": ("slipscale.pictures.picture", "one run of slide at a glance"),
    "scene": ("slipscale.pictures.scene", "block, boundary conditions and surface of a scene before it is run"),
    "cell-picture": ("slipscale.pictures.cell_picture", "a cell of homogenize: stress under unit strains, stiffness"),
    "relocalized-picture": ("slipscale.pictures.relocalized_picture",
                            "local stress of relocalize beside the heterogeneous and the homogeneous run's"),
    "modes-picture": ("slipscale.pictures.modes_picture", "the modes of steady sliding: spectrum, shapes, tractions, map"),
    "compare": ("slipscale.reports.compare",
                "two or more runs side by side: means, spectra, portraits, settled or not"),
    "report": ("slipscale.reports.page", "a run, or a study, on one page that opens anywhere"),
    "sweep": ("slipscale.running.sweep_command", "runs slide for every combination of values of any options"),
    "table": ("slipscale.reports.table_command", "rows and columns of a study's table as text"),
    "maps": ("slipscale.pictures.maps", "columns of a study's table over the options that were varied"),
    "plan": ("slipscale.planning.plan", "which mesh, step and window keep the accuracy that is wished for, at which price"),
    "wear": ("slipscale.wearing.wear", "wear depth by Archard's law and by energy, flash temperature, from a run's contact"),
    "adapt": ("slipscale.adapting.adapt", "the relaxation time with which a homogeneous model rubs as the composite"),
}

TEXT = """slipscale SUBCOMMAND [words …]

What surrounds slide, homogenize, relocalize and morphology: pictures, comparisons, sweeps. Folders are what these
programs wrote; everything is found and written from where the command is given. Quantities are in SI units.

"""


def known():
    """The subcommands whose module is there."""
    return {name: entry for name, entry in COMMANDS.items() if importlib.util.find_spec(entry[0])}


def manual():
    rows = "".join(f"  {name:<21}{what}\n" for name, (_, what) in known().items())
    return (f"{TEXT}{rows}\n  slipscale SUBCOMMAND -h     its words and options\n"
            "  slipscale --version         of the programs beside it, and of what it is built on\n"
            "  slipscale --python-path     what PYTHONPATH needs for `import slipscale`\n")


def version():
    """The version that the launcher was made with, and those of the libraries."""
    said = [f"slipscale {os.environ.get('SLIPSCALE_VERSION', 'of an unknown version')}",
            f"Python {sys.version.split()[0]} ({sys.executable})"]
    for name in ("numpy", "h5py", "matplotlib", "yaml"):
        try:
            said.append(f"{name} {importlib.import_module(name).__version__}")
        except ImportError:
            said.append(f"{name} is missing")
    return "\n".join(said)


def called(name, words):
    from slipscale.mistakes import Mistake
    try:
        return importlib.import_module(known()[name][0]).main(words)
    except (Mistake, OSError) as error:
        if isinstance(error, BrokenPipeError):
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # a reader, as `head`, that has enough
            return 0
        return say(name, error)
    except ModuleNotFoundError as error:
        if error.name and error.name.startswith("slipscale"):
            raise
        return say(name, f"{sys.executable} has no {error.name}: install it, or build with -D SLIPSCALE_PYTHON=… of a "
                         "Python that has numpy, h5py, matplotlib and yaml.")
    except KeyboardInterrupt:
        return 130


def main(words=None):
    words = ["-h" if word == "-help" else word for word in (sys.argv[1:] if words is None else words)]
    if words[:1] in ([], ["-h"], ["--help"], ["help"]):
        print(manual(), end="")
        return 0
    if words[0] in ("--version", "-version"):
        print(version())
        return 0
    if words[0] == "--python-path":
        print(RUNS)
        return 0
    if words[0] not in known():
        import difflib
        near = difflib.get_close_matches(words[0], known(), 1, 0.5)
        print(f"slipscale: {words[0]!r} is no subcommand" + (f"; is {near[0]} meant?" if near else
              f": there are {', '.join(known())}."), file=sys.stderr)
        return 2
    return called(words[0], words[1:])
