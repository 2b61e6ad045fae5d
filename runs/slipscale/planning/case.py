"""What is planned: a scene of `slide` and a recipe of `morphology`, at any size, with what they say about waves, memory and
the smallest thing that the mesh has to show."""

import math
from dataclasses import dataclass, field
from pathlib import Path

from slipscale.measuring.window import backwards
from slipscale.mistakes import Mistake
from slipscale.planning.costs import damped
from slipscale.reading import yaml_file
from slipscale.running.commands import flat

SAFETY = 0.9  # of slide
HISTORY_ROWS = 8000  # of a run whose scene counts rows in steps
LONGER_STEP = 1.3  # than expected from the largest element: at most, between rows of the history
ACROSS_HEIGHT, ACROSS_FEATURE, ACROSS_MEMORY = 10, 2.5, 2  # cells, at least: c_s T over 2 cells, or a spurious mode grows
GAP = 0.15  # of the smallest inclusion: between inclusions, of a recipe that gives neither gaps nor a size that they follow
SEPARATE = ("history_every", "time_step", "mesh_file", "mesh_refine", "output_folder", "progress")
GAPS = ("gap", "clearance")
OUTPUTS = ("fields_", "statistics_", "contact_", "checkpoint_")


def numbers(text):
    """Of a list, or of what stands for one on a command line."""
    return [float(part) for part in (text if isinstance(text, (list, tuple)) else str(text).split(","))]


def speeds(options):
    """(c_d, c_s) m/s of each region of a scene, a dict, along y. Raises Mistake."""
    found = {}
    for region in sorted({name.removeprefix("material_").rsplit("_", 1)[0] for name in options
                          if name.startswith("material_") and name != "material_file"} |
                         ({"all"} if "material_file" in options else set())):
        def given(what):
            return options.get(f"material_{region}_{what}", options.get("material_file") if region == "all" and
                               what == "file" else None)
        try:
            density = given("density")
            if given("file") is not None:
                effective = flat(yaml_file.load(given("file"), written=True))
                stiffness, density = numbers(effective["stiffness"]), density or effective["density"]
            elif given("stiffness") is not None:
                stiffness = numbers(given("stiffness"))
            else:
                young, poisson = float(given("young")), float(given("poisson"))
                shear = young / 2 / (1 + poisson)
                stiffness = [0, 0, 2 * shear * (1 - poisson) / (1 - 2 * poisson), shear]
            found[region] = math.sqrt(stiffness[2] / float(density)), math.sqrt(stiffness[3] / float(density))
        except (KeyError, TypeError, ValueError, IndexError) as error:
            raise Mistake(f"the scene does not say, in numbers, young, poisson and density of {region}, its stiffness, "
                          "or a file of them") from error
    if not found:
        raise Mistake("the scene names no material: give material: {all: {young, poisson, density}}")
    return found


@dataclass
class Case:
    """scene and recipe: flat options. window: of the averages, s; before: of trajectories, s, or None. cells: kinds that
    are tried."""

    scene: dict
    recipe: dict
    window: tuple
    before: tuple | None
    cells: list
    speeds: dict = field(default_factory=dict)

    @property
    def end(self):
        return max(self.window[1], self.before[1] if self.before else 0)

    @property
    def safety(self):
        return float(self.scene.get("time_safety", SAFETY))

    @property
    def fastest(self):
        return max(fast for fast, _ in self.speeds.values())

    @property
    def slowest_shear(self):
        return min(slow for _, slow in self.speeds.values())

    @property
    def damping(self):
        return float(self.scene.get("damping_stiffness", 0))

    @property
    def is_random(self):
        return (self.recipe.get("shape") not in ("none", "laminate", "image", None) or "families" in str(self.recipe)) \
            and self.recipe.get("arrangement", "random") == "random"

    @property
    def is_strip(self):
        return str(self.recipe.get("microstructure_height", "none")) != "none"

    @property
    def memory(self):
        """Relaxation time of friction, s; None where there is none to resolve."""
        return memory_of(self.scene)

    def longest_size(self):
        """The coarsest cells that show what there is, m, and what demands them."""
        height, width = (number(self.recipe, f"block_{side}") for side in ("height", "width"))
        found = [(min(height, width) / ACROSS_HEIGHT, f"{ACROSS_HEIGHT} cells across the block")]
        if feature := self.feature():
            found.append((feature / ACROSS_FEATURE, f"{ACROSS_FEATURE:g} cells across an inclusion"))
        if "layer_period" in self.recipe:
            found.append((0.5 * float(self.recipe["layer_period"]) / ACROSS_FEATURE,
                          f"{ACROSS_FEATURE:g} cells across a layer"))
        if self.memory:
            found.append((self.memory_size(), "friction's memory, c_s T over two cells"))
        return min(found)

    def feature(self):
        """The smallest inclusion, across it, m; None without any."""
        return min((number(self.recipe, name) / float(self.recipe.get("aspect", 1)) for name in self.recipe
                    if name == "diameter" or name.endswith("_diameter")), default=None)

    def gap(self):
        """What gaps are that the recipe leaves open, m: they would follow the size, and every size have a drawing of its
        own. None where nothing is open."""
        if not self.is_random or all(str(self.recipe.get(name, "auto")) != "auto" for name in GAPS):
            return None
        return float(self.recipe["size"]) if "size" in self.recipe else GAP * self.feature() if self.feature() else None

    def memory_size(self):
        """The largest cells of which c_s T spans two, m."""
        return self.slowest_shear * self.memory / ACROSS_MEMORY

    def recipe_of(self, cell, size, seed=None):
        """Options of morphology at a size, m. What else the recipe says about sizes keeps its ratio to it."""
        own = float(self.recipe.get("size", size))
        found = {name: value for name, value in self.recipe.items() if name not in ("output_folder", "structured")}
        for name in ("size_interface", "size_surface"):
            value = found.pop(name, "auto")
            if cell != "grid" and value != "auto":
                found[name] = float(f"{float(value) * size / own:.9g}")
        if cell == "grid":
            found.pop("size_growth", None)
        found.update(cell=cell, size=float(f"{size:.9g}"))
        if seed is not None:
            found["seed"] = seed
        if gap := self.gap():
            found.update({name: gap for name in GAPS if str(found.get(name, "auto")) == "auto"})
        return found

    def scene_of(self, windows=1.0, interval=None):
        """Options of slide, without mesh and folder, with a window so many times as long."""
        found = {name: value for name, value in self.scene.items() if name not in SEPARATE}
        found["time_end"] = max(self.window[0] + windows * (self.window[1] - self.window[0]),
                                self.before[1] if self.before else 0)
        found["history_interval"] = interval or self.interval()
        return found

    def interval(self, longest_step=0.0):
        """Between rows of the history, s: no shorter than a step."""
        own = self.scene.get("history_interval")
        return max(float(own) if own else self.end / HISTORY_ROWS, LONGER_STEP * longest_step)

    def step_of(self, step_length, safety):
        """Step from the `step_length` in morphology's report, s: it is that of the fastest waves."""
        return safety * damped(step_length / self.fastest, self.damping)


