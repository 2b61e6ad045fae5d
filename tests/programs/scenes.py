"""Small blocks of layers, meshed by gmsh, and the scene in which one of them squeals."""

import subprocess

SIDE = 5e-3  # m

# A homogeneous block that sticks, slips and separates (scene R of the verification tests, pressed down within 2 us so
# that it does so at once).
SQUEAL = {
    "mesh_file": "block.msh",
    "material_all_young": 45e9, "material_all_poisson": 0.25, "material_all_density": 1800,
    "surface_boundary": "bottom", "surface_speed": 2,
    "friction_law": "regularized", "friction_coefficient": 0.5, "friction_time": 0.6e-6,
    "friction_threshold": "regularized",
    "boundary_top_x": "fixed", "boundary_top_y": -1.3888888888888889e-6, "boundary_top_ramp": 2e-6,
    "damping_stiffness": 2e-9,
    "time_end": 40e-6,
    "history_every": 5, "history_points": "2.5e-3,0,1.3e-3,2.2e-3",
}


def block(path, regions=("block",), cells="quadrilaterals", divisions=8, periodic=False, depth=0, names=True,
          form="msh41"):
    """Writes a block of SIDE x SIDE m with one layer for each region, the first at the bottom.

    `cells`: quadrilaterals, triangles or mixed (every other layer triangles); `divisions` along an edge; `depth` > 0
    makes it three-dimensional. Boundaries: bottom, top, left, right.
    """
    layers = len(regions)
    lines = []
    for k in range(layers + 1):
        y = SIDE * k / layers
        lines += [f"Point({2 * k + 1}) = {{0, {y}, 0}};", f"Point({2 * k + 2}) = {{{SIDE}, {y}, 0}};",
                  f"Line({100 + k}) = {{{2 * k + 1}, {2 * k + 2}}};"]
    for k in range(layers):
        lines += [f"Line({200 + k}) = {{{2 * k + 1}, {2 * k + 3}}};",
                  f"Line({300 + k}) = {{{2 * k + 2}, {2 * k + 4}}};",
                  f"Curve Loop({k + 1}) = {{{100 + k}, {300 + k}, -{101 + k}, -{200 + k}}};",
                  f"Plane Surface({k + 1}) = {{{k + 1}}};"]
        if cells == "quadrilaterals" or (cells == "mixed" and k % 2 == 0):
            lines.append(f"Recombine Surface{{{k + 1}}};")
    lines += [f"Transfinite Curve{{100:{100 + layers}}} = {divisions + 1};",
              f"Transfinite Curve{{200:{199 + layers}, 300:{299 + layers}}} = {divisions // layers + 1};",
              f"Transfinite Surface{{1:{layers}}};"]
    if periodic:
        lines.append(f"Periodic Curve{{300:{299 + layers}}} = {{200:{199 + layers}}} Translate{{{SIDE}, 0, 0}};")
    if depth:
        lines.append(f"Extrude{{0, 0, {depth}}}{{Surface{{1}}; Layers{{2}}; Recombine;}}")
        lines.append('Physical Volume("volume") = {1};')
    if names:
        lines += [f'Physical Surface("{region}") = {{{k + 1}}};' for k, region in enumerate(regions)]
        lines += ['Physical Curve("bottom") = {100};', f'Physical Curve("top") = {{{100 + layers}}};',
                  f'Physical Curve("left") = {{200:{199 + layers}}};',
                  f'Physical Curve("right") = {{300:{299 + layers}}};']
    geometry = path.with_suffix(".geo")
    geometry.write_text("\n".join(lines) + "\n")
    subprocess.run(["gmsh", "-v", "1", "-3" if depth else "-2", "-format", form, geometry, "-o", path], check=True,
                   stdin=subprocess.DEVNULL)
    geometry.unlink()
