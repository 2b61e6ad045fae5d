"""What stands in the files of a run, against what the run says elsewhere or what follows from the rest."""

import re
import resource
import unittest

import numpy as np
import yaml
from long_runs import SCENE, InBlock
from running import datasets, h5py
from scenes import block


class Contents(InBlock):
    def test_every_file_says_where_it_comes_from(self):
        self.run_scene({**SCENE, "fields_every": 50, "statistics_from": 1e-6}, ranks=2)
        facts = yaml.safe_load((self.folder / "out" / "run.yaml").read_text())["run"]
        for name in ("history.h5", "contact.h5", "fields.h5", "statistics.h5"):
            with h5py.File(self.folder / "out" / name) as file:
                said = {key: value.decode() if isinstance(value, bytes) else value for key, value in file.attrs.items()}
            self.assertEqual((said["program"], said["version"], said["ranks"]), ("slide", str(facts["version"]), 2),
                             name)
            self.assertEqual(said["mesh_checksum"], facts["mesh_checksum"], name)
            self.assertRegex(said["date"], r"\A\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ\Z")

    def test_contact(self):
        """Gap, vertical velocity and strength, against what the run itself says elsewhere."""
        self.run_scene({**SCENE, "contact_every": 1})
        contact = datasets(self.folder / "out" / "contact.h5")
        self.assertEqual(np.abs(contact["y"]).max(), 0)
        np.testing.assert_array_equal(contact["gap"], contact["u"][:, :, 1])  # the surface is at the bottom
        # v_n = (u_{n+1} - u_{n-1})/2Δt to the order of the scheme (beta2 = 1/2), where nothing hits the surface.
        centred = (contact["u"][2:, :, 1] - contact["u"][:-2, :, 1]) / (2 * 2e-8)
        stays = (contact["status"][:-2] == 0) & (contact["status"][1:-1] == 0) & (contact["status"][2:] == 0)
        self.assertGreater(stays.sum(), 20)
        np.testing.assert_allclose(contact["v_y"][1:-1][stays], centred[stays], rtol=0,
                                   atol=0.02 * np.abs(centred).max())
        touching = contact["status"] > 0
        self.assertTrue(np.all(contact["strength"][~touching] == 0))
        slipping = contact["status"] == 2
        self.assertTrue(np.any(slipping))
        # Regularised threshold: in slip the traction is the strength.
        np.testing.assert_allclose(np.abs(contact["tangential_traction"][slipping]), contact["strength"][slipping],
                                   rtol=1e-12)

    def test_stress_across_the_plane(self):
        """Regions with different Poisson's ratio: zz, von Mises and the principal stresses from the components."""
        block(self.folder / "two.msh", regions=("matrix", "inclusion"))
        self.run_scene({**SCENE, "mesh_file": "two.msh", "material_inclusion_young": 80e9,
                        "material_inclusion_poisson": 0.4, "material_inclusion_density": 1800, "fields_times": "4e-6",
                        "fields_quantities": "stress,von_mises,principal"}, ranks=2)
        fields = datasets(self.folder / "out" / "fields.h5")
        frame = {name[len("frames/00000/"):]: values for name, values in fields.items() if name.startswith("frames")}
        with h5py.File(self.folder / "out" / "fields.h5") as file:
            names = [name.decode() for name in file["mesh/region"].attrs["names"]]
        poisson = np.array([0.4 if name == "inclusion" else 0.25 for name in names])[fields["mesh/region"]]
        xx, yy, xy = frame["stress"].T
        zz = poisson * (xx + yy)
        np.testing.assert_allclose(frame["stress_zz"], zz, rtol=1e-12)
        tensor = np.zeros((len(xx), 3, 3))
        tensor[:, 0, 0], tensor[:, 1, 1], tensor[:, 2, 2] = xx, yy, frame["stress_zz"]
        tensor[:, 0, 1] = tensor[:, 1, 0] = xy
        np.testing.assert_array_equal(frame["stress_tensor"], tensor)
        deviator = tensor - np.trace(tensor, axis1=1, axis2=2)[:, None, None] * np.eye(3) / 3
        scale = np.abs(tensor).max()
        np.testing.assert_allclose(frame["von_mises"], np.sqrt(1.5 * np.sum(deviator**2, axis=(1, 2))),
                                   atol=1e-12 * scale)
        low, high = np.linalg.eigvalsh(tensor[:, :2, :2]).T
        np.testing.assert_allclose(frame["principal_high"], high, atol=1e-12 * scale)
        np.testing.assert_allclose(frame["principal_low"], low, atol=1e-12 * scale)
        shown = (self.folder / "out" / "fields.xdmf").read_text()
        self.assertIn('Name="stress" AttributeType="Tensor"', shown)

    def test_thousands_of_points(self):
        """They start in seconds, and the size that is forecast is that of the file."""
        rng = np.random.default_rng(1)
        points = np.round(rng.uniform(0, 5e-3, (3000, 2)), 7)
        (self.folder / "points.yaml").write_text(f"history_points: [{','.join(f'{x:.7f}' for x in points.ravel())}]\n")
        scene = {"options_file_yaml": "points.yaml", **SCENE, "history_points": None}
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        outcome = self.run_scene(scene)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.assertLess(after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime, 20)  # s of work
        number, unit = re.search(r"output ([\d.]+) (kB|MB|GB)", outcome.out).groups()
        size = sum(file.stat().st_size for file in (self.folder / "out").iterdir() if file.suffix == ".h5")
        self.assertAlmostEqual(float(number) * {"kB": 1e3, "MB": 1e6, "GB": 1e9}[unit] / size, 1, delta=0.25)