def memory_of(scene):
    """Relaxation time of friction, s, the shortest of a slip rate; None where there is no friction."""
    if scene.get("friction_law", "none") == "none" or "surface_boundary" not in scene:
        return None
    if str(scene.get("friction_coefficient", 1)) in ("0", "0.0"):
        return None
    if scene["friction_law"] == "coulomb":
        return 0.0
    if "friction_time" in scene:
        return float(scene["friction_time"])
    if "friction_length" not in scene:
        raise Mistake("the scene gives friction neither a time nor a length of memory")
    try:
        speed = abs(float(scene["surface_speed"])) + float(scene.get("friction_rate_reference", 0) or 0)
    except (KeyError, ValueError) as error:
        raise Mistake("the memory of friction is a length and the speed of the surface no number: give friction_time, so "
                      "that c_s T can be held against the cells") from error
    return float(scene["friction_length"]) / speed if speed > 0 else math.inf


def number(options, name):
    """An option as a float. Raises Mistake."""
    try:
        return float(options[name])
    except (TypeError, ValueError) as error:
        raise Mistake(f"{name} is {options[name]!r}, and plan needs a number there") from error


def case_of(scene, recipe, window=None, before=None, cells=None):
    """The Case of flat options. Raises Mistake."""
    for name in ("block_width", "block_height"):
        if name not in recipe:
            raise Mistake(f"the recipe has no {name}, without which no mesh can be drawn at several sizes")
    if "time_end" not in scene:
        raise Mistake("the scene has no time_end, from which the window of averages is taken")
    end = number(scene, "time_end")
    window = tuple(window or (0.5 * end, end))
    for name, asked in (("--window", window), ("--before", before)):
        if asked and (wrong := backwards(asked)):
            raise Mistake(f"{name} {wrong}")
        if asked and asked[0] < 0:
            raise Mistake(f"{name} begins at {asked[0]:g} s, before the run")
    if recipe.get("shape") == "image":
        cells = ["grid"]
    return Case(scene, recipe, window, tuple(before) if before else None, cells or ["grid", "triangle"], speeds(scene))


def with_stress(options, regions, window, strip=False):
    """Options with frames of the von Mises stress over the window, for results that are quantiles of it; of the stress
    in the plane where a `strip` of microstructure lies below a homogenised region."""
    if not regions:
        return options
    kept = {name: value for name, value in options.items() if not name.startswith("fields_")}
    return {**kept, "fields_interval": float(f"{(window[1] - window[0]) / 100:.6g}"),
            "fields_quantities": "stress" if strip else "von_mises"}


def found_files(options, folder):
    """Options whose files are named from where they are, absolute."""
    return {name: str((folder / value).resolve()) if name.endswith("_file") and (folder / str(value)).is_file()
            else value for name, value in options.items()}


def options_of(path):
    """The flat options of a file, files found from here. Raises Mistake."""
    return found_files(flat(yaml_file.options(path)), Path())


if __name__ == "__main__":
    raise SystemExit("slipscale.planning.case is a library, no command: slipscale -h lists the commands.")
