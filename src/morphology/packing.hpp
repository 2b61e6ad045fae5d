#pragma once

#include <vector>

#include "cells.hpp"
#include "slipscale/morphology/placement.hpp"
#include "slipscale/morphology/random.hpp"

namespace slipscale::morphology {

/// Inclusions in a domain that is larger than the block where inclusions are cut by its sides: the block is a
/// window on it, so that inclusions are as dense at its sides as elsewhere.
class Packing {
 public:
  /// Inclusions reach at most `reach` from their centres along x, y; `size` is the extent of typical small
  /// ones.
  Packing(const Room& room, const Vector2& reach, double size);

  const std::vector<Inclusion>& inclusions() const { return inclusions_; }
  const Domain& domain() const { return domain_; }

  void add(const Inclusion& inclusion);
  void remove(std::size_t k);

  /// A place anywhere in the domain, or in the block.
  Vector2 any_place(Random& random, bool in_block) const;

  /// Puts the inclusion in the first of `attempts` random places that is free. Returns false when none is.
  bool place_free(Inclusion inclusion, int attempts, bool in_block, Random& random);

  /// Puts the inclusion in that of `attempts` random places where it overlaps others the least.
  void place_best(Inclusion inclusion, int attempts, bool in_block, Random& random);

  /// Pushes inclusions apart until all keep the gap and the sides. Returns false when they do not after
  /// `sweeps` sweeps.
  bool relax(int sweeps, Random& random);

  /// The inclusion of the family whose overlaps were largest in the last sweep of `relax`.
  std::size_t most_crowded(int family) const;

 private:
  struct Contact {
    int a, b;
    Vector2 shift;     ///< of b, to the image that is near a
    Vector2 normal{};  ///< that separated them last
  };

  double smallest_separation(const Inclusion& inclusion, double enough, int except = -1) const;
  void sort_into_cells();
  void find_contacts();
  bool sweep();
  bool push_apart();
  bool push_off_sides();
  void move();
  void move_most_crowded(Random& random);
  double crowding() const;

  Room room_;
  Domain domain_;
  double size_;
  Cells cells_;
  double quantum_;  ///< of coordinates, m
  double largest_radius_ = 0;
  std::vector<Inclusion> inclusions_;

  // While relaxing.
  std::vector<Contact> contacts_;
  std::vector<Vector2> push_;
  std::vector<double> crowding_;  ///< sum of overlaps, m
  double reserve_ = 0;            ///< how far inclusions may still move before contacts are sought anew, m
};

}  // namespace slipscale::morphology
