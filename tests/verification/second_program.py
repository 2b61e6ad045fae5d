"""A second program for the same discrete equations, written apart from slipscale: one block of equal bilinear
rectangles on a moving rigid surface, in NumPy, one process.

    python3 tests/verification/second_program.py scene_r [h in mm, default .25] [--cycle]
    python3 tests/verification/second_program.py strip [S1 | S2] [nx, default 32] [--step .2] [--relaxation .1]

What agreement with it shows: that two programs solve the same discrete equations. It says nothing about the equations,
for which the exact solutions of the other tests stand. It knows central differences (β2 = ½), stiffness damping lagged
by a step, a regularised law with constant relaxation time and both thresholds; nothing else.
"""

import argparse

import numpy as np


def stiffness_matrix(young, poisson, a, b):
    """∫BᵀCB of a rectangle a × b in plane strain, [8, 8], corners counter-clockwise from the lower left."""
    lame, shear = young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson))
    c = np.array([[lame + 2 * shear, lame, 0], [lame, lame + 2 * shear, 0], [0, 0, shear]])
    signs = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    k = np.zeros((8, 8))
    for s in (-(3**-0.5), 3**-0.5):
        for t in (-(3**-0.5), 3**-0.5):
            dx = signs[:, 0] * (1 + t * signs[:, 1]) / (2 * a)
            dy = signs[:, 1] * (1 + s * signs[:, 0]) / (2 * b)
            strain = np.zeros((3, 8))
            strain[0, 0::2], strain[1, 1::2], strain[2, 0::2], strain[2, 1::2] = dx, dy, dy, dx
            k += strain.T @ c @ strain * a * b / 4
    return k


class Block:
    """nx × ny equal rectangles on [0, width] × [0, height]. Fields are [2, ny + 1, columns]; on a torus the columns are
    nx, else nx + 1."""

    def __init__(self, nx, ny, width, height, young, poisson, density, periodic=False):
        self.nx, self.ny, self.periodic = nx, ny, periodic
        a, b = width / nx, height / ny
        self.k = stiffness_matrix(young, poisson, a, b)
        columns = nx if periodic else nx + 1
        self.x, self.y = np.arange(columns) * a, np.arange(ny + 1) * b
        across = np.full(columns, a)
        up = np.full(ny + 1, b)
        up[[0, -1]] /= 2
        if not periodic:
            across[[0, -1]] /= 2
        self.tributary = across
        self.mass = density * up[:, None] * across[None, :]

    def force(self, u):
        """K u."""
        ny, nx = self.ny, self.nx
        wide = np.concatenate([u, u[:, :, :1]], axis=2) if self.periodic else u
        corners = np.stack([wide[:, :-1, :-1], wide[:, :-1, 1:], wide[:, 1:, 1:], wide[:, 1:, :-1]])
        f = (self.k @ corners.reshape(8, -1)).reshape(4, 2, ny, nx)
        out = np.zeros_like(wide)
        out[:, :-1, :-1] += f[0]
        out[:, :-1, 1:] += f[1]
        out[:, 1:, 1:] += f[2]
        out[:, 1:, :-1] += f[3]
        if self.periodic:
            out[:, :, 0] += out[:, :, -1]
            out = out[:, :, :-1]
        return out

    def largest_frequency(self):
        """ω of the free body by power iteration."""
        u = np.random.default_rng(1).standard_normal((2, self.ny + 1, len(self.x)))
        for _ in range(4000):
            new = self.force(u) / self.mass
            square = np.sqrt((new**2).sum() / (u**2).sum())
            u = new / np.sqrt((new**2).sum())
        return np.sqrt(square)


