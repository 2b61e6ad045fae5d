#include "slipscale/contact/surface.hpp"

#include <cmath>
#include <numbers>

#include "slipscale/base/cosine_ramp.hpp"
#include "slipscale/base/physical_range.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {

double Surface::velocity(double time) const {
  const double level = speed * cosine_ramp(time, ramp);
  return speed_formula ? level * (*speed_formula)(time) : level;
}

double Surface::travel(double from, double to) const {
  if (!speed_formula) return travel(to) - travel(from);
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from), outer = half * std::sqrt(0.6);
  return half / 9 * (5 * velocity(middle - outer) + 8 * velocity(middle) + 5 * velocity(middle + outer));
}

double Surface::travel(double time) const {
  if (time >= ramp) return speed * (time - 0.5 * ramp);
  return 0.5 * speed * (time - ramp / std::numbers::pi * std::sin(std::numbers::pi * time / ramp));
}

Schema surface_schema() {
  return {
      {"surface_boundary", Kind::text, "", absent, range::any,
       "the body's boundary that meets the rigid surface; without it there is no surface"},
      {"surface_height", Kind::real, "m", "0", range::or_formula(range::physical, "xt"),
       "height of the rigid surface; a profile of small slopes that moves with it is a formula of x-V*t"},
      {"surface_speed", Kind::real, "m/s", required, range::or_formula(range::physical, "t"),
       "speed of the surface along +x, V"},
      {"surface_speed_ramp", Kind::real, "s", "0", range::physical_non_negative,
       "time in which the surface reaches its speed, along a cosine"},
  };
}

const Idle without_surface{"without -surface_boundary", "name the boundary that meets the surface"};

bool has_surface(const Options& options) { return options.given("surface_boundary"); }

Surface read_surface(const Options& options) {
  const Quantity height = options.quantity("surface_height"), speed = options.quantity("surface_speed");
  Surface surface{
      options.text("surface_boundary"), height.number, speed.number, 0, height.formula, speed.formula};
  if (!surface.moves())
    options.refuse_idle({"surface_speed_ramp"},
                        {"with -surface_speed 0", "give the surface a speed", {"surface_speed"}});
  else
    surface.ramp = options.real("surface_speed_ramp");
  return surface;
}

std::string describe(const Surface& surface) {
  const auto value = [](double number, const SharedFormula& formula, const char* unit) {
    return (formula ? formula->text() : format("{:g}", number)) + unit;
  };
  return "surface below " + surface.boundary + ": height " +
         value(surface.height, surface.height_formula, " m") + ", speed " +
         value(surface.speed, surface.speed_formula, " m/s");
}

}  // namespace slipscale
