#pragma once

#include <vector>

#include "slipscale/solid/instructions.hpp"
#include "slipscale/solid/lanes.hpp"

namespace slipscale {

/// One neighbour's part in the force on a node, K_ij (u_j − u_i): the block, and how far behind the node the
/// neighbour lies in the arrays.
struct Term {
  Lanes straight;  ///< xx, yy
  Lanes crossed;   ///< xy, yx
  long offset;     ///< nodes

  bool operator==(const Term& other) const;
};

/// Successive nodes whose forces are the same sum of terms.
struct Run {
  int begin, end;   ///< nodes
  int first, last;  ///< terms, in the order in which they are added
};

/// A distance at which nodes of a quartet have neighbours, and the blocks there of the four. The same blocks
/// are kept once for all quartets: beside an interface most are those of the grid, which so stay in the
/// cache.
struct Link {
  int offset;  ///< nodes
  /// Where the blocks start, in fours of values: of the symmetric part 4 × (xx, yy), then 4 × xy. Below zero
  /// for the skew part, 4 × xy at −1 − place.
  int place;
};

/// Four successive nodes that have their neighbours at the same distances or nearly so, each with blocks of
/// its own, zero where it has no neighbour.
struct Quartet {
  int begin;        ///< node
  int first, last;  ///< links, in the order in which their parts are added
};

/// force = Σ K_ij (u_j − u_i) at the nodes of the runs, N/m. A node's terms are added one after the other, as
/// by `PairStiffness`, whatever the instructions.
using GatherRuns = void (*)(const Run* begin, const Run* end, const Term* terms, const Vector2* displacement,
                            Vector2* force);
GatherRuns gather_runs_with(Instructions instructions);

/// The same at the nodes of quartets.
using GatherQuartets = void (*)(const Quartet* begin, const Quartet* end, const Link* links,
                                const double* values, const Vector2* displacement, Vector2* force);
GatherQuartets gather_quartets_with(Instructions instructions);

}  // namespace slipscale
