"""Mistakes in a run of `modes`: one sentence that names the option or the mesh entity, the fault and the cure, exit
code 2 on every rank, no file touched.

SLIPSCALE_RANKS says on how many ranks.
"""

import unittest

from mistakes import RANKS, Mistake, Mistaken
from scenes import block
from squealing import FILES, RUN, Squealing

NO_SURFACE = {name: None for name in RUN if name.startswith(("surface_", "friction_"))}
NO_MEMORY = {"friction_time": None, "friction_threshold": None}


def value(option, wrong, *words, **changes):
    """A value that the option does not take; the sentence must name both."""
    return Mistake([f"-{option} ", str(wrong), *words], {option: wrong, **changes})


MISTAKES = {
    "no surface": Mistake(["no surface is given", "-surface_boundary"], NO_SURFACE),
    "surface at rest": Mistake(["-surface_speed is 0", "give the surface a speed"], {"surface_speed": 0}),
    "no friction": Mistake(["-friction_law none", "coulomb or regularized"],
                           {"friction_law": "none", "friction_coefficient": None, **NO_MEMORY}),
    "nothing touches": Mistake(["boundary 'bottom'", "touches the surface", "-boundary_<boundary>_y"],
                               {"boundary_top_y": 1e-6}),
    "pulled off": Mistake(["nothing of boundary 'bottom' touches"], {"initial_gap": 2e-6}),
    "held by nothing": Mistake(["no steady state", "along x", "-boundary_<boundary>_x fixed"],
                               {"boundary_top_x": None}),
    "plate that the damping leaves out": Mistake(
        ["-boundary_top_mass", "-damping_mass does not damp", "leave out one of them"],
        {"boundary_top_y": "rigid", "boundary_top_ramp": None, "boundary_top_force": 7e4, "boundary_top_mass": 1.0,
         "damping_mass": 1e3}),
    "formula of time": Mistake(["-boundary_top_y is a formula", "slides steadily"], {"boundary_top_y": "-1e-6*sin(t)"}),
    "open side": Mistake(["-boundary_left_absorbing", "modes do not know"], {"boundary_left_absorbing": "true"}),
    "friction that varies": Mistake(["-friction_coefficient is a formula"], {"friction_coefficient": "0.3 + 1e3*t"}),
    "sweep of friction that varies": Mistake(["-modes_coefficient follows modes of one law", "varies along the contact"],
                                             {"friction_coefficient": "0.3 + x/L", "modes_coefficient": "0:0.1:1"}),
    "sweep of a coefficient that falls": Mistake(
        ["-modes_time follows modes", "-friction_law exponential depends on the slip rate"],
        {"friction_law": "exponential", "friction_kinetic": 0.3, "friction_slip_rate": 1, "friction_threshold": None,
         "modes_time": "1e-7:1e-7:1e-6"}),
    "no highest frequency": Mistake(["-modes_to ", "needed here but not given"], {"modes_to": None}),
    "highest frequency far beyond the mesh": Mistake(["-modes_to asks for about", "free components", "below"],
                                                     {"modes_to": 1e12}),
    "more modes than unknowns": Mistake(["-modes_count is 1000", "free components", "at most"],
                                        {"modes_count": 1000}),
    "more real modes than unknowns": Mistake(["-modes_basis is 1000", "free components", "at most"],
                                             {"modes_basis": 1000}),
    "tolerance": value("modes_tolerance", 0.5),
    "count": value("modes_count", 0),
    "sweep of one number": value("modes_coefficient", 0.3, "first:step:last"),
    "sweep downwards": value("modes_coefficient", "1:0.1:0", "ascend"),
    "sweep below zero": value("modes_time", "-1e-6:1e-7:1e-6", "below 0"),
    "sweep without end": value("modes_coefficient", "0:1e-9:1", "more than"),
    "sweep of a memory that is not there": Mistake(["-modes_time has no effect", "-friction_law regularized"],
                                                   {"friction_law": "coulomb", "modes_time": "0:1e-7:1e-6",
                                                    **NO_MEMORY}),
    "sweep of a speed that does nothing": Mistake(["-modes_load_speed has no effect", "-friction_length"],
                                                  {"modes_load_speed": "1:1:4"}),
    "sweep from rest": Mistake(["-modes_load_speed begins with 0"],
                               {"modes_load_speed": "0:1:4", "friction_time": None, "friction_length": 1.2e-6}),
    "step above the stable": Mistake(["-time_step is ", "above the stable step"],
                                     {"modes_scheme": "true", "time_step": 1e-6}),
    "word that nobody knows": Mistake(["-modes_cuont", "-modes_count"], {"modes_cuont": 3}),
}


class Refusals(Mistaken, Squealing):
    program, options, files, mistakes = "modes", RUN, FILES, MISTAKES

    def setUp(self):
        super().setUp()
        self.material = self.folder / "material"
        self.material.mkdir()
        block(self.material / "block.msh")

    def check_without_mistakes(self):
        self.run_modes(mesh_file="material/block.msh", ranks=RANKS)


if __name__ == "__main__":
    unittest.main()
