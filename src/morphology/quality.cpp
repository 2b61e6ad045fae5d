#include "slipscale/morphology/quality.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "slipscale/morphology/drawing.hpp"
#include "slipscale/solid/element.hpp"
#include "slipscale/solid/material.hpp"

namespace slipscale {
namespace {

constexpr double poisson = 0.3;

struct Angles {
  double smallest = std::numbers::pi, largest = 0;
};

Angles angles(const std::vector<Vector2>& corners) {
  Angles found;
  const std::size_t count = corners.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vector2 &x = corners[i], &next = corners[(i + 1) % count], &last = corners[(i + count - 1) % count];
    const Vector2 a{next[0] - x[0], next[1] - x[1]}, b{last[0] - x[0], last[1] - x[1]};
    double angle = std::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
    if (angle < 0) angle += 2 * std::numbers::pi;
    found.smallest = std::min(found.smallest, angle);
    found.largest = std::max(found.largest, angle);
  }
  return found;
}

}  // namespace

double worst_angle(const std::vector<Vector2>& corners) {
  const Angles found = angles(corners);
  return std::min(found.smallest, std::numbers::pi - found.largest);
}

MeshQuality quality(const CompositeMesh& mesh) {
  const Eigen::Matrix3d elasticity = isotropic_stiffness(1, poisson);
  const double wave_speed = std::sqrt(elasticity(0, 0));
  MeshQuality found;
  found.smallest_angle = std::numbers::pi;
  std::vector<double> steps;
  steps.reserve(mesh.cells.size());
  for (const CompositeMesh::Cell& cell : mesh.cells) {
    const std::vector<Vector2> corners = mesh.corners(cell);
    const Angles here = angles(corners);
    found.smallest_angle = std::min(found.smallest_angle, here.smallest);
    found.largest_angle = std::max(found.largest_angle, here.largest);
    const auto bin = static_cast<std::size_t>(here.smallest * 18 / std::numbers::pi);
    ++found.histogram[std::min(bin, found.histogram.size() - 1)];
    steps.push_back(wave_speed * 2 / std::sqrt(largest_element_eigenvalue(corners, elasticity, 1)));
  }
  const auto least = std::ranges::min_element(steps);
  found.step_cell = static_cast<int>(least - steps.begin());
  found.step_length = *least;
  std::ranges::nth_element(steps, steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2));
  found.typical_step_length = steps[steps.size() / 2];
  return found;
}

std::vector<double> inclusion_areas(const CompositeMesh& mesh, std::size_t inclusions) {
  std::vector<double> areas(inclusions);
  for (const CompositeMesh::Cell& cell : mesh.cells)
    if (cell.inclusion >= 0) areas[cell.inclusion] += polygon_area(mesh.corners(cell));
  return areas;
}

std::vector<double> region_areas(const CompositeMesh& mesh) {
  std::vector<double> areas(mesh.regions.size());
  for (const CompositeMesh::Cell& cell : mesh.cells) areas[cell.region] += polygon_area(mesh.corners(cell));
  return areas;
}

}  // namespace slipscale
