#include "periods.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "slipscale/base/print.hpp"

namespace slipscale::mesh_stages {
namespace {

double distance(const Vector2& a, const Vector2& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

std::string at(const Vector2& x) { return format("({:g}, {:g}) m", x[0], x[1]); }

/// What a file of few digits may lose: a millionth of the mesh's size, m.
double tolerance(const std::vector<Vector2>& nodes) {
  constexpr double far = std::numeric_limits<double>::max();
  Vector2 lower{far, far}, upper{-far, -far};
  for (const Vector2& x : nodes)
    for (int d = 0; d < 2; ++d) {
      lower[d] = std::min(lower[d], x[d]);
      upper[d] = std::max(upper[d], x[d]);
    }
  return 1e-6 * distance(lower, upper);
}

/// Of the pairs of a link, all of which must have it.
Vector2 shift_of(const PeriodicLink& link, const std::vector<Vector2>& nodes, double little) {
  const auto way = [&](const std::array<int, 2>& pair) {
    const Vector2 &copy = nodes[pair[0]], &original = nodes[pair[1]];
    return Vector2{copy[0] - original[0], copy[1] - original[1]};
  };
  const Vector2 shift = way(link.pairs.front());
  for (const auto& pair : link.pairs) {
    const double off = distance(way(pair), shift);
    if (off <= little) continue;
    const char* kind = link.dimension == 1 ? "curve" : link.dimension == 2 ? "surface" : "point";
    if (link.is_turned)
      throw GmshFault(
          format("pairs {0} {1} with {0} {2} by a rotation or a reflection, but the sides of a "
                 "periodic mesh must be shifts of one another; draw them so, or leave Periodic "
                 "Curve out of its geometry",
                 kind, link.entity, link.original));
    throw GmshFault(
        format("pairs sides that do not match: the node of {} {} at {} lies {:g} m off its partner "
               "on {} {} shifted by {}; draw them as Periodic Curve and mesh again",
               kind, link.entity, at(nodes[pair[0]]), off, kind, link.original, at(shift)));
  }
  return shift;
}

/// A corner of a mesh that is periodic both ways repeats a node that repeats another.
void follow_chains(std::vector<int>& original) {
  for (int& node : original) {
    std::size_t links = 0;
    for (; node != original[node]; node = original[node])
      if (++links > 64) throw GmshFault("is damaged: $Periodic pairs nodes in a circle; " + write_again);
  }
}

}  // namespace

Periods periods_of(const GmshMesh& mesh) {
  Periods periods;
  periods.original.resize(mesh.nodes.size());
  std::iota(periods.original.begin(), periods.original.end(), 0);
  const double little = tolerance(mesh.nodes);
  const auto is_known = [&](const Vector2& shift) {
    return std::ranges::any_of(periods.shifts, [&](const Vector2& other) {
      return distance(shift, other) <= 2 * little || distance(shift, {-other[0], -other[1]}) <= 2 * little;
    });
  };
  for (const PeriodicLink& link : mesh.links)
    for (const auto& [copy, original] : link.pairs) periods.original[copy] = original;
  follow_chains(periods.original);
  for (const PeriodicLink& link : mesh.links) {
    if (link.pairs.empty()) continue;
    const Vector2 shift = shift_of(link, mesh.nodes, little);
    if (distance(shift, {}) > little && !is_known(shift)) periods.shifts.push_back(shift);
  }
  if (periods.shifts.size() > 8)
    throw GmshFault(
        format("pairs its sides by {} different shifts, but a plane has two periods; leave "
               "Periodic Curve to the opposite sides of the outer boundary",
               periods.shifts.size()));
  for (const PeriodicLink& link : mesh.links)
    for (const auto& [copy, original] : link.pairs)
      if (periods.original[copy] != periods.original[original])
        throw GmshFault(
            format("pairs the node at {} with two that are not the same; draw the whole sides as "
                   "Periodic Curve and mesh again",
                   at(mesh.nodes[copy])));
  return periods;
}

}  // namespace slipscale::mesh_stages
