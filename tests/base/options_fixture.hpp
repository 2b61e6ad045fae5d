#pragma once

#include <gtest/gtest.h>
#include <petscsys.h>

#include <map>
#include <string>

#include "slipscale/base/error.hpp"
#include "slipscale/base/options.hpp"

/// Options of a small schema over a database that holds what a test puts there.
class OptionsTest : public testing::Test {
 protected:
  void SetUp() override { slipscale::petsc(PetscOptionsClear(nullptr)); }
  void TearDown() override { slipscale::petsc(PetscOptionsClear(nullptr)); }

  static slipscale::Schema schema() {
    using namespace slipscale;
    return {
        {"friction_coefficient", Kind::real, "1", required, range::non_negative, "Coulomb's coefficient."},
        {"friction_law", Kind::text, "", "none", range::one_of({"none", "coulomb"}), "Friction law."},
        {"material_<region>_young", Kind::real, "Pa", absent, range::positive, "Young's modulus."},
        {"material_<region>_poisson", Kind::real, "1", absent, range::poisson, "Poisson's ratio."},
        {"boundary_<boundary>_x", Kind::text, "m", "free",
         range::one_of_or_number({"free", "fixed"}, range::any), "Motion along x."},
        {"boundary_<boundary>_pressure", Kind::real, "Pa", "0", range::any, "Pressure."},
        {"time_step", Kind::text, "s", "auto", range::one_of_or_number({"auto"}, range::positive), "Step."},
        {"history_every", Kind::integer, "1", "10", range::at_least_one, "Steps between rows."},
        {"history_points", Kind::reals, "m", "", range::any, "Probe points."},
        {"body_acceleration", Kind::reals, "m/s^2", "0,0", range::any, "Gravity."},
        {"initial_gap", Kind::real, "m", absent, range::non_negative, "Gap."},
        {"mesh_file", Kind::text, "", required, range::any, "The mesh."},
        {"relocalize_correction", Kind::flag, "", "false", range::any, "Corrects."},
        {"run_<entry>", Kind::text, "", absent, range::any, "Written by the program, ignored."},
    };
  }

  /// Puts options into the database; a null value is an option without value.
  static void give(const std::map<std::string, const char*>& values) {
    for (const auto& [name, value] : values)
      slipscale::petsc(PetscOptionsSetValue(nullptr, ("-" + name).c_str(), value));
  }
  static slipscale::Options options() { return slipscale::Options("slide", schema()); }

  /// The sentence of the `UserError` that `action` throws; empty when it throws none.
  static std::string sentence(const auto& action) {
    try {
      action();
    } catch (const slipscale::UserError& error) {
      return error.what();
    }
    return "";
  }
  /// The sentence the user sees for one option alone.
  static std::string answer(const std::string& name, const char* value) {
    slipscale::petsc(PetscOptionsClear(nullptr));
    give({{name, value}});
    return sentence([] { (void)options(); });
  }
};
