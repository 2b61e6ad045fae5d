"""Mistakes in a run of `relocalize`: one sentence that names the option or the file, the fault and the cure, exit code
2 on every rank, no file touched.

SLIPSCALE_RANKS says on how many ranks.
"""

import shutil
import unittest

import numpy as np
from homogenising import RUN as MICRO
from mistakes import RANKS, Mistake, Mistaken
from relocalizing import COMPARED, FILES, HOMOGENEOUS, RUN, Relocalising, centres_of, replace
from running import datasets, h5py
from scenes import SIDE, block


def value(option, wrong, *words, **changes):
    """A value that the option does not take; the sentence must name both."""
    return Mistake([f"-{option} ", str(wrong), *words], {**changes, option: wrong})


def missing(option, *words, **changes):
    return Mistake([f"-{option} ", "needed here but not given", *words], {**changes, option: None})


def run(folder, *words):
    return Mistake(["-relocalize_run", *words], {"relocalize_run": folder})


def tensors(folder, *words, **changes):
    return Mistake(["-relocalize_tensors", *words], {"relocalize_tensors": folder, **changes})


def reference(folder, *words, **changes):
    return Mistake(["-relocalize_reference", *words], {**COMPARED, "relocalize_reference": folder, **changes})


def strip(depth, *words):
    return Mistake(["-relocalize_strip", *words, "a few diameters"],
                   {"relocalize_correction": "strip", "relocalize_strip": depth})


NO_FILE, DAMAGED, SLIDE = "there is no file", "damaged or incomplete", "run slide with"
TORUS = {"relocalize_tensors": "torus"}

