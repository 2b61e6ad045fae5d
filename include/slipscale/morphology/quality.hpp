#pragma once

#include <array>
#include <vector>

#include "slipscale/morphology/composite_mesh.hpp"

namespace slipscale {

/// How good a mesh is for explicit dynamics.
struct MeshQuality {
  double smallest_angle = 0, largest_angle = 0;  ///< of all cells, radian
  std::array<long, 9> histogram{};               ///< cells by their smallest angle, in steps of 10 degrees
  /// Dilatational wave speed times stable step, for a material with ν = .3: of the cell that allows least,
  /// and its median over the cells, m. Their ratio is what the worst cell costs.
  double step_length = 0, typical_step_length = 0;
  int step_cell = -1;  ///< that allows least
};

MeshQuality quality(const CompositeMesh& mesh);

/// The angle of a cell that is farthest from good: its smallest, or π minus its largest, radian.
double worst_angle(const std::vector<Vector2>& corners);

/// Area of each inclusion as meshed, m² [inclusions].
std::vector<double> inclusion_areas(const CompositeMesh& mesh, std::size_t inclusions);

/// Area of each region as meshed, m² [regions].
std::vector<double> region_areas(const CompositeMesh& mesh);

}  // namespace slipscale
