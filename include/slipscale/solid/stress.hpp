#pragma once

#include <array>
#include <vector>

#include "slipscale/mesh/mesh.hpp"
#include "slipscale/solid/material.hpp"

namespace slipscale {

/// Stress at the centre of one local cell, (xx, yy, xy), Pa. `displacement` [all local nodes], m.
std::array<double, 3> stress_of_cell(const Mesh& mesh, const std::vector<Material>& materials,
                                     const Vector2* displacement, int cell);

/// Stress at the centre of every local cell, [cells][xx, yy, xy], Pa. `displacement` [all local nodes], m.
void cell_stress(const Mesh& mesh, const std::vector<Material>& materials, const Vector2* displacement,
                 std::vector<std::array<double, 3>>& stress);

}  // namespace slipscale
