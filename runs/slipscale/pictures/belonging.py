"""Whether the three runs of a picture of relocalised stress belong together: refused, or said in its title."""

import numpy as np

from slipscale.reading import Summary, UnreadableRun

SAME_SIZE = 1e-6  # of the block's width: edges that lie as near are the same
# Options that make runs comparable.
OF_A_SCENE = ("surface_", "friction_", "boundary_", "initial_", "body_", "damping_")


def extent(file):
    return file.coordinates.min(axis=0), file.coordinates.max(axis=0)


def check_blocks(files, folders):
    """Raises UnreadableRun when two blocks are not the same rectangle."""
    own = extent(files[0])
    size = np.ptp(files[0].coordinates, axis=0).max()
    for file, folder in zip(files[1:], folders[1:]):
        if max(np.abs(a - b).max() for a, b in zip(own, extent(file))) > SAME_SIZE * size:
            raise UnreadableRun(f"The block of {folder} is not that of {folders[0]}: {in_words(file)} against "
                                f"{in_words(files[0])}; give runs of one block.")


def in_words(file):
    (left, low), (right, high) = extent(file)
    return f"{left:.6g} to {right:.6g} m by {low:.6g} to {high:.6g} m"


def same_morphology(relocalised, reference):
    """Whether both lie on the same cells of the same regions: by the checksums of their meshes, else by the corners of
    each cell, whatever their numbers: `relocalize` numbers points anew."""
    sums = [file.mesh_checksum for file in (relocalised, reference)]
    if all(sums) and sums[0] == sums[1]:
        return True
    size = np.ptp(reference.coordinates, axis=0).max()
    return (relocalised.region.shape == reference.region.shape
            and relocalised.triangles.shape == reference.triangles.shape
            and np.abs(corners(relocalised) - corners(reference)).max() <= SAME_SIZE * size
            and names_of(relocalised) == names_of(reference))


def corners(file):
    """Where those of each triangle are, [nt, 3, 2] m."""
    return file.coordinates[file.triangles]


def names_of(file):
    """The name of the region of each cell."""
    return [file.region_names[k] if k < len(file.region_names) else k for k in file.region]


def other_scene(reference, homogeneous):
    """Options of load, friction and so on that both runs have and in which they differ, as text; '' if there are
    none."""
    own, other = (Summary(folder).options for folder in (reference, homogeneous))
    changed = [f"{name} {own[name]} and {other[name]}" for name in own
               if name.startswith(OF_A_SCENE) and name in other and own[name] != other[name]]
    return ", ".join(changed[:3]) + (" …" if len(changed) > 3 else "")


def notes(files, folders):
    """What a picture of (reference, relocalised, homogeneous) has to say: a list of sentences, and whether the
    relocalised stress can be called an error. Raises UnreadableRun for runs of different blocks."""
    check_blocks(files, folders)
    said, same = [], same_morphology(files[1], files[0])
    if not same:
        said.append("relocalised on another morphology than the heterogeneous run's: differences, not errors")
    if changed := other_scene(folders[0], folders[2]):
        said.append(f"heterogeneous and homogeneous run differ: {changed}")
    return said, same and not changed
