"""Random scenes of `slide` that hang together: what they are made of, how they are loaded and rubbed, what they write.

Each option is drawn from its range in the schema (`slide -help`), about the scale that a block of some millimetres asks
for, and only where it has an effect.
"""

from meshes import BLOCKS, MESHES, is_periodic, regions_of
from scenes import SIDE
from schema import rounded

# Of the schema, what no scene here has, and why.
NOT_DRAWN = {
    "restart": "the soak's own", "output_folder": "the soak's own", "progress": "for terminals",
    "checkpoint_minutes": "runs last seconds", "time_wall": "the soak's own",
    "material_file": "drawn as material_<region>_file",
    "parameters_<parameter>": "of formulas, which are not drawn",
    **dict.fromkeys(("initial_file", "initial_time"), "another run's: tests/programs/test_initial_file.py"),
}


# Of a body that nothing holds up or down: what is thrown some metres moves in steps of rounding. s
LONGEST_FLIGHT = 2e-4


class Scene:
    """Draws one; `options` is what came of it: its body first (see `physics`), then what needs its time step."""

    def __init__(self, schema, chance):
        self.schema, self.chance, self.options, self.used = schema, chance, {}, set()

    def often(self, probability):
        return self.chance.random() < probability

    def entry(self, name):
        """The option of the schema behind a name as a scene has it."""
        if name in self.schema:
            return self.schema[name]
        first, last = name.partition("_")[0], name.rpartition("_")[2]
        return next(option for key, option in self.schema.items() if key.startswith(first + "_<")
                    and key.rpartition("_")[2] in (last, "<entry>"))

    def put(self, name, value):
        self.used.add(self.entry(name).name)
        self.options[name] = ",".join(map(str, value)) if isinstance(value, (list, tuple)) else value

    def number(self, name, scale=None):
        self.put(name, self.entry(name).number(self.chance, scale))

    def pressing(self, name, scale, sign=1):
        """A number that mostly presses the body down, where its sign does so."""
        value = self.entry(name).number(self.chance, scale)
        self.put(name, sign * abs(value) if self.often(0.8) else value)

    def word(self, name):
        self.put(name, self.entry(name).word(self.chance))

    # The body and what happens to it.

    def physics(self):
        self.mesh = self.chance.choice(MESHES)
        self.put("mesh_file", f"{self.mesh}.msh")
        self.periodic = is_periodic(self.mesh)
        if self.often(0.3):
            self.word("mesh_partitioner")
        if self.often(0.15):
            self.put("mesh_refine", self.chance.choice((0, 1)))
        if self.periodic and self.often(0.4):
            self.put("mesh_periodic", "false")
            self.periodic = False
        self.materials()
        self.body()
        self.top()
        self.sides()
        self.surface()
        self.start()

    def materials(self):
        names = ("all",) if self.often(0.3) else regions_of(self.mesh)
        self.one_material, self.isotropic = names == ("all",), True
        for name in names:
            kind = self.chance.random()
            if kind < 0.6:
                self.number(f"material_{name}_young", 5e10)
                self.number(f"material_{name}_poisson")
                self.number(f"material_{name}_density", 2000)
                continue
            self.isotropic = False
            if kind < 0.9:
                self.put(f"material_{name}_stiffness", self.stiffness())
                self.number(f"material_{name}_density", 2000)
            else:
                self.put(f"material_{name}_file", "effective.yaml")

    def stiffness(self):
        """c11, c22, c12, c66, c16, c26 of a positive definite matrix: C = A A^T about an isotropic one, Pa."""
        scale = 5e10 * 10 ** self.chance.uniform(-0.5, 0.5)
        a = [[(1.0, 1.0, 0.6)[i] * (i == k) + self.chance.uniform(-0.25, 0.25) for k in range(3)] for i in range(3)]
        c = [[scale * sum(x * y for x, y in zip(row, other)) for other in a] for row in a]
        return [rounded(c[i][k]) for i, k in ((0, 0), (1, 1), (0, 1), (2, 2), (0, 2), (1, 2))]

    def body(self):
        if self.often(0.3):
            scale = self.chance.choice((9.81, 1e6))
            self.put("body_acceleration", [self.entry("body_acceleration").number(self.chance, scale) for _ in range(2)])
        if self.often(0.4):
            self.number("damping_mass", 1e4)
        if self.often(0.5):
            self.number("damping_stiffness", 2e-9)
        if self.often(0.5):
            self.number("time_beta2")
        if self.often(0.3):
            self.word("stiffness_storage")

    def top(self):
        kind = self.chance.random()
        imposed = True
        if kind < 0.35:
            self.put("boundary_top_x", self.chance.choice(("fixed", "free")))
            self.pressing("boundary_top_y", 1e-6, -1)
        elif kind < 0.6:
            self.put("boundary_top_y", "rigid" if self.periodic else self.chance.choice(("rigid", "tilting")))
            self.pressing("boundary_top_force", 3e4)
            if self.often(0.5):
                self.number("boundary_top_mass", 1e-2)
            if self.often(0.3):
                self.put("boundary_top_x", "fixed")
        elif kind < 0.85:
            self.pressing("boundary_top_pressure", 5e6)
            if self.often(0.5):
                self.number("boundary_top_shear", 1e6)
            elif self.often(0.5):
                self.number("boundary_top_x", 1e-7)
        else:
            imposed = False
        if imposed and self.often(0.7):
            self.number("boundary_top_ramp", 2e-6)

    def sides(self):
        if self.periodic:
            return
        for side in ("left", "right"):
            kind = self.chance.random()
            if kind < 0.15 and not isinstance(self.options.get("boundary_top_x"), float):
                self.put(f"boundary_{side}_x", "fixed")
            elif kind < 0.25:
                self.number(f"boundary_{side}_pressure", 2e6)
                self.number(f"boundary_{side}_ramp", 2e-6)
            elif kind < 0.3:
                self.number(f"boundary_{side}_shear", 1e6)
            elif kind < 0.4:
                self.put(f"boundary_{side}_absorbing", "true")

    def surface(self):
        self.rubs = self.often(0.85)
        if not self.rubs:
            if self.often(0.5):
                self.put("boundary_bottom_y", "fixed")
            return
        self.put("surface_boundary", "bottom")
        self.number("surface_speed", self.chance.choice((0.05, 2, 20)))
        if self.often(0.3) and self.options["surface_speed"] != 0:
            self.number("surface_speed_ramp", 3e-6)
        if self.often(0.2):
            self.put("surface_height", -abs(self.entry("surface_height").number(self.chance, 3e-7)))  # below the body
        self.word("friction_law")
        law = self.options["friction_law"]
        if law != "none":
            self.number("friction_coefficient", 0.5)
        if law == "regularized":
            self.memory()
        if law == "exponential":
            self.number("friction_kinetic", 0.3)
            self.number("friction_slip_rate", 0.5)
            self.number(*self.chance.choice((("friction_time", 6e-7), ("friction_length", 1e-6))))
        if law != "none" and self.often(0.2):
            self.phase(law)

    def phase(self, law):
        """Constants of the region that surely touches the surface, where there is but one."""
        regions = regions_of(self.mesh)
        if len(regions) > 1:
            return
        self.number(f"friction_{regions[0]}_coefficient", 0.5)
        if law == "exponential":
            self.number(f"friction_{regions[0]}_kinetic", 0.3)
            self.number(f"friction_{regions[0]}_slip_rate", 0.5)
        if law != "regularized":
            return
        if self.options.get("friction_rate") == "slip" or self.often(0.5):
            self.number(f"friction_{regions[0]}_length", 1e-6)
        else:
            self.number(f"friction_{regions[0]}_time", 6e-7)

    def memory(self):
        self.word("friction_rate")
        if self.options["friction_rate"] == "slip":
            self.number("friction_length", 1e-6)
            self.number("friction_rate_reference", 0.2)
        elif self.often(0.5):
            self.number("friction_time", 6e-7)
        else:
            self.number("friction_length", 1e-6)
        if self.often(0.6):
            self.word("friction_threshold")

    def start(self):
        if self.often(0.3):
            self.put("initial_velocity", [self.entry("initial_velocity").number(self.chance, 0.5) for _ in range(2)])
        if self.often(0.15) and not self.periodic:
            self.number("initial_rotation", 100)
        if self.often(0.15):
            self.put("initial_displacement", [rounded(self.chance.uniform(-1e-8, 1e-8)), rounded(self.chance.uniform(0, 1e-8))])
        if self.often(0.2):
            self.number("initial_sine_amplitude", 0.1)
            self.number("initial_sine_wavelength", SIDE)
        kind = self.chance.random()
        if kind < 0.15 and self.rubs:
            self.number("initial_gap", 1e-7)
        elif kind < 0.35 and (self.mesh in BLOCKS and len(regions_of(self.mesh)) == 1 or self.one_material) and self.isotropic:
            self.number("initial_pressure", 5e6)
            if self.often(0.5):
                self.number("initial_shear", 1e6)

    # Time, and what is written.

    def writing(self, stable_step, steps):
        """Of a run of about so many `steps`, or fewer, whose stable step is known, s."""
        if self.often(0.5):
            step = self.entry("time_safety").number(self.chance)
            self.put("time_safety", step)
            step *= stable_step
        elif self.often(0.5):
            step = rounded(stable_step * self.chance.uniform(0.1, 0.99))
            self.put("time_step", step)
        else:
            step = 0.9 * stable_step
        if not any(isinstance(self.options.get(f"boundary_{side}_y"), float) or
                   self.options.get(f"boundary_{side}_y") == "fixed" for side in ("top", "bottom")):
            steps = min(steps, int(LONGEST_FLIGHT / step))
        self.end = rounded(step * steps)
        self.put("time_end", self.end)
        self.rows("history", steps, 400)
        if self.rubs and self.often(0.7):
            self.rows("contact", steps, 200)
            if self.often(0.3):
                self.word("contact_sums")
        self.interfaces(steps)
        if self.often(0.4):
            self.put("history_boundary", self.chance.choice(("top", "bottom") + (() if self.periodic else ("left",))))
        if self.often(0.4):
            self.put("history_points", [rounded(self.chance.uniform(0.3, 0.7) * SIDE) if place % 2 == 0 else
                                        self.chance.choice((0, SIDE)) for place in range(2 * self.chance.choice((1, 3)))])
        if self.often(0.4):
            self.word("history_momentum")
        self.frames(steps)
        if self.often(0.5):
            self.samples(steps)
        if self.often(0.3):
            self.put("run_note", "drawn by the soak")
        self.put("checkpoint_every", max(1, steps // self.chance.randint(2, 9)))

    def interfaces(self, steps):
        regions = regions_of(self.mesh)
        if len(regions) == 1 or self.often(0.7):
            return
        self.put("interfaces_region", self.chance.choice(regions))
        if self.often(0.8):
            self.rows("interfaces", steps, 100)
        if self.often(0.6):
            self.number("interfaces_normal_strength", 5e6)
            self.number("interfaces_shear_strength", 1e7)

    def rows(self, file, steps, most):
        every = max(1, steps // self.chance.randint(most // 10, most))
        if self.often(0.6):
            self.put(f"{file}_every", every)
        else:
            self.put(f"{file}_interval", rounded(every / steps * self.end))

    def frames(self, steps):
        kind = self.chance.random()
        if kind < 0.4:
            return
        frames = self.chance.randint(1, 12)
        if kind < 0.6:
            self.put("fields_every", max(1, steps // frames))
        elif kind < 0.8:
            self.put("fields_interval", rounded(self.end / frames))
        else:
            self.put("fields_times", sorted(rounded(self.chance.uniform(0, 0.999) * self.end) for _ in range(frames)))
        if self.often(0.5):
            known = ("u", "v", "stress", "strain", "principal") + (("von_mises",) if self.isotropic else ())
            self.put("fields_quantities", self.chance.sample(known, self.chance.randint(1, len(known))))
        if self.often(0.3):
            self.put("fields_box", [0, 0, rounded(self.chance.uniform(0.6, 1) * SIDE), rounded(0.7 * SIDE)])

    def samples(self, steps):
        begin = self.chance.uniform(0, 0.5)
        self.put("statistics_from", rounded(begin * self.end))
        self.put("statistics_to", rounded(self.chance.uniform(begin + 0.3, 0.9) * self.end))
        if self.often(0.8):
            self.put("statistics_every", max(1, steps // self.chance.randint(20, 200)))
        if self.often(0.5):
            self.number("statistics_quantile")
        if self.often(0.3) and any(self.options.get(f"damping_{kind}") for kind in ("mass", "stiffness")):
            self.word("statistics_damping")


# Where one run may differ from another of the same bits.
SAME_BITS = ("stiffness_kernel", "stiffness_instructions")


def same_bits(schema, chance):
    """Options that must not change a bit."""
    return {name: schema[name].word(chance) for name in SAME_BITS if chance.random() < 0.5}


def check_coverage(schema, chance, scenes=1000):
    """That so many scenes have every option of the schema, but for those that stand here with a reason."""
    used = set(SAME_BITS) | NOT_DRAWN.keys()
    for _ in range(scenes):
        scene = Scene(schema, chance)
        scene.physics()
        scene.writing(stable_step=1e-8, steps=1000)
        used |= scene.used
    assert used == schema.keys(), f"the soak does not know, or no longer meets: {', '.join(sorted(used ^ schema.keys()))}"
