#pragma once

#include <vector>

#include "slipscale/base/petsc.hpp"

/// What the ranks of a run would hold of a square grid of squares, from the part of each cell alone: the
/// rules are those of src/mesh (cells in parts, one layer of overlap, a node belongs to the highest part that
/// has a cell around it), and test_parts.py compares with what ranks hold.
namespace slipscale::bench {

/// One part.
struct Share {
  PetscInt64 owned = 0;           ///< nodes
  PetscInt64 border = 0;          ///< owned nodes with a neighbour that another part owns
  PetscInt64 ghosts = 0;          ///< nodes of others that it holds, and receives once a step
  PetscInt64 needed = 0;          ///< those of them that its owned nodes have as neighbours
  PetscInt64 sent = 0;            ///< nodes it sends, counted once for each part that receives them
  PetscInt64 stretches = 0;       ///< of owned nodes in a row of the grid
  std::vector<PetscInt> senders;  ///< parts it receives from
};

/// The shares of all parts. `part` [across²] has the part of each cell, row by row.
std::vector<Share> shares(const std::vector<PetscInt>& part, PetscInt across, PetscInt parts);

/// The square cells in px by py rectangles as equal as can be; px py is `parts`, px as near to py as a
/// divisor is.
std::vector<PetscInt> rectangles(PetscInt across, PetscInt parts);

/// Equal stretches of the cells row by row: what the order of the mesh comes to on such a grid.
std::vector<PetscInt> strips(PetscInt across, PetscInt parts);

}  // namespace slipscale::bench
