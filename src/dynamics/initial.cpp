#include <cmath>
#include <numbers>
#include <numeric>

#include "slipscale/base/physical_range.hpp"
#include "slipscale/contact/surface.hpp"
#include "slipscale/dynamics/conditions.hpp"
#include "slipscale/dynamics/formulas.hpp"

namespace slipscale {
namespace {

void refuse_unless_uniform(const std::vector<Material>& materials) {
  for (const Material& material : materials) {
    const Eigen::Matrix3d &c = material.stiffness, &first = materials.front().stiffness;
    if (c(1, 1) != first(1, 1) || c(2, 2) != first(2, 2) || c(0, 1) != first(0, 1) || c(1, 2) != 0 ||
        c(0, 2) != 0 || material.grading)
      throw UserError(
          "-initial_pressure and -initial_shear describe a uniform state, but the materials of the regions "
          "differ, are graded or couple shear to stretch; load the body through "
          "-boundary_<boundary>_pressure instead");
  }
}

}  // namespace

Schema initial_schema() {
  const Range of_place = range::or_formula(range::physical, "xy");
  return {
      {"initial_velocity", Kind::reals, "m/s", "0,0", of_place,
       "velocity of the whole body at the start, vx,vy"},
      {"initial_displacement", Kind::reals, "m", "0,0", of_place,
       "displacement at the start, ux,uy, added to that of the gap and of the uniform state; need not be in "
       "equilibrium"},
      {"initial_file", Kind::text, "", absent, range::any,
       "displacement and velocity at the start from a file, added to the others: fields.h5 of a run, or its "
       "folder, on any mesh that holds every node (1e-6 of its size is let pass), interpolated with the "
       "shape "
       "functions of its cells; or a table .csv with columns x,y (m) and any of ux,uy (or u,v; m), vx,vy "
       "(m/s) "
       "at the points of a grid, bilinear between them. Friction starts without memory of it"},
      {"initial_time", Kind::real, "s", absent, range::physical_non_negative,
       "the frame of initial_file; the last one without"},
      {"initial_rotation", Kind::real, "rad/s", "0", range::physical,
       "turns the body counter-clockwise about the middle of the block at the start, added to the velocity"},
      {"initial_sine_amplitude", Kind::real, "m/s", "0", range::physical,
       "adds v_x = amplitude cos(2 pi x/wavelength)(1-y/H)^2 at the start, for stability studies"},
      {"initial_sine_wavelength", Kind::real, "m", required, range::physical_positive, "its wavelength"},
      {"initial_gap", Kind::real, "m", "0", range::physical_non_negative,
       "lifts the body off the surface at the start"},
      {"initial_pressure", Kind::real, "Pa", "0", of_place,
       "starts from the uniform state u_y = -p y/C22; friction remembers this pressure"},
      {"initial_shear", Kind::real, "Pa", "0", of_place,
       "starts from the uniform state u_x = tau(H-y)/C66; friction remembers this traction"},
  };
}

InitialState read_initial(const Options& options, const Mesh& mesh) {
  InitialState initial;
  std::vector<int> nodes(static_cast<std::size_t>(mesh.nodes.owned));
  std::iota(nodes.begin(), nodes.end(), 0);
  const auto read = [&](const std::string& name, const std::string& wanted) {
    const auto found = options.quantities(name);
    if (found.size() != 2) throw UserError("-" + name + " needs two numbers or formulas " + wanted);
    for (const Quantity& quantity : found) check_at(options, name, quantity, mesh, nodes);
    return std::array{found[0], found[1]};
  };
  const auto velocity = read("initial_velocity", "vx,vy in m/s");
  for (int axis = 0; axis < 2; ++axis) {
    initial.velocity[axis] = velocity[axis].number;
    initial.velocity_formula[axis] = velocity[axis].formula;
  }
  initial.displacement = read("initial_displacement", "ux,uy in m");
  initial.file = options.find_text("initial_file").value_or("");
  if (initial.file.empty())
    options.refuse_idle({"initial_time"}, {"without -initial_file", "give the file", {}});
  else if (initial.file.ends_with(".csv"))
    options.refuse_idle({"initial_time"}, {"with a table", "give a fields.h5", {"initial_file"}});
  initial.file_time = options.find_real("initial_time");
  initial.rotation = options.real("initial_rotation");
  initial.amplitude = options.real("initial_sine_amplitude");
  if (initial.amplitude != 0)
    initial.wavelength = options.real("initial_sine_wavelength");
  else
    options.refuse_idle(
        {"initial_sine_wavelength"},
        {"without -initial_sine_amplitude", "give the amplitude", {"initial_sine_amplitude"}});
  if (has_surface(options))
    initial.gap = options.real("initial_gap");
  else
    options.refuse_idle({"initial_gap"}, without_surface);
  const Quantity pressure = quantity_at(options, "initial_pressure", mesh, nodes),
                 shear = quantity_at(options, "initial_shear", mesh, nodes);
  initial.pressure = pressure.number;
  initial.pressure_formula = pressure.formula;
  initial.shear = shear.number;
  initial.shear_formula = shear.formula;
  return initial;
}

void set_initial(const InitialState& initial, const Mesh& mesh, const std::vector<Material>& materials,
                 Vector2* displacement, Vector2* velocity) {
  if (initial.pressure != 0 || initial.shear != 0) refuse_unless_uniform(materials);
  if (initial.rotation != 0 && (mesh.periodic[0] || mesh.periodic[1]))
    throw UserError(
        "-initial_rotation turns the body, which a periodic one cannot follow; remove it, or open the "
        "periodic "
        "sides with -mesh_periodic false");
  const Vector2 middle{0.5 * (mesh.lower[0] + mesh.upper[0]), 0.5 * (mesh.lower[1] + mesh.upper[1])};
  const double bottom = mesh.lower[1], height = mesh.upper[1] - bottom;
  for (int i = 0; i < mesh.nodes.size(); ++i) {
    const double x = mesh.nodes.position[i][0], y = mesh.nodes.position[i][1] - bottom;
    const Vector2& place = mesh.nodes.position[i];
    const double shear = initial.shear_at_start().at(place, 0),
                 pressure = initial.pressure_at_start().at(place, 0);
    displacement[i] = {shear * (height - y) / materials.front().c66(),
                       initial.gap - pressure * y / materials.front().c22()};
    for (int axis = 0; axis < 2; ++axis)
      if (!initial.displacement[axis].is_zero())
        displacement[i][axis] += initial.displacement[axis].at(place, 0);
    if (initial.fields)
      for (int axis = 0; axis < 2; ++axis) displacement[i][axis] += initial.fields->displacement[i][axis];
    if (i >= mesh.nodes.owned) continue;
    for (int axis = 0; axis < 2; ++axis)
      velocity[i][axis] = Quantity{initial.velocity[axis], initial.velocity_formula[axis]}.at(place, 0);
    if (initial.fields)
      for (int axis = 0; axis < 2; ++axis) velocity[i][axis] += initial.fields->velocity[i][axis];
    if (initial.rotation != 0) {
      velocity[i][0] -= initial.rotation * (mesh.nodes.position[i][1] - middle[1]);
      velocity[i][1] += initial.rotation * (mesh.nodes.position[i][0] - middle[0]);
    }
    if (initial.amplitude != 0) {
      const double depth = 1 - y / height;
      velocity[i][0] +=
          initial.amplitude * std::cos(2 * std::numbers::pi * x / initial.wavelength) * depth * depth;
    }
  }
}

}  // namespace slipscale