MISTAKES = {
    # The homogeneous run
    "no run": missing("relocalize_run", "homogeneous run of slide"),
    "run that is not there": run("absent", NO_FILE, "'absent'", SLIDE),
    "run without frames": run("bare", NO_FILE, "bare/fields.h5", SLIDE),
    "run whose frames are prose": run("prose", "not an HDF5 file", SLIDE),
    "run whose frames are tensors": run("cell/localization.h5", "no /time", "not a fields.h5"),
    "run cut off": run("cut", DAMAGED),
    "frames without strain": run("blind", "has no strain", "-fields_quantities"),
    "run before its first frame": run("young", "no frames yet"),
    "cells without points": run("loose", DAMAGED, "/mesh/cells", "not there"),
    "regions without names": run("nameless", DAMAGED, "names"),
    "statistics cut off": run("unsure", "statistics.h5", DAMAGED),
    "statistics of something else": run("other", "statistics.h5", "no /statistics"),
    # The tensors
    "no tensors": missing("relocalize_tensors", "localization.h5"),
    "tensors that are not there": tensors("absent", NO_FILE, "run homogenize"),
    "tensors of a folder without": tensors("bare", NO_FILE, "bare/localization.h5"),
    "tensors that are frames": tensors("homogeneous/fields.h5", "no /cell/localisation", "not a localization.h5"),
    "tensors that are prose": tensors("prose/fields.h5", "not an HDF5 file"),
    "tensors cut off": tensors("cut", DAMAGED, "run homogenize"),
    "tensors of too few cells": tensors("few", DAMAGED, "/cell/localisation", "shape"),
    "tensors of another block": tensors("wider", "whole block", "homogenise that block"),
    "tensors of the block, moved": tensors("cell", "another -relocalize_origin", relocalize_origin="1e-3,0"),
    "a cell that lacks some of its mesh": tensors("hole", DAMAGED, "the mean of C : A is not /effective/stiffness"),
    "tensors that are not numbers": tensors("nan", DAMAGED, "/cell/localisation", "not a finite number"),
    "tensors of nothing": tensors("zero", DAMAGED, "the mean of /cell/localisation is not the identity"),
    "tensors of a phase that pulls": tensors("negative", DAMAGED, "/region/stiffness", "not positive definite"),
    "tensors of a phase without energy": tensors("unsymmetric", DAMAGED, "/region/stiffness", "not symmetric"),
    "tensors of a point": tensors("point", DAMAGED, "/mesh/coordinates", "on a line"),
    "tensors of no place": tensors("nowhere", DAMAGED, "/mesh/coordinates", "not a finite number"),
    "tensors of more rows than there are": tensors("declared", DAMAGED, "declares more numbers"),
    "tensors of many areas": tensors("list", DAMAGED, "cell_area", "is not one number"),
    "tensors of a condition without words": tensors("empty", DAMAGED, "boundary"),
    "tensors of a cell in another unit": tensors("tiny", "5000 by 5000 copies", "in metres"),
    "statistics whose variances are negative": run("impossible", "statistics.h5", "variance below zero"),
    "statistics of many times": run("times", "statistics.h5", DAMAGED, "is not one number"),
    # The heterogeneous run
    "reference that is not there": reference("absent", NO_FILE, "'absent'"),
    "reference without frames": reference("bare", NO_FILE, "bare/fields.h5"),
    "reference cut off": reference("cut", DAMAGED),
    "reference without stress": reference("dull", "has no stress", "-fields_quantities"),
    "reference at other times": reference("late", "no frame at a time", "-fields_times"),
    "reference of another place": reference("elsewhere", "shares no place", "same block"),
    "reference of other regions": reference("renamed", "-relocalize_tensors knows no region 'fibre'", "alike"),
    "reference with statistics of another window": reference("longer", "5e-06 to 2.2e-05 s", "-statistics_to"),
    "reference with statistics cut off": reference("unsure", "statistics.h5", DAMAGED),
    "no layer": missing("relocalize_layer", **{**COMPARED, "relocalize_layer": None}),
    "no bulk": missing("relocalize_bulk", **{**COMPARED, "relocalize_bulk": None}),
    "layer of nothing": value("relocalize_layer", 0, "> 0", **COMPARED),
    "layer below": value("relocalize_layer", -1e-3, "> 0", **COMPARED),
    "layer of the whole": value("relocalize_layer", SIDE, "0.005 m high", "one cell of the", **COMPARED),
    "bulk of nothing": value("relocalize_bulk", SIDE / 2, "no bulk", "below 0.0025 m", **COMPARED),
    "bulk beyond": value("relocalize_bulk", -1e-3, ">= 0", **COMPARED),
    "layer of no comparison": Mistake(["-relocalize_layer has no effect without -relocalize_reference", "remove it"],
                                      {"relocalize_layer": 1e-3}),
    "bulk of no comparison": Mistake(["-relocalize_bulk has no effect without -relocalize_reference", "remove it"],
                                     {"relocalize_bulk": 1e-3}),
    # Points and origin
    "a point outside": Mistake(["-relocalize_points", "(0.006, 0.001) m lies outside", "into the body"],
                               {"relocalize_points": "1e-3,1e-3,6e-3,1e-3"}),
    "half a point": Mistake(["-relocalize_points", "odd count", "x1,y1"], {"relocalize_points": "1e-3,1e-3,2e-3"}),
    "a point in words": Mistake(["-relocalize_points", "middle"], {"relocalize_points": "middle"}),
    "half an origin": Mistake(["-relocalize_origin has 1 number", "give x,y"], {**TORUS, "relocalize_origin": "1e-3"}),
    "an origin in space": Mistake(["-relocalize_origin has 3 numbers", "give x,y"],
                                  {**TORUS, "relocalize_origin": "1e-3,0,0"}),
    # The correction
    "no strip": missing("relocalize_strip", "depth", relocalize_correction="strip"),
    "strip of nothing": value("relocalize_strip", 0, "> 0", relocalize_correction="strip"),
    "strip below all centres": strip(1e-4, "no cell"),
    "strip of the whole": strip(2 * SIDE, "all cells", "0.005 m high"),
    "strip of tiles that overhang": Mistake(["-relocalize_correction strip", "contact is at y = 0 m", "an edge of"],
                                            {**TORUS, "relocalize_origin": "0,2e-4", "relocalize_correction": "strip",
                                             "relocalize_strip": 2e-3}),
    "strip of frames without contact": Mistake(
        ["-relocalize_correction strip", "from y = 0.001875 m on", "-fields_box"],
        {"relocalize_run": "upper", "relocalize_correction": "strip", "relocalize_strip": 2e-3}),
    "strip without correction": Mistake(["-relocalize_strip has no effect with -relocalize_correction none"],
                                        {"relocalize_strip": 2e-3}),
    # Words and names
    "correction nonsense": value("relocalize_correction", "stripe", "none or strip", "did you mean strip?"),
    "recovery nonsense": value("relocalize_recovery", "node", "element or nodal"),
    "progress nonsense": value("progress", "some", "auto or none"),
    "option misspelt": Mistake(["-relocalize_refernce is not an option", "did you mean -relocalize_reference?"],
                               {"relocalize_refernce": "heterogeneous"}),
    "needed option misspelt": Mistake(["-relocalize_tensor is not an option", "did you mean -relocalize_tensors?"],
                                      {"relocalize_tensors": None, "relocalize_tensor": "cell"}),
    "option misspelt in the file": Mistake(["-relocalize_recover is not an option", "mean -relocalize_recovery?"],
                                           yaml="relocalize: {recover: nodal}\n"),
    "option in capitals": Mistake(["-Relocalize_points differs in capitals", "write -relocalize_points"],
                                  {"Relocalize_points": "1e-3,1e-3"}),
    "option of slide": Mistake(["-time_end is not an option of relocalize"], {"time_end": 1}),
    "option of PETSc that nobody reads": Mistake(["-ksp_rtol was given but neither relocalize nor PETSc has read it"],
                                                 {"ksp_rtol": 1e-8}),
    "value missing": Mistake(["-relocalize_reference has no value"], arguments=["-relocalize_reference"]),
    "equals sign": Mistake(["--relocalize_run=x", "write -relocalize_run x"], arguments=["--relocalize_run=x"]),
    "stray word": Mistake(["'stray' belongs to no option"], arguments=["stray"]),
    "file missing": Mistake(["cannot read 'absent.yaml'"], arguments=["-options_file_yaml", "absent.yaml"]),
    # Folders
    "no folder": missing("output_folder", "relocalized.h5"),
    "folder is a file": Mistake(["-output_folder 'block.msh'", "give a folder"], {"output_folder": "block.msh"}),
    "folder in a file": Mistake(["-output_folder 'block.msh/out'", "give a folder"],
                                {"output_folder": "block.msh/out"}),
    "folder that nobody can make": Mistake(["-output_folder '/proc/slipscale'", "give a folder"],
                                           {"output_folder": "/proc/slipscale"}),
}


