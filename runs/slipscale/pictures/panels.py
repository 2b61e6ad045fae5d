"""The panels of the overview picture: each draws one thing on the axes it is given.

`window` is the pair of times (s) over which means and spectra are taken.
"""

import textwrap

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.patches import Patch

from slipscale.measuring import spectrum
from slipscale.measuring.averages import ratio_of_means, with_error
from slipscale.measuring.regime import STILL
from slipscale.measuring.window import MICRO, in_words, rows_in
from slipscale.pictures.colours import BLACK, BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILION
from slipscale.pictures.drawing import colours_for, draw_cells
from slipscale.reading import OPEN, SLIP, STICK, UnreadableRun

STATES = {OPEN: ("open", "#F0E9DC"), STICK: ("stick", BLUE), SLIP: ("slip", ORANGE)}

ENERGY_TERMS = {  # term: (what the legend calls it, colour, line style)
    "surface_drive": ("drive of the surface", BLACK, "-"),
    "friction_heat": ("friction heat", VERMILION, "-"),
    "damping": ("bulk damping", GREEN, "-"),
    "impact_loss": ("impact loss", PURPLE, "-"),
    "loads": ("loads", SKY, "-"),
    "supports": ("supports", SKY, "--"),
    "body_force": ("body force", SKY, ":"),
    "radiated": ("radiated", GREEN, "--"),
    "scheme_dissipation": ("scheme dissipation", GREEN, ":"),
    "strain": ("strain energy", BLUE, "-"),
    "kinetic": ("kinetic energy", ORANGE, "-"),
}
NO_LINE = ("residual", "flowed")
FAR = 20  # times the fastest motion: the surface's speed beyond it would leave nothing to be seen of the portrait


def phase_portrait(axes, figure, history, point, window, surface_speed):
    """Velocity against displacement, both along x, of a probe point; colour is time."""
    rows = rows_in(history.time, window)
    u, v = point.u[rows, 0] * MICRO, point.v[rows, 0]
    path = np.column_stack([u, v])
    lines = LineCollection(np.stack([path[:-1], path[1:]], axis=1), cmap="viridis", linewidth=0.8, rasterized=True)
    lines.set_array(history.time[rows][:-1] * MICRO)
    axes.add_collection(lines)
    axes.autoscale()
    widen(axes.get_xlim, axes.set_xlim, 1e-4)
    figure.colorbar(lines, ax=axes, label="time [µs]", pad=0.02)
    if surface_speed is not None and abs(surface_speed) < FAR * np.abs(v).max():
        axes.axhline(surface_speed, color=VERMILION, linestyle="--", linewidth=1.2)
        axes.annotate("speed of the surface: stick", (0.98, surface_speed), (0, 4), color=VERMILION, ha="right",
                      xycoords=("axes fraction", "data"), textcoords="offset points")
        axes.margins(y=0.08)
    axes.grid(alpha=0.25)
    where = ", ".join(f"{x * 1e3:.3g}" for x in point.x)
    axes.set(title=f"(a) Phase portrait at ({where}) mm, {in_words(window)}",
             xlabel=r"tangential displacement $u_x$ [µm]", ylabel=r"tangential velocity $v_x$ [m/s]")


def friction(axes, history, boundary, window, coefficient):
    """Friction measured at a boundary over the whole run, its mean in the window and the local coefficient.

    As in the spectrum, the instantaneous ratio gives way to T over mean N where N comes near zero.
    """
    rows = rows_in(history.time, window)
    measured, forces = history.friction, history.boundary[boundary]
    mean, error = ratio_of_means(forces["tangential_force"][rows], forces["normal_force"][rows])
    mean = mean if np.isfinite(mean) else 0.0
    name = friction_signal(history, boundary, rows)[1]
    if name != "T / N":
        measured = forces["tangential_force"] / forces["normal_force"][rows].mean()
    axes.axvspan(window[0] * MICRO, window[1] * MICRO, color="0.93", zorder=0)
    axes.plot(history.time * MICRO, measured, color=BLUE, linewidth=0.6, rasterized=True)
    axes.plot(np.array(window) * MICRO, [mean, mean], color=VERMILION, linewidth=2,
              label=f"mean T / mean N = {with_error(mean, error)}, {in_words(window)}")
    if coefficient is not None:
        axes.axhline(coefficient, color=BLACK, linestyle=":", linewidth=1.2,
                     label=f"local coefficient µ = {coefficient:g}")
    seen = measured[rows][np.isfinite(measured[rows])]
    if len(seen):  # not the first rows, where both forces are near zero
        reach = [*np.percentile(seen, [0.5, 99.5]), mean, mean if coefficient is None else coefficient]
        margin = 0.25 * (max(reach) - min(reach)) + 1e-6
        axes.set_ylim(min(reach) - margin, max(reach) + margin)
        widen(axes.get_ylim, axes.set_ylim)
    axes.set_xlim(history.time[0] * MICRO, history.time[-1] * MICRO)
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), frameon=False, fontsize="small")
    axes.grid(alpha=0.25)
    axes.set_title(f"(b) Global friction, measured at `{boundary}`", pad=38)
    axes.set(xlabel="time [µs]", ylabel=f"{name} [1]")


