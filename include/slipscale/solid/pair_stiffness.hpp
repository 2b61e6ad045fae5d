#pragma once

#include <Eigen/Dense>
#include <array>
#include <span>
#include <vector>

#include "slipscale/mesh/mesh.hpp"
#include "slipscale/solid/material.hpp"

namespace slipscale {

/// The stiffness of a body as a graph of node pairs.
///
/// A rigid translation costs nothing, so each row of 2×2 blocks sums to zero and the diagonal need not be stored:
/// f_i = Σ_j K_ij (u_j − u_i). Symmetry, K_ji = K_ijᵀ, lets each pair serve both its ends. Pairs are visited in the
/// order of their whole-mesh numbers (low, high), so the sum at a node has the same bits on any number of ranks.
///
/// `Scalar` is what the blocks are stored in; all arithmetic is in double precision.
template <class Scalar>
class PairStiffness {
 public:
  /// Assembles Σ_cells ∫ Bᵀ C B in the order of cell numbers. `materials` [regions].
  PairStiffness(const Mesh& mesh, const std::vector<Material>& materials);

  /// force = K displacement, N/m, at the owned nodes; what it leaves at ghosts is meaningless. Both arrays hold all
  /// local nodes. `complete(node)` is called once for every owned node, in ascending order, as soon as its force is
  /// complete; from then on nothing reads its displacement, which may therefore be advanced at once.
  template <class Complete>
  void multiply(Vector2* displacement, Vector2* force, Complete&& complete) const;

  void multiply(Vector2* displacement, Vector2* force) const {
    multiply(displacement, force, [](int) {});
  }

  std::size_t pairs() const { return high_.size(); }
  std::size_t bytes() const { return pairs() * (sizeof(Block) + sizeof(int)) + rows_.size() * sizeof(Row); }

 private:
  /// K_ij with i the node of lower number, row by row.
  struct Block {
    Scalar xx, xy, yx, yy;
  };
  struct Row {
    int node;   ///< local node, the lower of its pairs
    int first;  ///< where its pairs start
  };

  int owned_ = 0, count_ = 0;
  std::vector<Row> rows_;  ///< ascending whole-mesh number of the node; a last row closes the list
  std::vector<int> high_;
  std::vector<Block> blocks_;
};

template <class Scalar>
template <class Complete>
void PairStiffness<Scalar>::multiply(Vector2* displacement, Vector2* force, Complete&& complete) const {
  for (int node = 0; node < count_; ++node) force[node] = {0, 0};
  const Block* block = blocks_.data();
  const int* high = high_.data();
  for (std::size_t r = 0; r + 1 < rows_.size(); ++r) {
    const int i = rows_[r].node;
    const double ux = displacement[i][0], uy = displacement[i][1];
    double fx = force[i][0], fy = force[i][1];
    for (const int* const end = high_.data() + rows_[r + 1].first; high != end; ++high, ++block) {
      const int j = *high;
      const double dx = displacement[j][0] - ux, dy = displacement[j][1] - uy;
      const double xx = block->xx, xy = block->xy, yx = block->yx, yy = block->yy;
      fx += xx * dx + xy * dy;
      fy += yx * dx + yy * dy;
      force[j][0] -= xx * dx + yx * dy;
      force[j][1] -= xy * dx + yy * dy;
    }
    force[i] = {fx, fy};
    if (i < owned_) complete(i);
  }
}

extern template class PairStiffness<double>;
extern template class PairStiffness<float>;

}  // namespace slipscale
