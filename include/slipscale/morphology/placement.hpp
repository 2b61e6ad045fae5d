#pragma once

#include <string>
#include <vector>

#include "slipscale/morphology/recipe.hpp"

namespace slipscale {

/// The inclusions of one composite. On a periodic side an inclusion is listed once, with its centre in the
/// block; `images` gives its copies. The centre of an inclusion that a side cuts may lie outside the block.
struct Placement {
  std::vector<Inclusion> inclusions;
  std::vector<double> fraction;  ///< achieved, by family
  double smallest_gap = 0;       ///< to another, or to its own image, m; infinite when there is neither
  int relaxed = 0;               ///< inclusions that found no free place and for which others had to move
  int moved = 0, dropped = 0;    ///< inclusions of an array that were repaired
};

/// Random sequential placement, the largest family first; where it jams, inclusions are put in and the
/// overlaps relaxed (Jodrey, Tory, Phys. Rev. A 32 (1985) 2347). The fraction of each family is reached to
/// within one of its inclusions. Same seed, same composite. Throws UserError when the fraction cannot be
/// reached, with the value that can.
Placement place_at_random(const std::vector<Family>& families, const Room& room, std::uint64_t seed);

/// A square or hexagonal array of one family (same size, same angle) of the given diameter, or, when that is
/// zero, of the diameter that gives the fraction. The shifted rows of a hexagonal array begin and end with
/// halves at sides that cut, and are one inclusion short at sides that do not. Throws UserError when
/// neighbours come closer than the gap.
Placement place_in_array(const Family& family, const Room& room, const Array& array);

/// The inclusion itself and its copies that reach into the block across periodic sides.
std::vector<Inclusion> images(const Inclusion& inclusion, const Room& room);

/// Whether the inclusion (with its images) lies in the block at least in part, keeps the clearance at sides
/// and corners, and stays off sides it must not cut and off the keep-out layer by the larger of gap and
/// clearance; otherwise a way to mend it, m.
struct Fault {
  bool found = false;
  Vector2 way{};  ///< shortest move found that mends it; zero when none was found
};
Fault side_fault(const Inclusion& inclusion, const Room& room);

}  // namespace slipscale