def friction_signal(history, boundary, rows):
    """The friction to take the spectrum of, and its name: T/N, or T over mean N where N comes near zero."""
    forces = history.boundary[boundary]
    normal, tangential = forces["normal_force"][rows], forces["tangential_force"][rows]
    if normal.min() > 0.1 * normal.mean() > 0:
        return tangential / normal, "T / N"
    if not normal.mean() > 0:  # nothing presses
        return np.zeros_like(tangential), "T / N"
    return tangential / normal.mean(), "T / mean N"


def friction_spectrum(axes, history, boundary, window, highest=2e6):
    """Welch spectrum of the friction in the window up to `highest` Hz.

    Returns the dominant frequency in Hz, 0 where what varies most is slower than the window can tell, or None when
    friction does not vary.
    """
    rows = rows_in(history.time, window)
    values, name = friction_signal(history, boundary, rows)
    if not np.ptp(values) > STILL:
        say(axes, "(c) Spectrum of the friction", f"{name} does not vary in the window.")
        return None
    values, rate = spectrum.evenly_spaced(history.time[rows], values)
    frequency, density = spectrum.welch(values, rate)
    shown = frequency <= min(highest, rate / 2)
    frequency, amplitude = frequency[shown], np.sqrt(density[shown])
    dominant = spectrum.dominant_frequency(frequency, amplitude**2)
    axes.semilogy(frequency[1:] / 1e3, amplitude[1:], color=BLUE, linewidth=1.2)
    if dominant:
        axes.axvline(dominant / 1e3, color=VERMILION, linestyle="--", linewidth=1.2)
        right = dominant < 0.6 * frequency[-1]
        axes.annotate(f"{dominant / 1e3:.1f} kHz", (dominant / 1e3, 0.93), (6 if right else -6, 0), color=VERMILION,
                      xycoords=("data", "axes fraction"), textcoords="offset points", ha="left" if right else "right")
    else:
        axes.annotate("what varies most is slower\nthan the window can tell", (0.98, 0.93), color=VERMILION, ha="right",
                      va="top", xycoords="axes fraction")
    axes.set_ylim(max(amplitude[1:].min(), amplitude.max() * 1e-6), amplitude.max() * 4)
    axes.set_xlim(0, frequency[-1] / 1e3)
    axes.grid(alpha=0.25)
    axes.set(title=f"(c) Spectrum of {name}, {in_words(window)}",
             xlabel=f"frequency [kHz] (Welch, bins of {frequency[1] / 1e3:.1f} kHz)", ylabel="√density [1/√Hz]")
    return dominant


