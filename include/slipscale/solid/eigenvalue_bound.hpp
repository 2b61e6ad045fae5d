#pragma once

#include <vector>

#include "slipscale/mesh/mesh.hpp"
#include "slipscale/solid/material.hpp"

namespace slipscale {

/// Largest element eigenvalue of M⁻¹K over the whole mesh, 1/s²: a safe bound of ω². Infinite where
/// that of a cell cannot be computed. Collective.
double element_eigenvalue_bound(MPI_Comm comm, const Mesh& mesh, const std::vector<Material>& materials);

}  // namespace slipscale
