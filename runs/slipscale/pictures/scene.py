"""A scene before it is run: morphology with scale and axes, boundary conditions, the surface that moves, probe points.

    slipscale scene scene.yaml scene.png [--mesh block.msh] [--set boundary_top_y=-2e-6]
    slipscale scene out/first scene.png          the scene of a run, from its run.yaml

The first argument is the YAML file that slide is given, or the folder of a run. Exits with code 2 and one sentence when
there is nothing to draw.
"""

from pathlib import Path

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.patches import Patch, Rectangle

from slipscale.mistakes import Mistake
from slipscale.parser import Parser
from slipscale.pictures.colours import BLACK, BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILION
from slipscale.pictures.drawing import length_unit, plt, write_picture
from slipscale.reading import Summary, yaml_file
from slipscale.reading.gmsh_mesh import read_gmsh_mesh
from slipscale.running.attempt import number_or_text
from slipscale.running.commands import flat

SHADES = ("#E8E3D8", "#7F9DB9", "#D9A37A", "#9BBF9B", "#C7A6C9", "#B9B48F")
LOADS = {"pressure": "p", "shear": "τ"}  # what a curve may carry, in Pa
SIDES = {"x": "$u_x$", "y": "$u_y$"}


class Scene:
    """Flat `options` of slide, and the `mesh`."""

    def __init__(self, source, mesh=None, changes=None):
        source = Path(source)
        self.name = source.name if source.is_file() else str(source)
        given = Summary(source).options if source.is_dir() else yaml_file.options(source)
        if not given:
            raise Mistake(f"There is no run.yaml in {source}: give a scene, or the output folder of a `slide` run.")
        self.options = {**{name: value for name, value in flat(given).items() if not name.startswith("run_")},
                        **(changes or {})}
        file = mesh or self.options.get("mesh_file")
        if not file:
            raise Mistake(f"{source} names no mesh: give it with --mesh.")
        self.mesh = read_gmsh_mesh(found_near(file, source))

    def number(self, name):
        value = self.options.get(name)
        try:
            return None if value is None else float(value)
        except (TypeError, ValueError):
            return None

    def conditions(self, curve):
        """What stands for one curve: a dict x, y, pressure, shear, … of the values given."""
        prefix = f"boundary_{curve}_"
        longer = [f"boundary_{other}_" for other in self.mesh.curves if other.startswith(curve) and other != curve]
        return {name[len(prefix):]: value for name, value in self.options.items()
                if name.startswith(prefix) and not any(name.startswith(other) for other in longer)}

    def points(self):
        """Probe points [n, 2] m."""
        values = self.options.get("history_points") or []
        values = values.split(",") if isinstance(values, str) else values
        return np.array([float(value) for value in values]).reshape(-1, 2)


def found_near(file, source):
    """The file from here, or from the folder of the scene or one above it, as a run started elsewhere names it."""
    places = [Path(file), *(folder / file for folder in Path(source).resolve().parents)]
    return next((place for place in places if place.is_file()), places[0])


def engineering(value, unit):
    """A value with a prefix, as 1.2 µm."""
    for size, prefix in ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n")):
        if abs(value) >= 0.9999 * size:
            return f"{value / size:.4g} {prefix}{unit}".replace("-", "−")
    return f"{value:.4g} {unit}"


def by_size(mesh):
    """Numbers of the regions, the largest first."""
    return sorted(range(len(mesh.region_names)), key=lambda k: -share_of(mesh, k))


def condition_words(conditions):
    """What a curve is held by or carries, as text; '' when it is free."""
    said = []
    for side, symbol in SIDES.items():
        value = number_or_text(str(conditions.get(side, "free")))
        if value == "fixed":
            said.append(f"{symbol} held")
        elif isinstance(value, (int, float)):
            said.append(f"{symbol} = {engineering(value, 'm')}")
        elif value not in ("free", None):
            said.append(f"{symbol} {value}")
    for load, symbol in LOADS.items():
        value = number_or_text(str(conditions.get(load, 0)))
        if isinstance(value, (int, float)) and value:
            said.append(f"{symbol} = {engineering(value, 'Pa')}")
        elif isinstance(value, str):  # a formula
            said.append(f"{symbol} = {value}")
    known = {*SIDES, *LOADS, "ramp"}
    said += [f"{name} {value}" for name, value in conditions.items() if name not in known]
    ramp = number_or_text(str(conditions.get("ramp", 0)))
    ramped = said and isinstance(ramp, (int, float)) and ramp
    return ", ".join(said) + (f", within {engineering(ramp, 's')}" if ramped else "")