def status_map(axes, contact, window):
    """Where along the contact and when the nodes stick, slip or are open."""
    rows = rows_in(contact.time, window)
    if rows.stop - rows.start < 2:
        raise UnreadableRun(f"contact.h5 has no rows in {in_words(window)}.")
    stride = max(1, (rows.stop - rows.start) // 1500)
    status = contact.read("status", slice(rows.start, rows.stop, stride))
    time = contact.time[rows][::stride]
    colours = ListedColormap([colour for _, colour in STATES.values()])
    axes.pcolormesh(edges_between(contact.x) * 1e3, edges_between(time) * MICRO, status, cmap=colours,
                    norm=BoundaryNorm([-0.5, 0.5, 1.5, 2.5], 3), rasterized=True)
    axes.legend(handles=[Patch(facecolor=colour, edgecolor="0.4", label=name) for name, colour in STATES.values()],
                loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=3, frameon=False)
    axes.set(xlabel="position along the contact [mm]", ylabel="time [µs]")
    axes.set_title(f"(d) State of the contact, {time[0] * MICRO:.1f}–{time[-1] * MICRO:.1f} µs", pad=26)


def edges_between(centres):
    """The n + 1 edges of cells around n increasing centres."""
    middle = 0.5 * (centres[1:] + centres[:-1])
    return np.concatenate([[centres[0]], middle, [centres[-1]]])


def stress_field(axes, figure, fields):
    """σ_yy of the last frame, with the outlines of the inclusions."""
    stress = fields.read("stress")[:, 1] * 1e-6
    image = draw_cells(axes, fields, stress, colours_for(stress), linewidth=0.6)
    figure.colorbar(image, ax=axes, label=r"$\sigma_{yy}$ [MPa]", extend="both", pad=0.02)
    axes.set(title=rf"(e) $\sigma_{{yy}}$ at {fields.time[-1] * MICRO:.1f} µs (compression < 0)")


def energy_ledger(axes, history):
    """Every term of the energy balance on a logarithmic scale; the sign of a negative term stands in the legend."""
    terms = {name: values for name, values in history.energy.items() if name not in NO_LINE}
    known = [name for name in ENERGY_TERMS if name in terms] + [name for name in terms if name not in ENERGY_TERMS]
    largest = max((np.nanmax(np.abs(values)) for values in terms.values()), default=0)
    zero = [ENERGY_TERMS.get(name, (name,))[0] for name in known if np.nanmax(np.abs(terms[name])) < 1e-9 * largest]
    for name in sorted(known, key=lambda name: -abs(terms[name][-1])):
        label, colour, style = ENERGY_TERMS.get(name, (name, "0.5", "-."))
        if label in zero:
            continue
        sign = " (< 0)" if np.nanmean(terms[name]) < 0 else ""
        axes.semilogy(history.time * MICRO, np.abs(terms[name]), color=colour, linestyle=style, linewidth=1.2,
                      label=label + sign, rasterized=True)
    if largest > 0:
        axes.set_ylim(largest * 1e-6, largest * 3)
        axes.grid(alpha=0.25)
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.13), ncol=2, fontsize="small", frameon=False)
    axes.set_xlim(history.time[0] * MICRO, history.time[-1] * MICRO)
    notes = [f"zero: {', '.join(zero)}"] if zero else []
    residual = relative_residual(history)
    if residual is not None:
        notes.insert(0, f"residual / energy that flowed: {residual:.1e}")
    notes = [line for note in notes for line in textwrap.wrap(note, 60)]
    axes.set_title("(f) Energy ledger, absolute values", pad=6 + 11 * len(notes))
    axes.annotate("\n".join(notes), (0.5, 1), (0, 3), xycoords="axes fraction", textcoords="offset points", ha="center",
                  va="bottom", fontsize="x-small")
    axes.set(xlabel="time [µs]", ylabel="energy [J/m]")


def relative_residual(history):
    """Largest residual of the energy balance over what had flowed by then, of all rows, as summary.yaml has it; None
    when not recorded."""
    residual, flowed = history.energy.get("residual"), history.energy.get("flowed")
    if residual is None or flowed is None or not flowed[-1] > 0:
        return None
    return np.max(np.abs(residual[flowed > 0]) / flowed[flowed > 0])


def widen(limits, set_limits, least=0.05):
    """Makes the limits of an axis span at least a part `least` of their size, so that ticks tell values apart."""
    low, high = limits()
    middle, span = 0.5 * (low + high), least * max(abs(low), abs(high))
    if high - low < span:
        set_limits(middle - 0.5 * span, middle + 0.5 * span)


def say(axes, title, sentence):
    """A panel that has nothing to draw says why."""
    axes.set_title(title)
    axes.text(0.5, 0.5, textwrap.fill(sentence, 36), transform=axes.transAxes, ha="center", va="center", color="0.35")
    axes.set(xticks=[], yticks=[])
