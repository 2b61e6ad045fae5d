#include "cut_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace slipscale::bench {
namespace {

/// The few different parts around a node.
class Few {
 public:
  void add(PetscInt part) {
    if (std::find(begin(), end(), part) == end()) parts_[count_++] = part;
  }
  const PetscInt* begin() const { return parts_.data(); }
  const PetscInt* end() const { return parts_.data() + count_; }

 private:
  std::array<PetscInt, 16> parts_{};
  int count_ = 0;
};

class Grid {
 public:
  Grid(const std::vector<PetscInt>& part, PetscInt across) : part_(part), n_(across) {}

  PetscInt at(PetscInt i, PetscInt j) const { return part_[static_cast<std::size_t>(j) * n_ + i]; }

  /// Calls `visit` with the part of each cell that is no further than `reach` cells from node (i, j).
  template <class Visit>
  void around(PetscInt i, PetscInt j, PetscInt reach, const Visit& visit) const {
    for (PetscInt y = std::max<PetscInt>(0, j - reach); y < std::min(n_, j + reach); ++y)
      for (PetscInt x = std::max<PetscInt>(0, i - reach); x < std::min(n_, i + reach); ++x) visit(at(x, y));
  }

  PetscInt owner(PetscInt i, PetscInt j) const {
    PetscInt highest = -1;
    around(i, j, 1, [&](PetscInt part) { highest = std::max(highest, part); });
    return highest;
  }

  /// Whether all cells up to two away belong to one part.
  bool alone(PetscInt i, PetscInt j) const {
    const PetscInt own = at(std::min(i, n_ - 1), std::min(j, n_ - 1));
    bool same = true;
    around(i, j, 2, [&](PetscInt part) { same &= part == own; });
    return same;
  }

 private:
  const std::vector<PetscInt>& part_;
  PetscInt n_;
};

/// The owners of the nodes around (i, j), itself among them.
Few owners_around(const Grid& grid, PetscInt i, PetscInt j, PetscInt across) {
  Few owners;
  for (PetscInt y = std::max<PetscInt>(0, j - 1); y <= std::min(across, j + 1); ++y)
    for (PetscInt x = std::max<PetscInt>(0, i - 1); x <= std::min(across, i + 1); ++x)
      owners.add(grid.owner(x, y));
  return owners;
}

void count_at_a_seam(const Grid& grid, PetscInt i, PetscInt j, PetscInt across, PetscInt own,
                     std::vector<Share>& all) {
  const Few owners = owners_around(grid, i, j, across);
  if (owners.end() - owners.begin() > 1) ++all[own].border;
  for (const PetscInt other : owners)
    if (other != own) ++all[other].needed;
  Few holders;  // those with a cell that touches a cell around the node
  grid.around(i, j, 2, [&](PetscInt part) { holders.add(part); });
  for (const PetscInt other : holders) {
    if (other == own) continue;
    ++all[other].ghosts;
    ++all[own].sent;
    auto& senders = all[other].senders;
    if (std::find(senders.rbegin(), senders.rend(), own) == senders.rend()) senders.push_back(own);
  }
}

}  // namespace

std::vector<Share> shares(const std::vector<PetscInt>& part, PetscInt across, PetscInt parts) {
  const Grid grid(part, across);
  std::vector<Share> all(static_cast<std::size_t>(parts));
  for (PetscInt j = 0; j <= across; ++j) {
    PetscInt before = -1;
    for (PetscInt i = 0; i <= across; ++i) {
      const bool alone = grid.alone(i, j);
      const PetscInt own =
          alone ? grid.at(std::min(i, across - 1), std::min(j, across - 1)) : grid.owner(i, j);
      ++all[own].owned;
      if (own != before) ++all[own].stretches;
      before = own;
      if (!alone) count_at_a_seam(grid, i, j, across, own, all);
    }
  }
  return all;
}

std::vector<PetscInt> rectangles(PetscInt across, PetscInt parts) {
  auto px = static_cast<PetscInt64>(std::sqrt(static_cast<double>(parts)));
  while (parts % px != 0) --px;
  const PetscInt64 py = parts / px;
  std::vector<PetscInt> part(static_cast<std::size_t>(across) * across);
  for (PetscInt64 j = 0; j < across; ++j)
    for (PetscInt64 i = 0; i < across; ++i)
      part[j * across + i] = static_cast<PetscInt>(j * py / across * px + i * px / across);
  return part;
}

std::vector<PetscInt> strips(PetscInt across, PetscInt parts) {
  const PetscInt64 cells = static_cast<PetscInt64>(across) * across;
  std::vector<PetscInt> part(static_cast<std::size_t>(cells));
  for (PetscInt64 cell = 0; cell < cells; ++cell) part[cell] = static_cast<PetscInt>(cell * parts / cells);
  return part;
}

}  // namespace slipscale::bench
