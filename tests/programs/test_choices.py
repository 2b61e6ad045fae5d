"""The choices a scene has: laws of friction, materials, storage, refinement, probe points."""

import unittest

import numpy as np
import yaml
from running import InScratch, datasets
from scenes import SIDE, SQUEAL, block

SCENE = {**SQUEAL, "time_end": 4e-6, "time_step": 2e-8, "contact_every": 1}  # 200 steps
LAWS = {
    "none": {"friction_law": "none", "friction_coefficient": None, "friction_time": None, "friction_threshold": None},
    "coulomb": {"friction_law": "coulomb", "friction_time": None, "friction_threshold": None},
    "time, instantaneous": {"friction_threshold": "instantaneous"},
    "time, regularized": {"friction_threshold": "regularized"},
    "length, instantaneous": {"friction_time": None, "friction_length": 1.2e-6, "friction_threshold": "instantaneous"},
    "length, regularized": {"friction_time": None, "friction_length": 1.2e-6, "friction_threshold": "regularized"},
    "slip rate, instantaneous": {"friction_time": None, "friction_length": 1.2e-6, "friction_rate": "slip",
                                 "friction_rate_reference": 0.1, "friction_threshold": "instantaneous"},
    "slip rate, regularized": {"friction_time": None, "friction_length": 1.2e-6, "friction_rate": "slip",
                               "friction_rate_reference": 0.1, "friction_threshold": "regularized"},
    "no memory": {"friction_time": 0, "friction_threshold": "instantaneous"},
    "no length": {"friction_time": None, "friction_length": 0, "friction_threshold": "regularized"},
}


