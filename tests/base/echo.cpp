// A program of the usual make with nothing in it: prints what it was told. `program.sh` looks at it from
// outside.
#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/base/program.hpp"

using namespace slipscale;

int main(int argc, char** argv) {
  const Schema schema = {
      {"friction_coefficient", Kind::real, "1", "0.25", range::non_negative,
       "Coulomb's coefficient of friction."},
      {"friction_law", Kind::text, "", "none", range::one_of({"none", "coulomb", "regularized"}),
       "Friction law."},
      {"material_<region>_young", Kind::real, "Pa", absent, range::positive, "Young's modulus."},
      {"history_every", Kind::integer, "1", "1", range::at_least_one,
       "Steps between two rows of history.h5."},
      {"history_points", Kind::reals, "m", "", range::any, "Probe points x1,y1,x2,y2,…"},
      {"mesh_file", Kind::text, "", absent, range::any, "The mesh, MSH 4.1."},
      {"fail", Kind::text, "", "none", range::one_of({"none", "user", "library", "petsc", "other"}),
       "How to fail."},
      {"run_<entry>", Kind::text, "", absent, range::any, "Written by echo into run.yaml, ignored."},
  };
  const auto body = [](Options& options) {
    options.know_names("region", {"matrix", "Fibre"});
    print(format("coefficient {:g}\n", options.real("friction_coefficient")));
    print(format("every {}\n", static_cast<int>(options.integer("history_every"))));
    if (const auto young = options.find_real("material_Fibre_young")) print(format("young {:g}\n", *young));
    const std::string fail = options.text("fail");
    options.refuse_unknown();
    if (fail == "user") throw UserError("the mesh has a hole; mend it");
    if (fail == "library") throw LibraryError("METIS gave up");
    if (fail == "petsc") petsc(PetscOptionsPrefixPop(nullptr));
    if (fail == "other") throw std::out_of_range("an index");
  };
  return run_program(argc, argv, {"echo", "Prints what it was told.", schema, body});
}
