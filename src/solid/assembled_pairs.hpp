#pragma once

#include <vector>

#include "slipscale/mesh/mesh.hpp"
#include "slipscale/solid/material.hpp"

namespace slipscale {

/// Off-diagonal blocks of the stiffness, one a pair of nodes that share a cell and of which at least one is
/// owned, N/m². Rows are the lower nodes, by ascending whole-mesh number, and so are the pairs of a row.
struct AssembledPairs {
  /// K_ij with i the lower node: symmetric part, and the skew part, +skew in xy and −skew in yx.
  /// Around a node the skew parts of a row cancel; rounded one by one they would not, and the force would
  /// have no energy. So these few are kept in double precision whatever the others are.
  struct Block {
    double xx, xy, yy, skew;
  };
  std::vector<int> node;     ///< [rows] local node
  std::vector<int> first;    ///< [rows + 1] where a row's pairs start
  std::vector<int> high;     ///< [pairs] local node
  std::vector<Block> block;  ///< [pairs]

  int rows() const { return static_cast<int>(node.size()); }
};

/// Assembles Σ_cells ∫ Bᵀ C B in the order of cell numbers, in double precision; the values are then rounded
/// to `Scalar`.
template <class Scalar>
AssembledPairs assemble_pairs(const Mesh& mesh, const std::vector<Material>& materials);

}  // namespace slipscale