class Choices(InScratch):
    def setUp(self):
        super().setUp()
        block(self.folder / "block.msh")

    def history(self, scene, **changes):
        self.run_scene(scene, **changes)
        return datasets(self.folder / "out" / "history.h5")

    def assert_close(self, left, right, tolerance):
        """Every dataset, relative to its largest value; the rounding that the residual is made of left out."""
        self.assertEqual(left.keys(), right.keys())
        for name in left.keys() - {"energy/residual"}:
            scale = np.nanmax(np.abs(left[name]))
            np.testing.assert_allclose(right[name], left[name], rtol=0, atol=tolerance * scale, err_msg=name)

    def test_laws(self):
        histories, contacts = {}, {}
        for law, options in LAWS.items():
            with self.subTest(law):
                histories[law] = self.history(SCENE, **options)
                contacts[law] = datasets(self.folder / "out" / "contact.h5")
                self.assertGreater(histories[law]["boundary/top/normal_force"].max(), 1e4)
                self.assertGreaterEqual(histories[law]["energy/friction_heat"].min(), 0)
                self.assertTrue(np.all(contacts[law]["normal_traction"] >= 0))
        self.assertEqual(np.abs(contacts["none"]["tangential_traction"]).max(), 0)
        bound = 0.5 * contacts["coulomb"]["normal_traction"]
        self.assertTrue(np.all(np.abs(contacts["coulomb"]["tangential_traction"]) <= bound * (1 + 1e-12)))
        # T = L*/|V|, and Coulomb is what remains without memory.
        for threshold in ("instantaneous", "regularized"):
            self.assert_close(histories["time, " + threshold], histories["length, " + threshold], 1e-9)
        self.assert_close(histories["coulomb"], histories["no memory"], 1e-9)
        self.assert_close(histories["coulomb"], histories["no length"], 1e-9)
        self.assertFalse(np.array_equal(histories["time, instantaneous"]["surface/tangential_force"],
                                        histories["coulomb"]["surface/tangential_force"]))

    def test_material_of_a_file(self):
        six = "5.1e10,5.4e10,1.8e10,1.7e10,1e9,-2e9"
        (self.folder / "effective.yaml").write_text(f"stiffness: [{six}]\ndensity: 1850\n")
        without = {name: None for name in SCENE if name.startswith("material_")}
        typed = self.history(SCENE, **without, material_block_stiffness=six, material_block_density=1850)
        of_all = self.history(SCENE, **without, material_file="effective.yaml")
        of_one = self.history(SCENE, **without, material_block_file="effective.yaml")
        for name in typed:
            self.assertEqual(typed[name].tobytes(), of_all[name].tobytes(), name)
            self.assertEqual(typed[name].tobytes(), of_one[name].tobytes(), name)

    def test_single_precision_of_the_stiffness(self):
        double, single = (self.history(SCENE, stiffness_storage=storage) for storage in ("double", "single"))
        self.assert_close(double, single, 1e-5)
        self.assertFalse(np.array_equal(double["points/0/u"], single["points/0/u"]))

    def test_refined_mesh_is_the_fine_mesh(self):
        refined = self.history(SCENE, mesh_refine=1)
        run = yaml.safe_load((self.folder / "out" / "run.yaml").read_text())
        self.assertEqual((run["run"]["nodes"], run["run"]["cells"]), (17 * 17, 16 * 16))
        block(self.folder / "fine.msh", divisions=16)
        self.assert_close(refined, self.history(SCENE, mesh_file="fine.msh"), 1e-8)

    def test_dissipation_of_the_scheme(self):
        history = self.history(SCENE, time_beta2=0.8, damping_stiffness=None, damping_mass=1e4)
        self.assertGreater(history["energy/scheme_dissipation"][-1], 0)
        self.assertGreater(history["energy/damping"][-1], 0)
        self.assertLess(np.abs(history["energy/residual"]).max(), 1e-12 * history["energy/flowed"].max())

    def test_pressure_and_gravity_and_gap(self):
        history = self.history({**SCENE, "boundary_top_x": None, "boundary_top_y": None, "boundary_top_pressure": 1e6,
                                "boundary_top_shear": 1e5, "body_acceleration": "0,-9.81", "initial_gap": 1e-8,
                                "initial_velocity": "0.1,-0.05"})
        self.assertEqual(history["contact/open"][0], 1)
        self.assertLess(history["contact/open"].min(), 1)
        self.assertGreater(history["energy/loads"].max(), 0)
        self.assertLess(np.abs(history["energy/residual"]).max(), 1e-12 * history["energy/flowed"].max())

    def test_points_at_a_node_and_inside_a_cell(self):
        h = SIDE / 8
        # A node, a node missed by a hair, the middle of a cell.
        points = np.array([[3 * h, 2 * h], [5 * h + 1e-10, 8 * h], [4.5 * h, 1.5 * h]])
        history = self.history(SCENE, history_every=10, fields_times="2e-6",
                               history_points=",".join(map(repr, points.ravel().tolist())))
        fields = datasets(self.folder / "out" / "fields.h5")
        nodes, cells = fields["mesh/coordinates"][:, :2], fields["mesh/cells"]
        u, v, stress = (fields["frames/00000/" + name] for name in ("u", "v", "stress"))
        centres = nodes[cells].mean(axis=1)

        def near(places, point, distance):
            return np.flatnonzero(np.hypot(*(places - point).T) < distance)

        row = 10  # 2 us
        for k in (0, 1):
            node, = near(nodes, points[k], 1e-3 * h)
            np.testing.assert_array_equal(history[f"points/{k}/x"], nodes[node])
            np.testing.assert_array_equal(history[f"points/{k}/u"][row], u[node, :2])
            np.testing.assert_array_equal(history[f"points/{k}/v"][row], v[node, :2])
            around = near(centres, points[k], 0.8 * h)
            self.assertEqual(len(around), (4, 2)[k])
            np.testing.assert_allclose(history[f"points/{k}/stress"][row], stress[around].mean(axis=0), rtol=1e-9,
                                       atol=1e-9 * np.abs(stress).max())
        cell, = near(centres, points[2], 1e-3 * h)
        np.testing.assert_array_equal(history["points/2/x"], points[2])
        np.testing.assert_allclose(history["points/2/u"][row], u[cells[cell], :2].mean(axis=0), rtol=1e-9, atol=1e-20)
        np.testing.assert_allclose(history["points/2/v"][row], v[cells[cell], :2].mean(axis=0), rtol=1e-9, atol=1e-14)
        np.testing.assert_allclose(history["points/2/stress"][row], stress[cell], rtol=1e-12)


if __name__ == "__main__":
    unittest.main()
