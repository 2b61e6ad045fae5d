#include "slipscale/files/interface_choice.hpp"

#include <algorithm>

#include "slipscale/base/error.hpp"
#include "slipscale/base/physical_range.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {

double InterfaceStrength::index(double normal_traction, double shear_traction) const {
  const double open = std::max(normal_traction, 0.0) / normal, slid = shear_traction / shear;
  return open * open + slid * slid;
}

Schema interface_schema() {
  return {
      {"interfaces_region", Kind::text, "", absent, range::any,
       "region whose connected parts are the inclusions: writes interfaces.h5, the tractions along their "
       "interfaces over time, and interfaces.yaml, their peaks"},
      {"interfaces_normal_strength", Kind::real, "Pa", absent, range::physical_positive,
       "tension that debonds an interface; with the next gives the debonding index (<normal>/strength)^2 + "
       "(shear/strength)^2"},
      {"interfaces_shear_strength", Kind::real, "Pa", absent, range::physical_positive,
       "shear traction that debonds it"}};
}

std::optional<InterfaceChoice> read_interfaces(const Options& options, const std::vector<std::string>& more) {
  const auto region = options.find_text("interfaces_region");
  if (!region) {
    std::vector<std::string> idle{"interfaces_normal_strength", "interfaces_shear_strength"};
    idle.insert(idle.end(), more.begin(), more.end());
    options.refuse_idle(idle, {"without -interfaces_region", "name the region of the inclusions"});
    return std::nullopt;
  }
  const auto normal = options.find_real("interfaces_normal_strength"),
             shear = options.find_real("interfaces_shear_strength");
  if (normal.has_value() != shear.has_value())
    throw UserError(std::string("-interfaces_") + (normal ? "normal" : "shear") +
                    "_strength without -interfaces_" + (normal ? "shear" : "normal") +
                    "_strength; the debonding index takes both, so give the other");
  InterfaceChoice choice{*region, std::nullopt};
  if (normal) choice.strength = InterfaceStrength{*normal, *shear};
  return choice;
}

int inclusions_region(const std::string& region, const std::vector<std::string>& regions) {
  const auto found = std::ranges::find(regions, region);
  std::string names;
  for (const std::string& name : regions) names += (names.empty() ? "'" : ", '") + name + "'";
  if (found == regions.end())
    throw UserError("-interfaces_region is " + region + ", but the mesh has the regions " + names +
                    "; name the one that the inclusions are of");
  if (regions.size() == 1)
    throw UserError(
        "-interfaces_region is " + region +
        ", the only region of the mesh, which has no interface; leave it out, or give the mesh of a "
        "composite");
  return static_cast<int>(found - regions.begin());
}

/// The interface of an inclusion goes round it, ∮ (x − centre) · n ds > 0, twice its area where it is closed;
/// that of a matrix goes round the inclusions, and n points into them.
std::string doubt_about(const std::string& region, const Inclusions& inclusions) {
  std::vector<double> turned(inclusions.area.size(), 0);
  for (const InterfaceNode& node : inclusions.interface) {
    const Vector2& centre = inclusions.centre[node.inclusion];
    for (int axis = 0; axis < 2; ++axis)
      turned[node.inclusion] += (node.position[axis] - centre[axis]) * node.normal[axis] * node.length;
  }
  const auto around = std::ranges::count_if(turned, [](double sum) { return sum < 0; });
  if (around == 0) return "";
  return format(
      "-interfaces_region {}: {} of the {} inclusions that it makes lie{} around other regions, as a matrix "
      "does; "
      "name the region of the inclusions where theirs are meant",
      region, around, inclusions.size(), around == 1 ? "s" : "");
}

void refuse_no_interface(const std::string& region, const Inclusions& inclusions) {
  if (inclusions.interface.empty())
    throw UserError("-interfaces_region: no cell of region '" + region +
                    "' shares an edge with one of another region; leave it out, or name another region");
}

}  // namespace slipscale
