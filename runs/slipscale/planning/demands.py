"""What wishes demand of scene, mesh and pilots, so that what cannot be told is said as early as it is known. All raise
Mistake."""

import difflib

from slipscale.mistakes import Mistake
from slipscale.planning.wishes import STRESS
from slipscale.reading import read_yaml

OF_POINT = ("displacement", "displacement_deviation", "velocity", "trajectory_displacement", "trajectory_velocity",
            "portrait")
OF_SURFACE = ("stick", "slip", "open", "power_into_body", "drive_power", "power_ratio")


def of_scene(wishes, scene, before=None):
    """`scene`: flat options of slide; `before`: the window of trajectories, s."""
    for wish in wishes:
        if wish.kind == "trajectory" and not before:
            raise Mistake(f"{wish.name} is compared over a window before squeal saturates: give it, --before FROM TO, s")
        if wish.name in OF_POINT and scene.get("history_points") in (None, "", []):
            raise Mistake(f"{wish.name} is that of a probe point, and the scene has none: name one, as "
                          "-history_points 2.5e-3,0")
        if wish.name in OF_SURFACE and "surface_boundary" not in scene:
            raise Mistake(f"{wish.name} is that of a contact, and the scene has no surface_boundary")


def of_regions(wishes, known):
    """`known`: names of the mesh's regions."""
    for wish in wishes:
        region = wish.name.removeprefix(STRESS)
        if wish.kind == "stress" and region not in known:
            near = difflib.get_close_matches(region, known, 1, 0.6)
            raise Mistake(f"there is no region {region}, whose stress is wished for: the mesh has {', '.join(known)}" +
                          (f"; is {STRESS}{near[0]} meant?" if near else ""))


def of_size(wish, size):
    """`size`: of the result, as pilots found it: what is allowed has to be less."""
    if wish.allowed(size) >= 1:
        raise Mistake(f"{wish} is no less than the result itself, which is {size:.3g} in the pilot runs: is "
                      f"{wish.name}:{wish.absolute:g}% meant?")


def regions_of(folder):
    """Of a mesh that morphology left in a folder."""
    return list(read_yaml(folder / "morphology.yaml")["run"]["fraction"])


if __name__ == "__main__":
    raise SystemExit("slipscale.planning.demands is a library, no command: slipscale -h lists the commands.")
