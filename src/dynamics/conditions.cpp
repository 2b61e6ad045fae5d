#include "slipscale/dynamics/conditions.hpp"

#include <cstdlib>

#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

const Range component = range::one_of_or_number({"free", "fixed"}, range::any);

std::optional<double> prescribed(const Options& options, const std::string& name) {
  const std::string text = options.text(name);
  if (text == "free") return std::nullopt;
  return text == "fixed" ? 0.0 : std::strtod(text.c_str(), nullptr);
}

std::string component_text(const std::optional<double>& displacement) {
  if (!displacement) return "free";
  return *displacement == 0 ? "fixed" : format("%g m", *displacement);
}

}  // namespace

Schema boundary_schema() {
  return {
      {"boundary_<boundary>_x", Kind::text, "m", "free", component,
       "free, fixed at its initial value, or the displacement along x that is imposed"},
      {"boundary_<boundary>_y", Kind::text, "m", "free", component, "the same along y"},
      {"boundary_<boundary>_pressure", Kind::real, "Pa", "0", range::any, "pressure on it, > 0 compresses"},
      {"boundary_<boundary>_shear", Kind::real, "Pa", "0", range::any,
       "tangential traction on the body along +x"},
      {"boundary_<boundary>_ramp", Kind::real, "s", "0", range::non_negative,
       "time in which its displacements and tractions reach their values, 0.5(1-cos(pi t/ramp)), then held"},
  };
}

std::vector<BoundaryCondition> read_conditions(const Options& options, const Mesh& mesh) {
  std::vector<BoundaryCondition> conditions;
  for (const Boundary& boundary : mesh.boundaries) {
    const std::string prefix = "boundary_" + boundary.name + "_";
    bool any = false;
    for (const char* key : {"x", "y", "pressure", "shear", "ramp"}) any = any || options.given(prefix + key);
    if (!any) continue;
    if (boundary.interior)
      throw UserError(
          "-" + prefix + "…: boundary '" + boundary.name +
          "' lies inside the body (a periodic seam or an interface), where no condition can act; remove it");
    BoundaryCondition condition{boundary.name, {}, 0, 0, 0};
    condition.displacement = {prescribed(options, prefix + "x"), prescribed(options, prefix + "y")};
    condition.pressure = options.real(prefix + "pressure");
    condition.shear = options.real(prefix + "shear");
    condition.ramp = options.real(prefix + "ramp");
    conditions.push_back(condition);
  }
  return conditions;
}

std::string describe(const BoundaryCondition& condition) {
  std::string text =
      "x " + component_text(condition.displacement[0]) + ", y " + component_text(condition.displacement[1]);
  if (condition.pressure != 0) text += ", pressure " + engineering(condition.pressure, "Pa");
  if (condition.shear != 0) text += ", shear " + engineering(condition.shear, "Pa");
  if (condition.ramp != 0) text += ", ramp " + engineering(condition.ramp, "s");
  return text;
}

}  // namespace slipscale