class Sliding:
    """`top(t)`: prescribed (u_x, u_y) of the top; `start`: (u, v_x, traction, pressure) at t = 0 in the memory."""

    def __init__(self, block, step, speed, friction, relaxation, threshold, damping, top, start=None):
        self.block, self.dt, self.speed, self.mu, self.top = block, step, speed, friction, top
        self.relaxation, self.strength_stored, self.lag = relaxation, threshold == "regularized", damping / step
        shape = (2, block.ny + 1, len(block.x))
        self.u, self.w = np.zeros(shape), np.zeros(shape)
        self.memory, self.old_pressure = np.zeros(shape[2]), np.zeros(shape[2])
        if start:
            self.u, self.w[0], self.memory[:], self.old_pressure[:] = start
        self.f = block.force(self.u)
        self.n = 0

    def law(self, trial, p, closed, elapsed):
        """τ and which nodes stick; keeps the memory. ṡ = -(s - μp)/T, exactly for a pressure linear over the step."""
        x = elapsed / self.relaxation if self.relaxation > 0 else np.inf
        e = np.exp(-x)
        g = 1.0 if x == 0 else (0.0 if np.isinf(x) else -np.expm1(-x) / x)
        sign = np.where(trial < 0, -1.0, 1.0)
        kept = self.memory if self.strength_stored else np.maximum(0, sign * self.memory)
        s = e * kept + self.mu * ((1 - g) * p + (g - e) * self.old_pressure)
        # Instantaneous: sticks below μp, and where the relaxed traction would pass what sticking needs.
        stick = np.abs(trial) <= (s if self.strength_stored else np.maximum(s, self.mu * p))
        tau = np.where(stick, trial, sign * s) * closed
        self.memory = (s if self.strength_stored else tau) * closed
        self.old_pressure = p * closed
        return tau, stick & closed

    def advance(self):
        """From t_n to t_{n+1}; leaves what was seen at t_n."""
        block, dt, first = self.block, self.dt, self.n == 0
        c = dt**2 * (0.5 if first else 1)
        self.before, old = self.u, self.f
        self.f = block.force(self.u)
        self.internal = self.f + self.lag * (self.f - old)
        a = -self.internal / block.mass
        u = self.u + dt * self.w + c * a
        target = self.top((self.n + 1) * dt)
        for axis in (0, 1):
            a[axis, -1] += (target[axis] - u[axis, -1]) / c
        gap = u[1, 0]
        closed = gap < 0
        m, length = block.mass[0], block.tributary
        load = np.where(closed, -gap * m / c, 0)
        self.pressure = load / length
        trial = (self.u[0, 0] + self.speed * dt - u[0, 0]) * m / (c * length)
        self.traction, self.stick = self.law(trial, self.pressure, closed, 0 if first else dt)
        self.closed = closed
        a[0, 0] += self.traction * length / m
        a[1, 0] += load / m
        self.u = self.u + dt * self.w + c * a
        self.w = self.w + dt * (0.5 if first else 1) * a
        self.n += 1

    def top_load(self):
        """(T, N) of the body on its support at t_n, N/m."""
        return -self.internal[0, -1].sum(), -self.internal[1, -1].sum()


def scene_r(spacing):
    """Scene R at Δt/h = 20 ns/mm, threshold regularized."""
    n = round(5e-3 / spacing)
    top = lambda t: (0, -1.3888888888888889e-6 * (0.5 * (1 - np.cos(np.pi * t / 40e-6)) if t < 40e-6 else 1))
    block = Block(n, n, 5e-3, 5e-3, 45e9, 0.25, 1800)
    return Sliding(block, 20e-9 / 1e-3 * spacing, 2, 0.5, 0.6e-6, "regularized", 2e-9, top)


def readings(body, times):
    """{t: (u_M, v_M, T, N)} of the central contact node and the top."""
    found, middle = {}, len(body.block.x) // 2
    wanted = {round(t / body.dt): t for t in times}
    for n in range(max(wanted) + 1):
        body.advance()
        if n in wanted:
            u = body.before[0, 0, middle]
            found[wanted[n]] = (u, (body.u[0, 0, middle] - u) / body.dt, *body.top_load())
    return found


def cycle(body, begin=250e-6, end=400e-6):
    """Over [begin, end]: mean T over mean N at the top, dominant frequency of T in Hz, rms of v_M, sticking and open
    parts of the nodes."""
    middle, first, last = len(body.block.x) // 2, round(begin / body.dt), round(end / body.dt)
    every, sums, tangential = round(20e-9 / body.dt), np.zeros(4), []
    while body.n <= last:
        body.advance()
        n = body.n - 1
        if n < first:
            continue
        if (n - first) % every == 0:
            tangential.append(body.top_load()[0])
            sums[0] += body.top_load()[1]
        v = (body.u[0, 0, middle] - body.before[0, 0, middle]) / body.dt
        sums[1:] += v**2, body.stick.mean(), 1 - body.closed.mean()
    steps, tangential = last - first + 1, np.array(tangential)
    wave = (tangential - tangential.mean()) * np.hanning(len(tangential))
    frequency = np.fft.rfftfreq(64 * len(wave), 20e-9)[np.abs(np.fft.rfft(wave, 64 * len(wave))).argmax()]
    return tangential.sum() / sums[0], frequency, np.sqrt(sums[1] / steps), sums[2] / steps, sums[3] / steps


