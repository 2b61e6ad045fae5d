#pragma once

#include "slipscale/modes/steady_sliding.hpp"

namespace slipscale {

/// What acts on the body from outside at full load.
struct SlidingLoads {
  std::vector<char> held;          ///< [2 owned] whether a component is prescribed
  std::vector<Vector2> place;      ///< [owned] the prescribed values; of the others where they start from, m
  std::vector<Vector2> force;      ///< [owned] tractions and gravity, N/m
  std::vector<SurfaceNode> nodes;  ///< that can meet the surface
  std::vector<PlateSide> sides;
  std::vector<std::string> notes;
};

/// As `slide` would have them, with its own checks. Collective.
SlidingLoads sliding_loads(MPI_Comm comm, const Model& model, const Scene& scene);

/// Throws UserError when a rigid motion of the body is left that nothing holds. Collective.
void refuse_unsupported(MPI_Comm comm, const Model& model, const SlidingLoads& loads,
                        const std::vector<char>& is_closed);

}  // namespace slipscale