class Cadences(InBlock):
    def test_in_seconds(self):
        outcome = self.run_scene({**SCENE, "history_every": None, "history_interval": 1.01e-7, "contact_interval": 4e-7,
                                  "fields_interval": 1e-6})
        self.assertIn("a row of history.h5 every 5 steps (100.0 ns), of contact.h5 every 20 steps (400.0 ns), a frame "
                      "of fields.h5 every 50 steps (1.000 µs)", outcome.out)
        for file, step in (("history.h5", 1e-7), ("contact.h5", 4e-7), ("fields.h5", 1e-6)):
            times = datasets(self.folder / "out" / file)["time"]
            np.testing.assert_allclose(times, step * np.arange(len(times)), rtol=1e-12, atol=1e-20)
            self.assertAlmostEqual(times[-1], 4e-6, delta=1e-15)
        # What the run leaves is a scene.
        self.run_scene({"options_file_yaml": "out/run.yaml", "output_folder": "again"})
        self.assertEqual(len(datasets(self.folder / "again" / "history.h5")["time"]), 41)

    def test_averages_of_the_second_half_have_errors(self):
        self.run_scene(SCENE, history_every=1)
        history = datasets(self.folder / "out" / "history.h5")
        summary = yaml.safe_load((self.folder / "out" / "summary.yaml").read_text())
        late = history["time"] >= 0.5 * history["time"][-1]
        normal, tangential = (history[f"boundary/top/{kind}_force"][late] for kind in ("normal", "tangential"))
        self.assertAlmostEqual(summary["averages_from"], history["time"][late][0], delta=1e-12)
        self.assertEqual(summary["averages_rows"], late.sum())
        load = summary["load"]
        self.assertAlmostEqual(load["mean_friction"] / (tangential.mean() / normal.mean()), 1, delta=1e-5)

        def error(values, blocks):
            length = len(values) // blocks
            means = values[len(values) - blocks * length:].reshape(blocks, length).mean(axis=1)
            return means.std(ddof=1) / np.sqrt(blocks)

        rest = (tangential - tangential.mean() / normal.mean() * normal) / normal.mean()
        self.assertAlmostEqual(load["mean_friction_error"] / max(error(rest, 5), error(rest, 10)), 1, delta=1e-5)
        self.assertAlmostEqual(load["mean_normal_force_error"] / max(error(normal, 5), error(normal, 10)), 1,
                               delta=1e-5)
        self.assertIs(load["settled"], False)  # four microseconds of a block that is being pressed down
        self.assertIn(summary["contact"]["regime"], ("slip", "stick-slip", "slip-separated", "stick-slip-separated"))

    def test_rows_too_sparse_are_noticed(self):
        """Rows further apart than half a period of the strongest vibration."""
        scene = {**SCENE, "time_end": 1e-3, "history_points": None, "contact_every": 1000}
        dense = self.run_scene(scene, history_every=1).out
        self.assertNotIn("alias", dense)
        summary = yaml.safe_load((self.folder / "out" / "summary.yaml").read_text())
        strongest = summary["spectrum_peaks"][0]
        every = int(np.ceil(0.8 / strongest / 2e-8))  # less than two rows in a period
        self.run_scene(scene, history_every=every, output_folder="sparse")
        summary = yaml.safe_load((self.folder / "sparse" / "summary.yaml").read_text())
        self.assertIn("may be an alias of", summary["aliases"])


if __name__ == "__main__":
    unittest.main()
