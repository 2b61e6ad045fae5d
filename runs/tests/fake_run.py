"""Writes an output folder as `slide` does, with made-up but plausible numbers, to try the reading and the plots."""

from pathlib import Path

import h5py
import numpy as np

from slipscale.reading.mesh import centroids_and_areas, triangles_of

FREQUENCY = 357e3  # Hz, of everything that oscillates
FRICTION = 0.44  # mean T / mean N
SPEED, SIDE, NORMAL = 2.0, 5e-3, 7.5e4  # m/s, m, N/m


def write_run(folder, end=4e-4, spacing=5e-8, cells="triangles"):
    """`cells` is `triangles`, `quadrilaterals` or `mixed`."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    time = spacing * np.arange(round(end / spacing))
    write_history(folder, time)
    write_contact(folder, time)
    write_fields(folder, [end / 2, end], cells)
    (folder / "run.yaml").write_text(
        f"friction_coefficient: 0.5\nhistory_boundary: top\nsurface_speed: {SPEED}\ntime_end: {end:g}\n")
    (folder / "summary.yaml").write_text(f"friction_mean: {FRICTION}\n")


def write_history(folder, time):
    rng = np.random.default_rng(1)
    grown = 1 - np.exp(-time / 5e-5)
    ramp = 0.5 * (1 - np.cos(np.pi * np.minimum(time / 4e-5, 1)))
    wave = grown * np.cos(2 * np.pi * FREQUENCY * time)
    normal = NORMAL * ramp * (1 + 0.1 * np.roll(wave, 3)) + 1e-3
    tangential = NORMAL * ramp * (FRICTION + 0.03 * wave + 0.004 * rng.standard_normal(len(time)))
    velocity = 1.9 * np.minimum(1, 1.2 * np.sin(2 * np.pi * FREQUENCY * time)) * grown
    displacement = 2.4e-6 * ramp + 0.8e-6 * grown * np.cos(2 * np.pi * FREQUENCY * time + 0.05)
    drive = FRICTION * NORMAL * SPEED * time
    columns = {
        "time": time, "step": np.arange(len(time)) * 25, "friction/global": tangential / normal,
        "boundary/top/normal_force": normal, "boundary/top/tangential_force": tangential,
        "surface/normal_force": normal, "surface/tangential_force": tangential,
        "surface/drive_power": tangential * SPEED, "surface/power_into_body": 0.1 * tangential * SPEED,
        "surface/friction_heat": 0.9 * tangential * SPEED,
        "energy/kinetic": 0.004 * grown * (1 + wave**2), "energy/strain": 0.06 * ramp**2 * (1 + 0.1 * wave),
        "energy/loads": 0 * time, "energy/supports": -0.06 * ramp**2, "energy/body_force": 0 * time,
        "energy/surface_drive": drive, "energy/friction_heat": -0.9 * drive, "energy/impact_loss": -0.02 * drive,
        "energy/damping": -0.08 * drive, "energy/scheme_dissipation": 0 * time,
        "energy/residual": 1e-13 * drive * wave, "energy/flowed": 2 * drive,
        "contact/stick": 0.1 + 0.05 * wave, "contact/slip": 0.65 - 0.1 * wave, "contact/open": 0.25 + 0.05 * wave,
        "points/0/u": np.column_stack([displacement, -1e-7 * ramp]),
        "points/0/v": np.column_stack([velocity, 0.1 * wave]),
        "points/0/stress": np.column_stack([-5e6 * ramp, -15e6 * ramp, 7e6 * ramp]),
    }
    with h5py.File(folder / "history.h5", "w") as file:
        file["points/0/x"] = [SIDE / 2, 0.0]
        for name, values in columns.items():
            file.create_dataset(name, data=values, maxshape=(None, *values.shape[1:]), chunks=True)


def write_contact(folder, time):
    x = np.linspace(0, SIDE, 121)
    phase = np.mod(FREQUENCY * time[:, None] + x / 4e-3, 1)
    status = np.where(phase < 0.25, 0, np.where(phase < 0.37, 1, 2)).astype(np.uint8)
    status[time < 4e-5] = 2
    pressure = np.where(status > 0, 20e6, 0.0)
    columns = {"time": time, "u": np.zeros((*status.shape, 2)), "slip_rate": np.where(status == 1, 0, SPEED * phase),
               "normal_traction": pressure, "tangential_traction": 0.45 * pressure, "status": status}
    # What every step adds, here from the rows: the pressure is even, the surface slips with slip_rate.
    passed = np.diff(time, prepend=time[0])[:, None]
    slip = np.cumsum(columns["slip_rate"] * (status > 0) * passed, axis=0)
    columns |= {"sums/slip_distance": slip, "sums/pressure_slip": 20e6 * slip, "sums/friction_work": 9e6 * slip,
                "sums/impact_loss": 0 * slip, "sums/time_closed": np.cumsum((status > 0) * passed, axis=0),
                "sums/impulse": np.cumsum(pressure * passed, axis=0), "sums/closures": 1 + 0 * slip}
    with h5py.File(folder / "contact.h5", "w") as file:
        file["x"], file["tributary_length"] = x, np.gradient(x)
        inside = (np.mod(x, SIDE / 3) > SIDE / 6).astype(float)
        file["region_share"] = np.column_stack([1 - inside, inside])
        file.attrs["regions"] = "matrix\ninclusion"
        for name, values in columns.items():
            file.create_dataset(name, data=values, maxshape=(None, *values.shape[1:]), chunks=True)


def write_fields(folder, times, kind, divisions=60):
    """A square of divisions x divisions boxes with nine stiff discs (region 1)."""
    side = np.linspace(0, SIDE, divisions + 1)
    x, y = (part.ravel() for part in np.meshgrid(side, side))
    corner = (np.arange(divisions) + (divisions + 1) * np.arange(divisions)[:, None]).ravel()
    boxes = corner[:, None] + [0, 1, divisions + 2, divisions + 1]
    cells, stream = cells_of(boxes, kind)
    centre = np.array([[x[cell].mean(), y[cell].mean()] for cell in cells])
    away = np.mod(centre, SIDE / 3) - SIDE / 6
    region = (np.hypot(*away.T) < SIDE / 9).astype(np.int32)
    stress = np.column_stack([0 * region, -15e6 * (1 + 0.5 * region) - 5e6 * np.cos(centre[:, 0] * 2e3),
                              7e6 + 0 * region])
    nodal = np.zeros((len(x), 3))
    with h5py.File(folder / "fields.h5", "w") as file:
        file["mesh/coordinates"] = np.column_stack([x, y])
        file["mesh/cells"], file["mesh/region"] = stream, region
        file["mesh/region"].attrs["names"] = np.array([b"matrix", b"inclusion"])
        file["time"] = times
        for k in range(len(times)):
            file[f"frames/{k:05d}/u"] = file[f"frames/{k:05d}/v"] = nodal
            file[f"frames/{k:05d}/stress"] = stress


def cells_of(boxes, kind):
    """The cells as a list of corner arrays, and as `mesh/cells` holds them."""
    if kind == "quadrilaterals":
        return list(boxes), boxes
    triangles = boxes[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
    if kind == "triangles":
        return list(triangles), triangles
    half = len(boxes) // 2
    cells = [*boxes[:half], *triangles[2 * half:]]
    return cells, np.concatenate([[{4: 5, 3: 4}[len(cell)], *cell] for cell in cells])


def write_relocalized(folder, reference, factor, points=()):
    """relocalized.h5 on the mesh of the run in `reference`, with its stress times `factor`.

    `points` are pairs (cell, region) whose histories are recorded, the homogeneous stress half of the local one.
    """
    Path(folder).mkdir(parents=True, exist_ok=True)
    with h5py.File(reference / "fields.h5") as source, h5py.File(folder / "relocalized.h5", "w") as file:
        source.copy("mesh", file)
        source.copy("time", file)
        for frame, group in source["frames"].items():
            file[f"frames/{frame}/stress"] = factor * group["stress"][:]
        centre, _ = centroids_and_areas(source["mesh/coordinates"][:], *triangles_of(source["mesh/cells"][:]))
        for k, (cell, region) in enumerate(points):
            local = np.array([factor * group["stress"][cell] for group in source["frames"].values()])
            columns = {"x": centre[cell], "region": region, "time": source["time"][:], "stress": local,
                       "homogeneous_stress": 0.5 * local}
            for name, values in columns.items():
                file[f"points/{k}/{name}"] = values


def write_statistics(folder, name="statistics.h5", factor=1.0, window=(1e-4, 2e-4)):
    """`mean`, the stress of the first frame of fields.h5 times `factor`, and `deviation`, a tenth of it."""
    with h5py.File(folder / "fields.h5") as source, h5py.File(folder / name, "w") as file:
        source.copy("mesh", file)
        mean = factor * source["frames/00000/stress"][:]
        file["statistics/stress/mean"], file["statistics/stress/deviation"] = mean, 0.1 * mean
        file["statistics"].attrs.update({"from": window[0], "to": window[1], "samples": 100, "quantile": 0.99})
