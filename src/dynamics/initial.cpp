#include <cmath>
#include <numbers>

#include "slipscale/contact/surface.hpp"
#include "slipscale/dynamics/conditions.hpp"

namespace slipscale {
namespace {

void refuse_unless_uniform(const std::vector<Material>& materials) {
  for (const Material& material : materials) {
    const Eigen::Matrix3d &c = material.stiffness, &first = materials.front().stiffness;
    if (c(1, 1) != first(1, 1) || c(2, 2) != first(2, 2) || c(0, 1) != first(0, 1) || c(1, 2) != 0 ||
        c(0, 2) != 0)
      throw UserError(
          "-initial_pressure and -initial_shear describe a uniform state, but the materials of the regions "
          "differ or couple shear to stretch; load the body through -boundary_<boundary>_pressure instead");
  }
}

}  // namespace

Schema initial_schema() {
  return {
      {"initial_velocity", Kind::reals, "m/s", "0,0", range::any,
       "velocity of the whole body at the start, vx,vy"},
      {"initial_sine_amplitude", Kind::real, "m/s", "0", range::any,
       "adds v_x = amplitude cos(2 pi x/wavelength)(1-y/H)^2 at the start, for stability studies"},
      {"initial_sine_wavelength", Kind::real, "m", required, range::positive, "its wavelength"},
      {"initial_gap", Kind::real, "m", "0", range::non_negative,
       "lifts the body off the surface at the start"},
      {"initial_pressure", Kind::real, "Pa", "0", range::any,
       "starts from the uniform state u_y = -p y/C22; friction remembers this pressure"},
      {"initial_shear", Kind::real, "Pa", "0", range::any,
       "starts from the uniform state u_x = tau(H-y)/C66; friction remembers this traction"},
  };
}

InitialState read_initial(const Options& options) {
  InitialState initial;
  const auto velocity = options.reals("initial_velocity");
  if (velocity.size() != 2) throw UserError("-initial_velocity needs two numbers vx,vy in m/s");
  initial.velocity = {velocity[0], velocity[1]};
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
  initial.pressure = options.real("initial_pressure");
  initial.shear = options.real("initial_shear");
  return initial;
}

void set_initial(const InitialState& initial, const Mesh& mesh, const std::vector<Material>& materials,
                 Vector2* displacement, Vector2* velocity) {
  if (initial.pressure != 0 || initial.shear != 0) refuse_unless_uniform(materials);
  const double bottom = mesh.lower[1], height = mesh.upper[1] - bottom;
  for (int i = 0; i < mesh.nodes.size(); ++i) {
    const double x = mesh.nodes.position[i][0], y = mesh.nodes.position[i][1] - bottom;
    displacement[i] = {initial.shear * (height - y) / materials.front().c66(),
                       initial.gap - initial.pressure * y / materials.front().c22()};
    if (i >= mesh.nodes.owned) continue;
    velocity[i] = initial.velocity;
    if (initial.amplitude != 0) {
      const double depth = 1 - y / height;
      velocity[i][0] +=
          initial.amplitude * std::cos(2 * std::numbers::pi * x / initial.wavelength) * depth * depth;
    }
  }
}

}  // namespace slipscale
