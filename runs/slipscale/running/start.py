"""Starts `slide` from Python and gives back its Run."""

import os
import shutil
import subprocess
from pathlib import Path

import yaml

from slipscale.mistakes import Mistake
from slipscale.reading import yaml_file
from slipscale.run import Run
from slipscale.running import programs
from slipscale.running.commands import word


class RunFailed(Mistake):
    """What `slide` said before it stopped."""


def slide(scene, ranks=1, folder=None, program=None, **options):
    """Runs `slide` and returns its Run.

    scene: a dict as in a scene's YAML file, nested or flat, numbers in SI units; or the path of such a file.
    ranks: MPI processes. folder: where results go, if the scene does not say (-output_folder).
    program: path of `slide`, by default the one beside this package or on the PATH.
    options: further options, as on the command line: `friction_coefficient=0.3, time_end=100e-6`.

    Progress is shown as on a terminal. Raises RunFailed with the program's own sentence when it stops.
    """
    words = [str(program or programs.program("slide"))]
    if isinstance(scene, dict):
        scene, folder = _written(scene, folder)
    words += ["-options_file_yaml", str(scene)]
    if folder:
        words += ["-output_folder", str(folder)]
    for name, value in options.items():
        words += [f"-{name}", word(value)]
    if ranks > 1:
        words = [shutil.which("mpirun") or "mpirun", "-n", str(ranks)] + words
    done = subprocess.run(words, stdin=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                          env={**os.environ, **_mpi()})
    if done.returncode != 0:
        raise RunFailed(_sentence(done.stderr.splitlines()) or f"{words[0]} ended with exit code {done.returncode}")
    return Run(folder or options.get("output_folder") or _folder_of(scene))


def _written(scene, folder):
    """The path of a scene.yaml with what the dict says, beside the results, and their folder."""
    folder = folder or scene.get("output_folder") or scene.get("output", {}).get("folder")
    if not folder:
        raise RunFailed('The scene names no folder for its results: give folder="out/mine".')
    Path(folder).mkdir(parents=True, exist_ok=True)
    path = Path(folder) / "scene.yaml"
    path.write_text(yaml.safe_dump(scene, sort_keys=False, allow_unicode=True))
    return path, folder


def _folder_of(scene):
    scene = yaml_file.options(scene)
    return scene.get("output_folder") or scene["output"]["folder"]


def _sentence(lines):
    """The program's own line: mpirun frames and follows it with its own."""
    own = [line.strip() for line in lines if line.startswith(("slide:", "error:"))]
    return own[0] if own else "".join(lines).strip()


def _mpi():
    """What Open MPI wants to be told: as root, in a container, it starts nothing unasked."""
    wanted = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1"}
    if os.getuid() == 0:
        wanted.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                      OMPI_MCA_btl_vader_single_copy_mechanism="none")
    return wanted
