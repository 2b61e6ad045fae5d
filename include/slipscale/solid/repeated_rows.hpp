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

/// force = Σ K_ij (u_j − u_i) at the nodes of the runs, N/m. A node's terms are added one after the other, as
/// by `PairStiffness`, whatever the instructions.
using GatherRuns = void (*)(const Run* begin, const Run* end, const Term* terms, const Vector2* displacement,
                            Vector2* force);
GatherRuns gather_runs_with(Instructions instructions);

}  // namespace slipscale
