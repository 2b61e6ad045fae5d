#include "slipscale/dynamics/conditions.hpp"

#include <cmath>
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
  return *displacement == 0 ? "fixed" : format("{:g} m", *displacement);
}

/// Whether some edge of the boundary faces along x, along y. Collective.
std::array<bool, 2> facing(const Mesh& mesh, const Boundary& boundary) {
  int found[2] = {0, 0};
  for (const BoundaryEdge& edge : boundary.edges)
    for (int axis = 0; axis < 2; ++axis)  // rounding tilts a straight side by far less
      found[axis] |= std::abs(edge.outward[axis]) > 1e-6 * std::hypot(edge.outward[0], edge.outward[1]);
  MPI_Allreduce(MPI_IN_PLACE, found, 2, MPI_INT, MPI_MAX,
                PetscObjectComm(reinterpret_cast<PetscObject>(mesh.dm.get())));
  return {found[0] != 0, found[1] != 0};
}

/// A traction moves nothing where the motion along it is prescribed.
void read_tractions(const Options& options, const Mesh& mesh, const Boundary& boundary,
                    BoundaryCondition& condition) {
  const std::string prefix = "boundary_" + boundary.name + "_";
  const auto& held = condition.displacement;
  const Idle idle{"where the motion along it is prescribed",
                  "leave the boundary free along it",
                  {prefix + "x", prefix + "y"}};
  if (held[0])
    options.refuse_idle({prefix + "shear"}, idle);
  else
    condition.shear = options.real(prefix + "shear");
  const auto faces = facing(mesh, boundary);
  if ((held[0] || !faces[0]) && (held[1] || !faces[1]))
    options.refuse_idle({prefix + "pressure"}, idle);
  else
    condition.pressure = options.real(prefix + "pressure");
}

void read_ramp(const Options& options, const std::string& prefix, BoundaryCondition& condition) {
  const auto moves = [](const std::optional<double>& displacement) { return displacement.value_or(0) != 0; };
  if (moves(condition.displacement[0]) || moves(condition.displacement[1]) || condition.pressure != 0 ||
      condition.shear != 0)
    condition.ramp = options.real(prefix + "ramp");
  else
    options.refuse_idle({prefix + "ramp"},
                        {"where no displacement, pressure or shear is imposed",
                         "impose one",
                         {prefix + "x", prefix + "y", prefix + "pressure", prefix + "shear"}});
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
      throw UserError("-" + prefix + "…: boundary '" + boundary.name +
                      "' lies inside the body (a periodic seam or an interface), where no condition can act; "
                      "remove it, or open the periodic sides with -mesh_periodic false");
    BoundaryCondition condition{boundary.name, {}, 0, 0, 0};
    condition.displacement = {prescribed(options, prefix + "x"), prescribed(options, prefix + "y")};
    read_tractions(options, mesh, boundary, condition);
    read_ramp(options, prefix, condition);
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
