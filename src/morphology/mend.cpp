#include "mend.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <set>

#include "cells.hpp"
#include "sides.hpp"
#include "slipscale/morphology/quality.hpp"

namespace slipscale {
namespace {

constexpr int attempts = 2000;  ///< to find a free place

double distance_to(const Vector2& x, const Inclusion& inclusion, const Room& room) {
  Inclusion point;
  point.centre = x;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Inclusion& image : images(inclusion, room))
    nearest = std::min(nearest, separation(image, point));
  return nearest;
}

/// Inclusions beside the bad cells, at most a cell's size away.
std::set<std::size_t, std::greater<>> culprits(const std::vector<Inclusion>& inclusions, const Room& room,
                                               const CompositeMesh& mesh, double allowed) {
  std::set<std::size_t, std::greater<>> found;
  for (const CompositeMesh::Cell& cell : mesh.cells) {
    const std::vector<Vector2> corners = mesh.corners(cell);
    if (worst_angle(corners) >= allowed) continue;
    double size = 0;
    for (const Vector2& x : corners)
      size = std::max(size, std::hypot(x[0] - corners[0][0], x[1] - corners[0][1]));
    double nearest = 2 * size;
    std::optional<std::size_t> beside;
    for (std::size_t k = 0; k < inclusions.size(); ++k)
      if (const double distance = distance_to(corners[0], inclusions[k], room); distance < nearest) {
        nearest = distance;
        beside = k;
      }
    if (beside) found.insert(*beside);
  }
  return found;
}

/// Smallest distance of an inclusion to all others but the one in its place.
double room_around(const Inclusion& moved, std::size_t k, const std::vector<Inclusion>& inclusions,
                   const Room& room) {
  double least = std::numeric_limits<double>::infinity();
  const std::vector<Inclusion> own = images(moved, room);
  for (std::size_t other = 0; other < inclusions.size(); ++other) {
    if (other == k) continue;
    for (const Inclusion& theirs : images(inclusions[other], room))
      for (const Inclusion& ours : own) least = std::min(least, separation(ours, theirs));
  }
  return least;
}

/// The free place within `reach` of where it was drawn that leaves the most room around the inclusion.
std::optional<Inclusion> better_place(const std::vector<Inclusion>& inclusions, std::size_t k,
                                      const Vector2& drawn, const Room& room, double reach) {
  std::optional<Inclusion> best;
  double most = room.gap;
  for (const double part : {0.3, 0.6, 0.9})
    for (int direction = 0; direction < 16; ++direction) {
      const double angle = 2 * std::numbers::pi * direction / 16;
      Inclusion moved = inclusions[k];
      moved.centre = {drawn[0] + part * reach * std::cos(angle), drawn[1] + part * reach * std::sin(angle)};
      moved.centre = morphology::Domain{room.block, room.periodic}.wrapped(moved.centre);
      if (moved.centre == inclusions[k].centre || side_fault(moved, room).found) continue;
      if (const double around = room_around(moved, k, inclusions, room); around > most) {
        most = around;
        best = moved;
      }
    }
  return best;
}

/// A free place anywhere that shows about as much of the inclusion in the block.
std::optional<Inclusion> other_place(const std::vector<Inclusion>& inclusions, std::size_t k,
                                     const Room& room, Random& random) {
  const double shown = morphology::area_in_block(inclusions[k], room);
  for (int attempt = 0; attempt < attempts; ++attempt) {
    Inclusion moved = inclusions[k];
    moved.centre = {room.block.lower[0] + random.uniform() * room.block.width(),
                    room.block.lower[1] + random.uniform() * room.block.height()};
    if (!side_fault(moved, room).found && room_around(moved, k, inclusions, room) > room.gap &&
        std::abs(morphology::area_in_block(moved, room) - shown) < 0.5 * area(moved))
      return moved;
  }
  return std::nullopt;
}

}  // namespace

Mending mend(std::vector<Inclusion>& inclusions, std::vector<Vector2>& drawn, const Room& room,
             const CompositeMesh& mesh, double allowed, double reach, Random* random) {
  Mending done;
  for (const std::size_t k : culprits(inclusions, room, mesh, allowed)) {  // from the last: some are erased
    const bool first_time = inclusions[k].centre == drawn[k];
    if (const auto near = first_time ? better_place(inclusions, k, drawn[k], room, reach) : std::nullopt) {
      inclusions[k] = *near;
      ++done.moved;
    } else if (const auto far = random ? other_place(inclusions, k, room, *random) : std::nullopt) {
      inclusions[k] = *far;
      drawn[k] = far->centre;
      ++done.redrawn;
    } else {
      inclusions.erase(inclusions.begin() + static_cast<std::ptrdiff_t>(k));
      drawn.erase(drawn.begin() + static_cast<std::ptrdiff_t>(k));
      ++done.dropped;
    }
  }
  return done;
}

}  // namespace slipscale
