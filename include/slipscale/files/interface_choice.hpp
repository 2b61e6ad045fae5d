#pragma once

#include <optional>
#include <string>
#include <vector>

#include "slipscale/base/options.hpp"
#include "slipscale/mesh/inclusions.hpp"

namespace slipscale {

/// Strengths of an interface, Pa, of the quadratic stress criterion (J. C. Brewer, P. A. Lagace, J. Compos.
/// Mater. 22 (1988) 1141):
///     index = (⟨σ_n⟩/normal)² + (τ/shear)², debonding where it reaches 1.
struct InterfaceStrength {
  double normal, shear;

  double index(double normal_traction, double shear_traction) const;
};

/// Which interfaces are followed, and how strong they are.
struct InterfaceChoice {
  std::string region;  ///< whose connected parts are the inclusions
  std::optional<InterfaceStrength> strength;
};

/// -interfaces_region and the strengths, for the programs that follow interfaces.
Schema interface_schema();
/// Nothing without -interfaces_region; `more`: other options that are idle then. Throws UserError for one
/// strength without the other.
std::optional<InterfaceChoice> read_interfaces(const Options& options,
                                               const std::vector<std::string>& more = {});

/// The index of a region among those of a mesh. Throws UserError where there is none of that name, or no
/// other beside it.
int inclusions_region(const std::string& region, const std::vector<std::string>& regions);
/// What is odd about what was found: inclusions that lie around other regions; a sentence, or nothing.
std::string doubt_about(const std::string& region, const Inclusions& inclusions);
/// Throws UserError where no interface was found.
void refuse_no_interface(const std::string& region, const Inclusions& inclusions);

}  // namespace slipscale
