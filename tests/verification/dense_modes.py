"""The modes of steady sliding of a small body by dense matrices, written apart from slipscale: reference of `modes`.

    python3 tests/verification/dense_modes.py scene.yaml [-option value …] [--scheme STEP]

A mesh and the options of a scene become stiffness and lumped mass; contact closes and opens until Signorini's conditions
hold; then two matrices are made and their eigenvalues taken:

- `Sliding.generator`: the first-order system of (u, v, s), s the friction force at each closed node,
      u' = v,   M v' = -K u - C v + s,   T s' = μ λ - s,   λ = (K u + b K v)_y at the closed node, C = a M + b K,
- `Sliding.step_map`: one step of the scheme, written as the step loop goes: (u, w, K u before, s, λ before) to the next.

Neither knows the scalar functions of p and z with which `modes` reduces both to one problem; `reduced_residual` shows
that they are the same. No mode is left out, nothing is iterated: good for some hundred nodes.
"""

import argparse
import sys

import meshio
import numpy as np
import yaml

GAUSS = 3**-0.5
CORNERS = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])


def strain_matrix(gradient):
    """[3, 2 n] of ∂N [n, 2], rows (xx, yy, xy), engineering shear."""
    b = np.zeros((3, 2 * len(gradient)))
    b[0, 0::2], b[1, 1::2], b[2, 0::2], b[2, 1::2] = gradient[:, 0], gradient[:, 1], gradient[:, 1], gradient[:, 0]
    return b


def element(x, c):
    """Stiffness [2 n, 2 n] in Pa and the area of each corner [n] of a triangle or quadrilateral x [n, 2], c [3, 3]."""
    if len(x) == 3:
        edges = np.linalg.inv(np.column_stack([np.ones(3), x]))
        area = 0.5 / np.linalg.det(edges)
        b = strain_matrix(edges[1:].T)
        return area * b.T @ c @ b, np.full(3, area / 3)
    k, areas = np.zeros((8, 8)), np.zeros(4)
    for s, t in GAUSS * CORNERS:
        slope = 0.25 * CORNERS * (1 + CORNERS * (s, t))[:, ::-1]  # ∂N/∂(ξ, η)
        jacobian = x.T @ slope
        b, weight = strain_matrix(slope @ np.linalg.inv(jacobian)), np.linalg.det(jacobian)
        k += weight * b.T @ c @ b
        areas += weight * 0.25 * np.prod(1 + CORNERS * (s, t), axis=1)
    return k, areas


def elasticity(options, region):
    """C [3, 3] in Pa and the density of a region."""
    def of(name):
        return options.get(f"material_{region}_{name}", options.get(f"material_all_{name}"))
    if of("stiffness") is not None:
        c11, c22, c12, c66, c16, c26 = numbers(of("stiffness"))
    else:
        young, poisson = float(of("young")), float(of("poisson"))
        shear = young / (2 * (1 + poisson))
        c12 = young * poisson / ((1 + poisson) * (1 - 2 * poisson))
        c11, c22, c66, c16, c26 = c12 + 2 * shear, c12 + 2 * shear, shear, 0, 0
    return np.array([[c11, c12, c16], [c12, c22, c26], [c16, c26, c66]]), float(of("density"))


def numbers(value):
    return [float(word) for word in (value.split(",") if isinstance(value, str) else value)]


def flat(tree, before=""):
    """A scene's nested keys joined with _."""
    found = {}
    for key, value in tree.items():
        name = f"{before}_{key}" if before else str(key)
        found.update(flat(value, name) if isinstance(value, dict) else {name: value})
    return found