def cut(path):
    path.write_bytes(path.read_bytes()[:path.stat().st_size // 2])


class Refusals(Mistaken, Relocalising):
    program, options, files, mistakes = "relocalize", RUN, FILES, MISTAKES

    def setUp(self):
        super().setUp()
        block(self.folder / "block.msh", regions=("matrix", "inclusion"))
        self.make_runs()
        self.run_scene(HOMOGENEOUS, fields_box=f"0,2e-3,{SIDE},{SIDE}", output_folder="upper")
        self.draw_cell(self.folder / "torus.msh")
        self.run_cell(MICRO, mesh_file="torus.msh", output_folder="torus")
        self.material = self.folder / "material"
        self.material.mkdir()
        for name in ("block.msh", "cell", "torus", "homogeneous", "heterogeneous", "upper"):
            shutil.move(self.folder / name, self.material / name)
        for name in ("bare", "prose"):
            (self.material / name).mkdir()
        (self.material / "prose" / "fields.h5").write_text("A run has frames.\n")
        self.spoil_runs()
        self.spoil_tensors()
        self.spoil_references()
        self.spoil_numbers()

    def variant(self, name, source, file):
        """A folder with a file of another, and its path."""
        (self.material / name).mkdir(exist_ok=True)
        return shutil.copy(self.material / source / file, self.material / name / file)

    def without(self, name, source, quantity):
        with h5py.File(self.variant(name, source, "fields.h5"), "r+") as file:
            for frame in file["frames"].values():
                del frame[quantity]

    def spoil_runs(self):
        cut(self.variant("cut", "homogeneous", "fields.h5"))
        self.without("blind", "homogeneous", "strain")
        replace(self.variant("young", "homogeneous", "fields.h5"), "time", np.zeros(0))
        loose = self.variant("loose", "homogeneous", "fields.h5")
        replace(loose, "mesh/cells", datasets(loose)["mesh/cells"] + 1)
        with h5py.File(self.variant("nameless", "homogeneous", "fields.h5"), "r+") as file:
            del file["mesh/region"].attrs["names"]
        for name, source in (("unsure", "statistics.h5"), ("other", "fields.h5")):
            self.variant(name, "homogeneous", "fields.h5")
            shutil.copy(self.material / "homogeneous" / source, self.material / name / "statistics.h5")
        cut(self.material / "unsure" / "statistics.h5")

    def spoil_tensors(self):
        cut(self.variant("cut", "cell", "localization.h5"))
        few = self.variant("few", "cell", "localization.h5")
        replace(few, "cell/localisation", datasets(few)["cell/localisation"][:-1])
        with h5py.File(self.variant("wider", "cell", "localization.h5"), "r+") as file:
            file["mesh/coordinates"][:, 0] *= 1.001
        hole = self.variant("hole", "torus", "localization.h5")
        found = datasets(hole)
        x = centres_of(found)
        kept = np.linalg.norm(x - x.mean(axis=0), axis=1) > 2e-4
        for name, rows in (("mesh/cells", found["mesh/cells"]), ("mesh/region", found["cell/region"]),
                           ("cell/localisation", found["cell/localisation"])):
            replace(hole, name, rows[kept])

    def spoil_numbers(self):
        """Whole files with contents that cannot be."""
        def spoiled(name, source="cell"):
            return h5py.File(self.variant(name, source, "localization.h5"), "r+")
        with spoiled("nan") as file:
            file["cell/localisation"][3, 1, 1] = np.nan
        with spoiled("zero") as file:
            file["cell/localisation"][...] = 0
        with spoiled("negative") as file:
            file["region/stiffness"][0] *= -1
        with spoiled("unsymmetric") as file:
            file["region/stiffness"][0, 0, 1] *= 2
        with spoiled("point") as file:
            file["mesh/coordinates"][...] = 1e-3
        with spoiled("nowhere") as file:
            file["mesh/coordinates"][5] = np.nan
        with spoiled("declared") as file:
            kept = dict(file["cell/localisation"].attrs)
            del file["cell/localisation"]
            file.create_dataset("cell/localisation", (10**12, 3, 3), "f8", chunks=(64, 3, 3)).attrs.update(kept)
        with spoiled("list") as file:
            del file["effective/stiffness"].attrs["cell_area"]
            file["effective/stiffness"].attrs["cell_area"] = np.zeros(7000)
        with spoiled("empty") as file:
            del file["effective/stiffness"].attrs["boundary"]
            file["effective/stiffness"].attrs["boundary"] = h5py.Empty("S8")
        with spoiled("tiny", "torus") as file:
            file["mesh/coordinates"][...] *= 1e-3
            file["effective/stiffness"].attrs["cell_area"] *= 1e-6
        for name in ("impossible", "times"):
            self.variant(name, "homogeneous", "fields.h5")
            with h5py.File(self.variant(name, "homogeneous", "statistics.h5"), "r+") as file:
                if name == "times":
                    del file["statistics"].attrs["from"]
                    file["statistics"].attrs["from"] = np.zeros(7000)
                else:
                    file["statistics/strain/covariance"][2, :3] *= -1

    def spoil_references(self):
        self.without("dull", "heterogeneous", "stress")
        with h5py.File(self.variant("late", "heterogeneous", "fields.h5"), "r+") as file:
            file["time"][...] += 0.5 * file["time"][1]
        with h5py.File(self.variant("elsewhere", "heterogeneous", "fields.h5"), "r+") as file:
            file["mesh/coordinates"][...] += 2 * SIDE
        with h5py.File(self.variant("renamed", "heterogeneous", "fields.h5"), "r+") as file:
            file["mesh/region"].attrs["names"] = np.array([b"matrix", b"fibre"])
        self.variant("longer", "heterogeneous", "fields.h5")
        with h5py.File(self.variant("longer", "heterogeneous", "statistics.h5"), "r+") as file:
            file["statistics"].attrs["to"] = 1.1 * file["statistics"].attrs["to"]

    def check_without_mistakes(self):
        """What the mistakes are made of is sound."""
        shutil.copytree(self.material, self.folder, dirs_exist_ok=True)
        self.run_relocalize(**COMPARED, ranks=RANKS)
        self.run_relocalize(**COMPARED, **TORUS, relocalize_origin="1e-4,2e-4", ranks=RANKS)


if __name__ == "__main__":
    unittest.main()
