#pragma once

#include <gtest/gtest.h>
#include <petscsys.h>

#include <map>
#include <set>
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
        {"material_<region>_poisson",
         Kind::real,
         "1",
         absent,
         {"> -1 and < 0.5", [](double x) { return x > -1 && x < 0.5; }},
         "Poisson's ratio."},
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

  /// Puts options into PETSc's database; a null value is an option without value.
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
  /// The sentence the user sees for one option alone, of a mesh with these names.
  static std::string answer(const std::string& name, const char* value) {
    slipscale::petsc(PetscOptionsClear(nullptr));
    give({{name, value}});
    return sentence([] {
      slipscale::Options read = options();
      read.know_names("region", {"matrix", "my_fibre", "steel", "Matrix_b"});
      read.know_names("boundary", {"top"});
    });
  }
  /// Asks for every option of the schema but those, as the readers of a program do between them.
  static void ask_for_all(const slipscale::Options& read, const std::set<std::string>& but = {}) {
    for (const std::string& name : slipscale::names_in(schema(), "", "top"))
      if (!but.contains(name)) (void)read.given(name);
  }
};
