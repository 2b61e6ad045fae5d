#include "slipscale/contact/surface.hpp"

#include <cmath>
#include <numbers>

#include "slipscale/base/cosine_ramp.hpp"
#include "slipscale/base/physical_range.hpp"

namespace slipscale {

double Surface::velocity(double time) const { return speed * cosine_ramp(time, ramp); }

double Surface::travel(double time) const {
  if (time >= ramp) return speed * (time - 0.5 * ramp);
  return 0.5 * speed * (time - ramp / std::numbers::pi * std::sin(std::numbers::pi * time / ramp));
}

Schema surface_schema() {
  return {
      {"surface_boundary", Kind::text, "", absent, range::any,
       "the body's boundary that meets the rigid surface; without it there is no surface"},
      {"surface_height", Kind::real, "m", "0", range::physical, "height of the rigid surface"},
      {"surface_speed", Kind::real, "m/s", required, range::physical, "speed of the surface along +x, V"},
      {"surface_speed_ramp", Kind::real, "s", "0", range::physical_non_negative,
       "time in which the surface reaches its speed, along a cosine"},
  };
}

const Idle without_surface{"without -surface_boundary", "name the boundary that meets the surface"};

bool has_surface(const Options& options) { return options.given("surface_boundary"); }

Surface read_surface(const Options& options) {
  Surface surface{options.text("surface_boundary"), options.real("surface_height"),
                  options.real("surface_speed"), 0};
  if (surface.speed == 0)
    options.refuse_idle({"surface_speed_ramp"},
                        {"with -surface_speed 0", "give the surface a speed", {"surface_speed"}});
  else
    surface.ramp = options.real("surface_speed_ramp");
  return surface;
}

}  // namespace slipscale