def strip(regime, nx, step=0.4, relaxation=0.2, threshold=None, seed=0.01):
    """Means over t in [200, 400] of a strip in sustained instability: friction, load, power into the body, open part,
    sticking part. S1 slips and separates (instantaneous threshold), S2 sticks as well (regularized). `step` over
    2/ω_max, `seed` v_x over V."""
    length, p0, mu = 2 * np.pi, 1e-4, 0.5
    speed, own_threshold = {"S1": (7e-4, "instantaneous"), "S2": (2e-4, "regularized")}[regime]
    block = Block(nx, {32: 10, 64: 20, 128: 41}[nx], length, 2, 2.6, 0.3, 1, periodic=True)
    u = np.zeros((2, block.ny + 1, nx))
    u[1] = -p0 * block.y[:, None] / 3.5  # C22 = λ + 2G = 3.5 for G = 1, ν = .3
    u[0] = mu * p0 * (2 - block.y)[:, None]
    held = u[:, -1].copy()
    v = seed * speed * np.cos(block.x)[None, :] * (1 - block.y / 2)[:, None] ** 2
    body = Sliding(block, step * 2 / block.largest_frequency(), speed, mu, relaxation, threshold or own_threshold, 0.02,
                   lambda t: held, (u, v, mu * p0, p0))
    sums, steps, last = np.zeros(5), 0, body.u[0, 0]
    while body.n * body.dt <= 400:
        body.advance()
        if (body.n - 1) * body.dt >= 200:
            velocity = (body.u[0, 0] - last) / (2 * body.dt)
            force = body.traction * block.tributary
            sums += (force.sum(), (body.pressure * block.tributary).sum(), (force * velocity).sum(),
                     1 - body.closed.mean(), body.stick.mean())
            steps += 1
        last = body.before[0, 0]
    load = p0 * length
    power = mu * load * speed
    return sums[0] / sums[1], sums[1] / steps / load, sums[2] / steps / power, sums[3] / steps, sums[4] / steps


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    scenes = arguments.add_subparsers(dest="scene", required=True)
    block = scenes.add_parser("scene_r", help="a block under 15 MPa at 2 m/s")
    block.add_argument("spacing", nargs="?", type=float, default=0.25, help="h, mm")
    block.add_argument("--cycle", action="store_true", help="on to 400 us")
    slab = scenes.add_parser("strip", help="a periodic strip in sustained instability")
    slab.add_argument("regime", nargs="?", choices=["S1", "S2"], default="S1")
    slab.add_argument("nx", nargs="?", type=int, choices=[32, 64, 128], default=32)
    slab.add_argument("--step", type=float, default=0.4, help="over 2/omega_max")
    slab.add_argument("--relaxation", type=float, default=0.2, help="T; 0 is Coulomb")
    slab.add_argument("--threshold", choices=["instantaneous", "regularized"])
    chosen = arguments.parse_args()
    if chosen.scene == "strip":
        means = strip(chosen.regime, chosen.nx, chosen.step, chosen.relaxation, chosen.threshold)
        print("friction %.4f, load %.4f, power %.4f, open %.3f, stick %.3f" % means)
        return
    spacing = chosen.spacing * 1e-3
    for time, values in readings(scene_r(spacing), (10e-6, 30e-6)).items():
        print(f"t {time * 1e6:g} us: u_M %.10g m, v_M %.10g m/s, T %.10g, N %.10g N/m" % values)
    if chosen.cycle:
        friction, frequency, *others = cycle(scene_r(spacing))
        print(f"250-400 us: T/N {friction:.4f}, {frequency / 1e3:.1f} kHz, "
              "rms v_M %.3f m/s, stick %.3f, open %.3f" % tuple(others))


if __name__ == "__main__":
    main()
