"""The picture of `slipscale wear`: profile of the depth over its phases, depth over time, flash temperature."""

import numpy as np
from matplotlib.patches import Patch

from slipscale.measuring.window import MICRO
from slipscale.pictures.colours import BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILION
from slipscale.pictures.drawing import plt, shown
from slipscale.pictures.panels import edges_between

LAWS = {"archard": ("Archard", BLUE, "-"), "energy": ("by energy", VERMILION, "--")}
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


def profile(axes, _, worn):
    """Depth along the contact at the end of the window; the colour behind it is the region at the surface."""
    edges = edges_between(worn.x) * 1e3
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
        lines += axes.plot(worn.x * 1e3, depths[-1] * 1e9, style, color=colour,
                           label=f"{name}, mean {worn.mean(depths[-1]) * 1e9:.3g} nm")
    axes.legend(handles=[*lines, *patches], loc="upper center", bbox_to_anchor=(0.5, -0.12), ncol=2, frameon=False)
    axes.set(title="(a) Depth worn off along the contact", xlabel="position along the contact [mm]", ylabel="depth [nm]",
             xlim=(edges[0], edges[-1]))
    axes.set_ylim(bottom=0)
    axes.grid(alpha=0.25)


def history(axes, _, worn):
    """Mean over the contact and over each region that is at least half of a node, over time."""
    for law, depths in worn.depth.items():
        name, colour, style = LAWS[law]
        axes.plot(worn.time * MICRO, depths @ worn.length / worn.length.sum() * 1e9, style, color=colour, label=name)
        if len(worn.shares) < 2:
            continue
        for k, (region, share) in enumerate(worn.shares.items()):
            weight = worn.length * (share >= 0.5)
            if weight.any():
                axes.plot(worn.time * MICRO, depths @ weight / weight.sum() * 1e9, (":", "-.")[k % 2], color=colour,
                          linewidth=1, label=f"{name}, {region}")
    axes.legend(fontsize="small", frameon=False)
    axes.set(title="(b) Mean depth", xlabel="time [µs]", ylabel="depth [nm]")
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