class Body:
    """Stiffness [2 n, 2 n] and lumped mass [2 n] (node-wise x, y) of a mesh; `edges`: [m, 2] by name of the curve.
    Sides that gmsh made periodic are one, as in slipscale."""

    def __init__(self, options):
        mesh = meshio.read(options["mesh_file"])
        same = np.arange(len(mesh.points))
        for _, _, _, pairs in mesh.gmsh_periodic or []:
            for one, other in pairs:
                same[one] = other
        for _ in range(2):  # corners of a torus are tied twice
            same = same[same]
        kept, number = np.unique(same, return_inverse=True)
        self.x = mesh.points[kept, :2]
        dimension = {name: int(each[1]) for name, each in mesh.field_data.items()}
        label = {int(each[0]): name for name, each in mesh.field_data.items() if each[1] == 2}
        curve = {int(each[0]): name for name, each in mesh.field_data.items() if each[1] == 1}
        assert {1, 2} >= set(dimension.values())
        n = 2 * len(kept)
        self.stiffness, self.mass, self.edges = np.zeros((n, n)), np.zeros(n), {}
        self.cells = []
        for block, tags in zip(mesh.cells, mesh.cell_data["gmsh:physical"]):
            for nodes, tag in zip(block.data, tags):
                if block.type == "line":
                    self.edges.setdefault(curve[tag], []).append(nodes)
                elif block.type in ("triangle", "quad"):
                    c, density = elasticity(options, label[tag])
                    x = mesh.points[nodes, :2]
                    k, areas = element(x, c)
                    nodes = number[nodes]
                    rows = np.stack([2 * nodes, 2 * nodes + 1], axis=1).ravel()
                    self.stiffness[np.ix_(rows, rows)] += k
                    self.mass[rows] += density * np.repeat(areas, 2)
                    self.cells.append((rows, k, label[tag]))
        self.lengths, self.outward = {}, {}
        for name, edges in self.edges.items():
            length, outward = np.zeros(n // 2), np.zeros((n // 2, 2))
            for ends in np.array(edges):
                along = np.diff(mesh.points[ends, :2], axis=0)[0]
                for end in number[ends]:
                    length[end] += 0.5 * np.hypot(*along)
                    outward[end] += 0.5 * np.array([along[1], -along[0]])
            self.edges[name] = np.unique(number[np.array(edges)])
            self.lengths[name], self.outward[name] = length, outward


class Sliding:
    """The steady state of a scene and the matrices of its perturbations. Components are those of Body."""

    def __init__(self, options):
        self.options = options
        body = self.body = Body(options)
        self.mu = 0.0 if options["friction_law"] == "none" else float(options["friction_coefficient"])
        self.direction = np.sign(float(options["surface_speed"]))
        self.time = self.relaxation_time()
        self.a, self.b = float(options.get("damping_mass", 0)), float(options.get("damping_stiffness", 0))
        n = len(body.mass)
        self.prescribed, self.value, self.load = np.zeros(n, bool), np.zeros(n), np.zeros(n)
        self.rigid = {}
        start = self.uniform_state()
        for name, nodes in body.edges.items():
            self.hold(name, nodes, start)
        self.contact = [i for i in body.edges[options["surface_boundary"]] if not self.prescribed[2 * i + 1]]
        self.settle()

    def relaxation_time(self):
        options, speed = self.options, abs(float(self.options["surface_speed"]))
        if options["friction_law"] != "regularized":
            return 0.0
        if options.get("friction_rate", "surface") == "slip":
            return float(options["friction_length"]) / (speed + float(options["friction_rate_reference"]))
        if options.get("friction_time") is not None:
            return float(options["friction_time"])
        return float(options["friction_length"]) / speed

    def uniform_state(self):
        """u at the start, where `fixed` holds."""
        u = np.zeros(len(self.body.mass))
        pressure, shear = (float(self.options.get(f"initial_{name}", 0)) for name in ("pressure", "shear"))
        if pressure or shear:
            c, _ = elasticity(self.options, self.body.cells[0][2])
            y = self.body.x[:, 1] - self.body.x[:, 1].min()
            u[0::2], u[1::2] = shear * (y.max() - y) / c[2, 2], -pressure * y / c[1, 1]
        return u

    def hold(self, name, nodes, start):
        for axis, letter in enumerate("xy"):
            word = str(self.options.get(f"boundary_{name}_{letter}", "free"))
            rows = 2 * nodes + axis
            if word == "rigid":
                self.rigid[name] = rows
            elif word != "free":
                self.prescribed[rows] = True
                self.value[rows] = start[rows] if word == "fixed" else float(word)
        pressure, shear = (float(self.options.get(f"boundary_{name}_{kind}", 0)) for kind in ("pressure", "shear"))
        self.load[0::2] += -pressure * self.body.outward[name][:, 0] + shear * self.body.lengths[name]
        self.load[1::2] += -pressure * self.body.outward[name][:, 1]

    def basis(self, held):
        """Columns of what can move: components that are neither prescribed nor `held`, a rigid side's y as one."""
        free = ~self.prescribed
        free[held] = False
        columns = []
        for rows in self.rigid.values():
            free[rows] = False
            columns.append(np.isin(np.arange(len(free)), rows).astype(float))
        return np.column_stack([np.eye(len(free))[:, free], *columns])

    def settle(self):
        """Contact until 0 ≤ λ ⟂ gap ≥ 0: friction μ λ in the surface's direction at each closed node."""
        body, closed = self.body, set(self.contact)
        height = float(self.options.get("surface_height", 0))
        load = self.load.copy()
        for name, rows in self.rigid.items():
            load[rows[0]] -= float(self.options.get(f"boundary_{name}_force", 0))
        for _ in range(100):
            nodes = np.array(sorted(closed), int)
            y, x = 2 * nodes + 1, 2 * nodes
            t = self.basis(y)
            u = np.where(self.prescribed, self.value, 0)
            u[y] = height - body.x[nodes, 1]
            friction = np.zeros_like(body.stiffness)
            friction[x] = self.mu * self.direction * body.stiffness[y]
            pushed = load.copy()
            pushed[x] -= self.mu * self.direction * load[y]
            reduced = t.T @ (body.stiffness - friction)
            u = u + t @ np.linalg.solve(reduced @ t, t.T @ pushed - reduced @ u)
            force = body.stiffness @ u - load
            gap = {i: body.x[i, 1] + u[2 * i + 1] - height for i in self.contact}
            new = {i for i in self.contact if (force[2 * i + 1] >= 0 if i in closed else gap[i] < 0)}
            if new == closed:
                break
            closed = new
        else:
            raise RuntimeError("contact does not settle")
        self.u, self.closed, self.basis_of_modes = u, nodes, t
        self.pressure_force = force[y]
        reduce = lambda matrix: t.T @ matrix @ t
        self.k, self.m = reduce(body.stiffness), np.diag(reduce(np.diag(body.mass))).copy()
        for k, name in enumerate(self.rigid):
            self.m[len(self.m) - len(self.rigid) + k] += float(self.options.get(f"boundary_{name}_mass", 0))
        self.reaction = body.stiffness[y] @ t  # λ of u, [closed, free]
        self.push = self.direction * t.T[:, x]  # what a friction force does, [free, closed]

    def generator(self):
        """d/dt of (u, v, s), or of (u, v) with Coulomb's law."""
        n, c, k, m = len(self.m), len(self.closed), self.k, self.m[:, None]
        damped = np.diag(self.a * self.m) + self.b * k
        weight = self.push * self.mu
        if self.time == 0:
            return np.block([[np.zeros((n, n)), np.eye(n)],
                             [(weight @ self.reaction - k) / m, (self.b * weight @ self.reaction - damped) / m]])
        return np.block([[np.zeros((n, n)), np.eye(n), np.zeros((n, c))],
                         [-k / m, -damped / m, self.push / m],
                         [self.mu * self.reaction / self.time, self.mu * self.b * self.reaction / self.time,
                          -np.eye(c) / self.time]])

    def step_map(self, dt, beta2):
        """(u_n, w_n, u_{n-1}, s_{n-1}, λ_{n-1}) to those one step later."""
        n, c, k, m = len(self.m), len(self.closed), self.k, self.m[:, None]
        x = dt / self.time if self.time else np.inf
        e = np.exp(-x)
        g = -np.expm1(-x) / x if self.time else 0.0
        part = dict(zip(("u", "w", "old", "s", "p"), np.split(np.eye(3 * n + 2 * c), np.cumsum([n, n, n, c]))))
        strained = part["u"] + self.b / dt * (part["u"] - part["old"])
        reaction = self.reaction @ strained
        force = e * part["s"] + self.mu * ((1 - g) * reaction + (g - e) * part["p"])
        acceleration = (self.push @ force - k @ strained) / m - self.a * part["w"]
        return np.vstack([part["u"] + dt * part["w"] + (beta2 + 0.5) * dt**2 * acceleration,
                          part["w"] + dt * acceleration, part["u"], force, reaction])

    def modes(self):
        """Exponents p [k] in 1/s with Im p ≥ 0, that grow fastest first, and shapes [free, k]."""
        return sorted_modes(*np.linalg.eig(self.generator()), len(self.m), None)

    def scheme_modes(self, dt, beta2=0.5):
        """The same of the scheme: p = log z / Δt."""
        return sorted_modes(*np.linalg.eig(self.step_map(dt, beta2)), len(self.m), dt)

    def reduced_residual(self, p, dt=None, beta2=0.5):
        """‖[K + q M - μ φ G] u‖ / ‖K u‖ of the best u, with the scalar functions q(p) and φ(p) of `modes`."""
        q, phi = (rates(p, self.a, self.b, self.time) if dt is None else
                  scheme_rates(np.exp(p * dt), self.a, self.b, self.time, dt, beta2))
        scale = np.sqrt(self.m)
        matrix = (self.k - self.mu * phi * self.push @ self.reaction) / np.outer(scale, scale) + q * np.eye(len(scale))
        u = np.linalg.svd(matrix)[2][-1].conj()
        return np.linalg.norm(matrix @ u) / np.linalg.norm(self.k / np.outer(scale, scale) @ u)


def rates(p, a, b, time):
    """q and φ of continuous time."""
    return (p**2 + a * p) / (1 + b * p), 1 / (1 + p * time)


def scheme_rates(z, a, b, time, dt, beta2):
    """q and φ of the scheme."""
    q = (z - 1)**2 / (dt**2 * (1 + (beta2 + 0.5) * (z - 1))) * (1 + a * dt / (z - 1)) / (1 + b / dt * (1 - 1 / z))
    if time == 0:
        return q, 1
    e, g = np.exp(-dt / time), -np.expm1(-dt / time) * time / dt
    return q, ((1 - g) + (g - e) / z) / (1 - e / z)


def sorted_modes(value, vector, free, dt):
    if dt:
        keep = np.abs(value) > 1e-6  # what the step forgets
        value, vector = np.log(value[keep].astype(complex)) / dt, vector[:, keep]
    keep = value.imag >= 0
    value, vector = value[keep], vector[:free, keep]
    order = np.argsort(-value.real)
    return value[order], vector[:, order]


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("scene")
    arguments.add_argument("--scheme", type=float, help="time step in s: the scheme's exponents")
    arguments.add_argument("--count", type=int, default=10)
    chosen, words = arguments.parse_known_args()
    with open(chosen.scene) as file:
        options = flat(yaml.safe_load(file))
    options.update({name.removeprefix("-"): value for name, value in zip(words[::2], words[1::2])})
    sliding = Sliding(options)
    beta2 = float(options.get("time_beta2", 0.5))
    value = sliding.scheme_modes(chosen.scheme, beta2)[0] if chosen.scheme else sliding.modes()[0]
    print(f"{len(sliding.closed)} nodes closed, {len(sliding.contact) - len(sliding.closed)} open, normal force "
          f"{sliding.pressure_force.sum():.10g} N/m")
    for p in value[:chosen.count]:
        print(f"growth {p.real:.10g} 1/s, frequency {p.imag / (2 * np.pi):.10g} Hz, residual of the reduced problem "
              f"{sliding.reduced_residual(p, chosen.scheme, beta2):.1e}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