def draw_regions(axes, mesh, scale):
    for k, region in enumerate(by_size(mesh)):
        cells = mesh.triangles[mesh.region == region]
        axes.tripcolor(*(mesh.coordinates.T * scale), cells, facecolors=np.zeros(len(cells)), rasterized=True,
                       cmap=plt.matplotlib.colors.ListedColormap([SHADES[k % len(SHADES)]]))
    axes.add_collection(LineCollection(mesh.outlines() * scale, colors=BLACK, linewidths=0.6))


def share_of(mesh, k):
    """Part of the area that a region has."""
    a, b, c = (mesh.coordinates[mesh.triangles[:, corner]] for corner in range(3))
    area = np.abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    return area[mesh.region == k].sum() / area.sum()


def material_words(scene, name):
    for region in (name, "all"):
        found = {part: scene.number(f"material_{region}_{part}") for part in ("young", "poisson", "density")}
        if found["young"]:
            return f"E = {engineering(found['young'], 'Pa')}, ν = {found['poisson']:g}"
    measured = any(name.endswith("_file") and name.startswith("material") for name in scene.options)
    return "effective material" if measured else ""


def draw_curves(axes, scene, scale, size, bottom):
    """The named curves in colours, with what holds or loads them beside."""
    low, high = scene.mesh.coordinates.min(axis=0) * scale, scene.mesh.coordinates.max(axis=0) * scale
    colours = (VERMILION, BLUE, GREEN, PURPLE, ORANGE, SKY)
    for k, (name, edges) in enumerate(scene.mesh.curves.items()):
        colour = colours[k % len(colours)]
        segments = scene.mesh.coordinates[edges] * scale
        axes.add_collection(LineCollection(segments, colors=colour, linewidths=3, zorder=4))
        middle = segments.reshape(-1, 2).mean(axis=0)
        said = condition_words(scene.conditions(name)) or ("contact" if name == bottom else "free")
        # On the outer side on which the middle of the curve lies.
        away = (middle - low) / (high - low) - 0.5
        flat_side = abs(away[1]) >= abs(away[0])
        sign = 1.0 if away[1 if flat_side else 0] >= 0 else -1.0
        offset = (0, sign * (14 if sign > 0 else 4)) if flat_side else (sign * 10, 0)
        if name == bottom:
            axes.annotate(f"{name}: {said}", middle + (0.25 * (high[0] - low[0]), 0), (0, 8),
                          textcoords="offset points", ha="center", va="bottom",
                          color=colour, zorder=5, bbox={"facecolor": "white", "alpha": 0.8, "linewidth": 0, "pad": 1})
            continue
        axes.annotate(f"{name}: {said}", middle, offset, textcoords="offset points", color=colour, zorder=5,
                      ha="center", va="bottom" if flat_side and sign > 0 else "top" if flat_side else "center",
                      rotation=0 if flat_side else 90)


def draw_surface(axes, scene, scale, size):
    """The rigid surface below, and where it goes."""
    height = (scene.number("surface_height") or 0.0) * scale
    speed = scene.number("surface_speed")
    left, right = scene.mesh.coordinates[:, 0].min() * scale, scene.mesh.coordinates[:, 0].max() * scale
    thick = 0.05 * size
    axes.add_patch(Rectangle((left - 0.08 * size, height - thick), right - left + 0.16 * size, thick, facecolor="0.85",
                             edgecolor="0.4", hatch="////", linewidth=0.8))
    axes.plot([left - 0.08 * size, right + 0.08 * size], [height, height], color=BLACK, linewidth=1.2)
    if speed:
        middle, reach = 0.5 * (left + right), 0.18 * (right - left) * np.sign(speed)
        axes.annotate("", (middle + reach, height - 1.9 * thick), (middle - reach, height - 1.9 * thick),
                      arrowprops={"arrowstyle": "-|>", "color": BLACK, "linewidth": 1.8})
        axes.annotate(f"V = {abs(speed):g} m/s", (middle, height - 2.3 * thick), ha="center", va="top")
    axes.set_ylim(bottom=height - 4 * thick)


