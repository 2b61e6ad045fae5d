"""The picture of `slipscale wear`: profile of the depth over its phases, depth over time, flash temperature."""

import numpy as np
from matplotlib.patches import Patch

from slipscale.measuring.window import MICRO
from slipscale.pictures.colours import BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILION
from slipscale.pictures.drawing import plt, shown
from slipscale.pictures.panels import edges_between

LAWS = {"archard": ("Archard", BLUE, "-"), "energy": ("by energy", VERMILION, "--")}
UNITS = ((1e-3, "mm"), (1e-6, "µm"), (1e-9, "nm"), (1e-12, "pm"))
PHASES = ("#F0E9DC", SKY, GREEN, ORANGE, PURPLE)


def draw(folder, worn):
    """The figure of a Worn; as many panels as there is something to draw in."""
    panels = [profile] * bool(worn.depth) + [history] * bool(worn.depth) + (
        [flash_map] if worn.temperature is not None else [])
    figure, axes = plt.subplots(1, len(panels), figsize=(6 * len(panels), 5), layout="constrained", squeeze=False)
    for panel, place in zip(panels, axes[0], strict=True):
        panel(place, figure, worn)
    figure.suptitle(f"{shown(folder)}: {worn.time[0] * MICRO:.4g} to {worn.time[-1] * MICRO:.4g} µs", fontsize="large",
                    fontweight="bold")
    return figure


def depth_unit(worn):
    """A factor from metres and the name of the unit that suits the largest depth."""
    most = max((values[-1].max() for values in worn.depth.values()), default=0)
    return next(((1 / metres, name) for metres, name in UNITS if most >= 0.999 * metres), (1 / UNITS[-1][0], UNITS[-1][1]))


def profile(axes, _, worn):
    """Depth along the contact at the end of the window; the colour behind it is the region at the surface."""
    edges, (scale, unit) = edges_between(worn.x) * 1e3, depth_unit(worn)
    names, shares = list(worn.shares), np.array(list(worn.shares.values()))
    patches = []
    if len(names) > 1:
        for k, name in enumerate(names):
            colour = PHASES[k % len(PHASES)]
            for node in np.flatnonzero(np.argmax(shares, axis=0) == k):
                axes.axvspan(edges[node], edges[node + 1], color=colour, alpha=0.5, linewidth=0)
            patches.append(Patch(facecolor=colour, alpha=0.5, label=name))
    lines = []
    for law, depths in worn.depth.items():
        name, colour, style = LAWS[law]
        lines += axes.plot(worn.x * 1e3, depths[-1] * scale, style, color=colour,
                           label=f"{name}, mean {worn.mean(depths[-1]) * scale:.3g} {unit}")
    axes.legend(handles=[*lines, *patches], loc="upper center", bbox_to_anchor=(0.5, -0.12), ncol=2, frameon=False)
    axes.set(title="(a) Depth worn off along the contact", xlabel="position along the contact [mm]", ylabel=f"depth [{unit}]",
             xlim=(edges[0], edges[-1]))
    axes.set_ylim(bottom=0)
    axes.grid(alpha=0.25)


def history(axes, _, worn):
    """Mean over the contact and over each region that is at least half of a node, over time."""
    scale, unit = depth_unit(worn)
    for law, depths in worn.depth.items():
        name, colour, style = LAWS[law]
        axes.plot(worn.time * MICRO, depths @ worn.length / worn.length.sum() * scale, style, color=colour, label=name)
        if len(worn.shares) < 2:
            continue
        for k, (region, share) in enumerate(worn.shares.items()):
            weight = worn.length * (share >= 0.5)
            if weight.any():
                axes.plot(worn.time * MICRO, depths @ weight / weight.sum() * scale, (":", "-.")[k % 2], color=colour,
                          linewidth=1, label=f"{name}, {region}")
    axes.legend(fontsize="small", frameon=False)
    axes.set(title="(b) Mean depth", xlabel="time [µs]", ylabel=f"depth [{unit}]")
    axes.set_ylim(bottom=0)
    axes.grid(alpha=0.25)


def flash_map(axes, figure, worn):
    """Rise of temperature over place and time."""
    stride = max(1, len(worn.time) // 1500)
    image = axes.pcolormesh(edges_between(worn.x) * 1e3, edges_between(worn.time[::stride]) * MICRO,
                            worn.temperature[::stride], cmap="inferno", rasterized=True)
    figure.colorbar(image, ax=axes, label="rise of temperature [K]", pad=0.02)
    axes.set(title=f"(c) Flash temperature, highest {worn.temperature.max():.3g} K",
             xlabel="position along the contact [mm]", ylabel="time [µs]")


if __name__ == "__main__":
    raise SystemExit("slipscale.wearing.picture is a library, no command: slipscale -h lists the commands.")
