#pragma once

#include <vector>

#include "slipscale/mesh/mesh.hpp"
#include "slipscale/solid/material.hpp"

namespace slipscale {

/// Row-sum mass of the owned nodes, kg per metre of depth, [owned]; summed in the order of cell numbers.
std::vector<double> lumped_mass(const Mesh& mesh, const std::vector<Material>& materials);

/// Stress at the centre of one local cell, (xx, yy, xy), Pa. `displacement` [all local nodes], m.
std::array<double, 3> stress_of_cell(const Mesh& mesh, const std::vector<Material>& materials,
                                     const Vector2* displacement, int cell);

/// Stress at the centre of every local cell, [cells][xx, yy, xy], Pa. `displacement` [all local nodes], m.
void cell_stress(const Mesh& mesh, const std::vector<Material>& materials, const Vector2* displacement,
                 std::vector<std::array<double, 3>>& stress);

/// Largest element eigenvalue of M⁻¹K over the whole mesh, 1/s²: a safe bound of ω². Collective.
double element_eigenvalue_bound(MPI_Comm comm, const Mesh& mesh, const std::vector<Material>& materials);

}  // namespace slipscale
