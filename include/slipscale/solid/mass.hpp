#pragma once

#include <vector>

#include "slipscale/mesh/mesh.hpp"
#include "slipscale/solid/material.hpp"

namespace slipscale {

/// Row-sum mass of the owned nodes, kg per metre of depth, [owned]; summed in the order of cell numbers.
std::vector<double> lumped_mass(const Mesh& mesh, const std::vector<Material>& materials);

}  // namespace slipscale
