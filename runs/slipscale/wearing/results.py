"""wear.csv, wear.h5 and what is printed."""

import csv
import math

import h5py
import numpy as np

UNITS = {"friction_work": "J/m^2", "pressure_slip": "Pa m", "slip_distance": "m", "time_closed": "s"}
LAWS = {"archard": "Archard, k/H ∫ p |ds|", "energy": "by energy, k_E ∫ τ ds"}


def write_csv(path, worn):
    """One row a node, of the end of the window."""
    columns = {"x [m]": worn.x, "tributary_length [m]": worn.length}
    columns |= {f"part of {name} [1]": share for name, share in worn.shares.items()}
    columns |= {f"{name} [{UNITS[name]}]": values[-1] for name, values in worn.sums.items()}
    columns |= {f"depth_{law} [m]": values[-1] for law, values in worn.depth.items()}
    if worn.temperature is not None:
        peak = np.argmax(worn.temperature, axis=0)
        columns["highest_flash [K]"] = np.max(worn.temperature, axis=0)
        columns["at [s]"] = worn.time[peak]
    with open(path, "w", newline="", encoding="utf-8") as file:
        rows = csv.writer(file)
        rows.writerow(columns)
        rows.writerows(zip(*(map(repr, map(float, values)) for values in columns.values()), strict=True))


def write_hdf5(path, worn):
    """Everything over time: depths, sums and temperature, [n, nc]."""
    with h5py.File(path, "w") as file:
        def put(name, values, units, text):
            file[name] = values
            file[name].attrs.update({"units": units, "description": text})

        put("time", worn.time, "s", "of the rows of contact.h5 in the window")
        put("x", worn.x, "m", "where the nodes are in the undeformed body")
        put("tributary_length", worn.length, "m", "length of the boundary that belongs to each node")
        for name, share in worn.shares.items():
            put(f"region_share/{name}", share, "1", "part of that length")
        for name, values in worn.sums.items():
            put(f"sums/{name}", values, UNITS[name], "over every step since the first row of the window")
        for law, values in worn.depth.items():
            put(f"depth/{law}", values, "m", f"worn off since the first row of the window: {LAWS[law]}")
        if worn.temperature is not None:
            put("temperature", worn.temperature, "K",
                "flash temperature: rise of the surface over that of t = 0, half-space, one-dimensional at each node")


def _digits(value):
    return "-" if math.isnan(value) else f"{value:.4g}"


def report(worn):
    """The numbers, a few lines."""
    seconds = worn.time[-1] - worn.time[0]
    slip = worn.mean(worn.sums["slip_distance"][-1])
    work = worn.mean(worn.sums["friction_work"][-1])
    lines = [*(f"note: {note}" for note in worn.notes), f"{worn.time[0]:g} to {worn.time[-1]:g} s: slip distance {_digits(slip)} m, friction work {_digits(work)} "
             f"J/m^2, closed {_digits(100 * worn.mean(worn.sums['time_closed'][-1]) / seconds)} % of the time (means over "
             "the contact's length)"]
    for law, depths in worn.depth.items():
        last = depths[-1]
        mean, most = worn.mean(last), int(np.argmax(last))
        rate = mean / slip if slip > 0 else math.nan
        lines.append(f"depth, {LAWS[law]}: mean {_digits(mean)} m ({_digits(rate)} m per m of slip, {_digits(mean / seconds)} "
                     f"m/s), most {_digits(last[most])} m at x = {worn.x[most]:g} m")
        if len(worn.phases[law]) > 1:
            for phase in worn.phases[law]:
                lines.append(f"  {phase.name}: {100 * phase.part:.3g} % of the length, mean {_digits(phase.mean)} m, most "
                             f"{_digits(phase.most)} m, {_digits(100 * phase.volume)} % of the volume")
    if worn.temperature is not None:
        row, node = np.unravel_index(np.argmax(worn.temperature), worn.temperature.shape)
        lines.append(f"flash temperature: highest {_digits(worn.temperature[row, node])} K at x = {worn.x[node]:g} m, t = "
                     f"{worn.time[row]:g} s; mean over the contact at the end {_digits(worn.mean(worn.temperature[-1]))} K")
    return "\n".join(lines)


if __name__ == "__main__":
    raise SystemExit("slipscale.wearing.results is a library, no command: slipscale -h lists the commands.")
