#pragma once

#include <vector>

#include "slipscale/mesh/mesh.hpp"
#include "slipscale/solid/material.hpp"

namespace slipscale {

/// The cell that limits the step, and what it has in common with the others. The same on every rank.
struct CriticalCell {
  double eigenvalue =
      0;  ///< largest element eigenvalue of M⁻¹K over the whole mesh, 1/s²: a safe bound of ω².
          ///< Infinite where that of a cell cannot be computed; nothing else is known then
  PetscInt number = 0;                           ///< in the whole mesh; the lowest of those that are equal
  int region = 0;                                ///< index into Mesh::regions
  Vector2 centre{};                              ///< mean of its corners, m
  double smallest_angle = 0, largest_angle = 0;  ///< between its edges, degrees
  /// Stable step of this cell over that of the median cell, of all and of those of its region; to a percent.
  double of_median = 1, of_median_in_region = 1;
};

/// Collective.
CriticalCell critical_cell(MPI_Comm comm, const Mesh& mesh, const std::vector<Material>& materials);

}  // namespace slipscale