def scale_bar(axes, low, high, unit):
    """A fifth of the width or so, in a round number."""
    length = 0.2 * (high[0] - low[0])
    power = 10.0**np.floor(np.log10(length))
    length = power * max(step for step in (1, 2, 5) if step * power <= length * 1.0001)
    place = high[1] + 0.17 * (high[1] - low[1])
    axes.plot([low[0], low[0] + length], [place, place], color=BLACK, linewidth=3, solid_capstyle="butt", clip_on=False)
    axes.annotate(f"{length:g} {unit}", (low[0] + 0.5 * length, place), (0, 4), textcoords="offset points", ha="center",
                  annotation_clip=False)


def friction_words(scene):
    """The law and its numbers."""
    law = scene.options.get("friction_law", "none")
    numbers = [f"{symbol} = "
               f"{engineering(scene.number(f'friction_{name}'), unit) if unit else scene.number(f'friction_{name}')}"
               for name, symbol, unit in (("coefficient", "µ", ""), ("length", "L*", "m"), ("time", "T", "s"))
               if scene.number(f"friction_{name}") is not None]
    return f"friction: {law}" + (f", {', '.join(numbers)}" if numbers else "")


def draw(scene):
    """The figure of a Scene."""
    mesh = scene.mesh
    scale, unit = length_unit(mesh.coordinates)
    low, high = mesh.coordinates.min(axis=0) * scale, mesh.coordinates.max(axis=0) * scale
    size = max(high - low)
    wide, tall = high - low
    figure, axes = plt.subplots(figsize=(10.5, min(13.0, max(5.0, 10.5 * tall / wide + 2.2))), layout="constrained")
    draw_regions(axes, mesh, scale)
    bottom = scene.options.get("surface_boundary")
    draw_curves(axes, scene, scale, size, bottom)
    axes.set_aspect("equal")
    axes.set_xlim(low[0] - 0.12 * size, high[0] + 0.12 * size)
    axes.set_ylim(low[1] - 0.08 * size, high[1] + 0.26 * tall)
    if bottom:
        draw_surface(axes, scene, scale, size)
    scale_bar(axes, low, high, unit)
    for k, point in enumerate(scene.points() * scale):
        axes.plot(*point, "o", color="white", markeredgecolor=BLACK, markersize=7, zorder=6, clip_on=False)
        axes.annotate("M" if k == 0 else f"{k}", point, (7, 6), textcoords="offset points", fontweight="bold", zorder=6)
    for letter, step in (("x", (0.1 * size, 0)), ("y", (0, 0.1 * size))):
        axes.annotate("", low + step, low, zorder=7, arrowprops={"arrowstyle": "-|>", "color": BLACK, "linewidth": 1.8})
        axes.annotate(letter, low + step, (4, 6), textcoords="offset points", fontweight="bold", zorder=7)
    axes.set(xlabel=f"x [{unit}]", ylabel=f"y [{unit}]")
    handles = [Patch(facecolor=SHADES[k % len(SHADES)], edgecolor=BLACK,
                     label=", ".join(filter(None, [f"{name} {100 * share_of(mesh, region):.3g} %",
                                                   material_words(scene, name)])))
               for k, (region, name) in enumerate([(region, mesh.region_names[region])
                                                   for region in by_size(mesh)][:8])]
    figure.legend(handles=handles, loc="lower center", ncol=2 if len(handles) > 1 else 1, frameon=False)
    figure.supxlabel(" \n" * (1 + len(handles) // 3))  # room for it
    figure.suptitle(f"{scene.name}: {len(mesh.triangles)} triangles, {len(mesh.coordinates)} nodes\n"
                    f"{friction_words(scene)}", fontsize="large", fontweight="bold")
    return figure


def main(arguments=None):
    parser = Parser("scene", __doc__)
    parser.add_argument("scene", help="YAML file of options of slide, or the folder of a run")
    parser.add_argument("--mesh", help="in place of the scene's mesh_file")
    parser.add_argument("--set", action="append", default=[], metavar="OPTION=VALUE",
                        help="in place of the scene's own")

    def figure(options):
        changes = {name: number_or_text(value) for name, _, value in (word.partition("=") for word in options.set)}
        return draw(Scene(options.scene, options.mesh, changes))

    return write_picture(parser, figure, arguments)
