#include "slipscale/dynamics/conditions.hpp"

#include <algorithm>
#include <cmath>

#include "slipscale/base/physical_range.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/dynamics/formulas.hpp"

namespace slipscale {
namespace {

using Straight = BoundaryCondition::Straight;

const Range along_x = range::or_formula(range::one_of_or_number({"free", "fixed"}, range::physical), "xyt");
const Range along_y =
    range::or_formula(range::one_of_or_number({"free", "fixed", "rigid", "tilting"}, range::physical), "xyt");
const Range traction = range::or_formula(range::physical, "xyt");

/// Sides that face along an axis by less than this part of their length do not face along it at all: that is
/// far more than rounding tilts a straight side.
constexpr double aslant = 1e-6;

/// The displacement that is imposed along an axis, and whether the side is kept straight instead.
void read_motion(const Options& options, const Mesh& mesh, const Boundary& boundary,
                 BoundaryCondition& condition) {
  for (const int axis : {0, 1}) {
    const std::string name = "boundary_" + boundary.name + (axis == 0 ? "_x" : "_y"),
                      text = options.text(name);
    if (text == "rigid") condition.straight = Straight::rigid;
    if (text == "tilting") condition.straight = Straight::tilting;
    if (text == "free" || (axis == 1 && condition.is_straight())) continue;
    condition.displacement[axis] = 0;
    if (text == "fixed") continue;
    const Quantity imposed = quantity_at(options, name, mesh, boundary.nodes);
    condition.displacement[axis] = imposed.number;
    condition.displacement_formula[axis] = imposed.formula;
  }
}

std::string component_text(const BoundaryCondition& condition, int axis) {
  if (!condition.displacement[axis]) return "free";
  const Quantity imposed = condition.imposed(axis);
  if (imposed.formula) return describe(imposed, "m");
  return imposed.number == 0 ? "fixed" : format("{:g} m", imposed.number);
}

/// Whether some edge of the boundary faces along x, along y. Collective.
std::array<bool, 2> facing(const Mesh& mesh, const Boundary& boundary) {
  int found[2] = {0, 0};
  for (const BoundaryEdge& edge : boundary.edges)
    for (int axis = 0; axis < 2; ++axis)
      found[axis] |= std::abs(edge.outward[axis]) > aslant * std::hypot(edge.outward[0], edge.outward[1]);
  MPI_Allreduce(MPI_IN_PLACE, found, 2, MPI_INT, MPI_MAX, mesh.comm);
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
  const auto read = [&](const char* name, double& number, SharedFormula& formula) {
    const Quantity quantity = quantity_at(options, prefix + name, mesh, boundary.nodes);
    number = quantity.number;
    formula = quantity.formula;
  };
  if (held[0])
    options.refuse_idle({prefix + "shear"}, idle);
  else
    read("shear", condition.shear, condition.shear_formula);
  const auto faces = facing(mesh, boundary);
  if ((held[0] || !faces[0]) && (held[1] || !faces[1]))
    options.refuse_idle({prefix + "pressure"}, idle);
  else
    read("pressure", condition.pressure, condition.pressure_formula);
}

/// What presses a straight side: a force is > 0 in compression, as pressure is, so its direction is that
/// against which the side faces.
void read_plate(const Options& options, const Mesh& mesh, const Boundary& boundary,
                BoundaryCondition& condition) {
  const std::string prefix = "boundary_" + boundary.name + "_";
  if (!condition.is_straight()) {
    options.refuse_idle(
        {prefix + "force", prefix + "mass"},
        {"on a side that is not kept straight", "give -" + prefix + "y rigid", {prefix + "y"}});
    return;
  }
  if (!(std::abs(boundary.normal[1]) > aslant))
    throw UserError("-" + prefix + "y keeps a side straight that is pressed along y, but boundary '" +
                    boundary.name + "' faces along x; make it free, fixed or a displacement");
  if (condition.straight == Straight::tilting && mesh.periodic[0])
    throw UserError("-" + prefix + "y tilting turns the side, which a body that is periodic along x cannot " +
                    "follow; give rigid, or open the periodic sides with -mesh_periodic false");
  const Quantity force = quantity_at(options, prefix + "force", mesh, boundary.nodes);
  condition.plate_force = (boundary.normal[1] > 0 ? -1 : 1) * force.number;
  condition.force_formula = force.formula;
  condition.plate_mass = options.real(prefix + "mass");
}

void read_absorbing(const Options& options, const std::string& prefix, BoundaryCondition& condition) {
  const bool held = condition.displacement[0] || condition.displacement[1] || condition.is_straight();
  if (held)
    options.refuse_idle({prefix + "absorbing"},
                        {"on a side whose motion is prescribed or that is kept straight",
                         "leave it free along x and y",
                         {prefix + "x", prefix + "y"}});
  else
    condition.absorbing = options.flag(prefix + "absorbing");
}

void read_ramp(const Options& options, const std::string& prefix, BoundaryCondition& condition) {
  const auto moves = [](const std::optional<double>& displacement) { return displacement.value_or(0) != 0; };
  if (moves(condition.displacement[0]) || moves(condition.displacement[1]) || condition.pressure != 0 ||
      condition.shear != 0 || condition.plate_force != 0)
    condition.ramp = options.real(prefix + "ramp");
  else
    options.refuse_idle({prefix + "ramp"},
                        {"where no displacement, pressure, shear or force is imposed", "impose one",
                         names_in(boundary_schema(), "boundary_", condition.boundary)});
}

}  // namespace

Schema boundary_schema() {
  return {
      {"boundary_<boundary>_x", Kind::text, "m", "free", along_x,
       "free, fixed at its initial value, or the displacement along x that is imposed"},
      {"boundary_<boundary>_y", Kind::text, "m", "free", along_y,
       "the same along y; rigid keeps the side straight and level, tilting straight, under a force"},
      {"boundary_<boundary>_force", Kind::real, "N/m", "0", range::or_formula(range::physical, "t"),
       "force along y on a rigid or tilting side, at its middle, per metre of depth, > 0 compresses"},
      {"boundary_<boundary>_mass", Kind::real, "kg/m", "0", range::physical_non_negative,
       "mass of the plate that keeps it straight, per metre of depth; its weight belongs to the force"},
      {"boundary_<boundary>_pressure", Kind::real, "Pa", "0", traction, "pressure on it, > 0 compresses"},
      {"boundary_<boundary>_shear", Kind::real, "Pa", "0", traction,
       "tangential traction on the body along +x"},
      {"boundary_<boundary>_absorbing", Kind::flag, "", "false", range::any,
       "true lets waves out, by dampers; it carries the traction of initial_pressure and initial_shear "
       "unless a "
       "pressure or shear of its own is given, and yields to any other lasting load"},
      {"boundary_<boundary>_ramp", Kind::real, "s", "0", range::non_negative,
       "time in which its displacements, tractions and force reach their values, 0.5(1-cos(pi t/ramp)), then "
       "held; a formula is multiplied by it"},
  };
}

std::vector<BoundaryCondition> read_conditions(const Options& options, const Mesh& mesh) {
  std::vector<BoundaryCondition> conditions;
  for (const Boundary& boundary : mesh.boundaries) {
    const std::string prefix = "boundary_" + boundary.name + "_";
    const auto names = names_in(boundary_schema(), "boundary_", boundary.name);
    if (std::ranges::none_of(names, [&](const auto& name) { return options.given(name); })) continue;
    if (boundary.interior)
      throw UserError("-" + prefix + "…: boundary '" + boundary.name +
                      "' lies inside the body (a periodic seam or an interface), where no condition can act; "
                      "remove it, or open the periodic sides with -mesh_periodic false");
    BoundaryCondition condition;
    condition.boundary = boundary.name;
    read_motion(options, mesh, boundary, condition);
    read_tractions(options, mesh, boundary, condition);
    read_plate(options, mesh, boundary, condition);
    read_absorbing(options, prefix, condition);
    read_ramp(options, prefix, condition);
    conditions.push_back(condition);
  }
  return conditions;
}

std::string describe(const BoundaryCondition& condition) {
  std::string text = "x " + component_text(condition, 0) + ", y ";
  if (condition.is_straight())
    text += std::string(condition.straight == Straight::rigid ? "rigid" : "tilting") + ", force along +y " +
            engineering(condition.plate_force, "N/m") +
            (condition.force_formula ? " times " + condition.force_formula->text() : "") +
            format(", plate {:g} kg/m", condition.plate_mass);
  else
    text += component_text(condition, 1);
  if (condition.absorbing) text += ", absorbing";
  if (condition.pressure != 0)
    text += ", pressure " + describe({condition.pressure, condition.pressure_formula}, "Pa");
  if (condition.shear != 0) text += ", shear " + describe({condition.shear, condition.shear_formula}, "Pa");
  if (condition.ramp != 0) text += ", ramp " + engineering(condition.ramp, "s");
  return text;
}

}  // namespace slipscale
