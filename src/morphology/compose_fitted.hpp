#pragma once

#include "fitted_grid.hpp"
#include "slipscale/morphology/compose.hpp"

namespace slipscale {

/// The number of equal cells that comes nearest to the recipe's edge length, along x, y.
std::array<int, 2> grid_cells(const Recipe& recipe, const Box& block);

/// The grid's mesh and what was counted.
void take(morphology::FittedGrid&& grid, Composed& composed);

/// Meshes the placement (none for a homogeneous block) with the fitted grid. Throws UserError for interfaces
/// that the grid cannot keep apart.
void fit_inclusions(const Recipe& recipe, const std::vector<std::string>& regions, Composed& composed);

/// The same for the layers of a laminate.
void fit_layers(const Recipe& recipe, const std::vector<std::string>& regions, Composed& composed);

}  // namespace slipscale
