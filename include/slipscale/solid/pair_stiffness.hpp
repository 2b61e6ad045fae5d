#pragma once

#include <Eigen/Dense>
#include <array>
#include <span>
#include <vector>

#include "slipscale/mesh/mesh.hpp"
#include "slipscale/solid/lanes.hpp"
#include "slipscale/solid/material.hpp"

namespace slipscale {

/// The stiffness of a body as a graph of node pairs.
///
/// A rigid translation costs nothing, so each row of 2×2 blocks sums to zero and the diagonal need not be
/// stored: f_i = Σ_j K_ij (u_j − u_i). Symmetry, K_ji = K_ijᵀ, lets each pair serve both its ends. Pairs are
/// visited in the order of their whole-mesh numbers (low, high), so the sum at a node has the same bits on
/// any number of ranks.
///
/// `Scalar` is what the blocks are stored in; all arithmetic is in double precision.
template <class Scalar>
class PairStiffness {
 public:
  /// Assembles Σ_cells ∫ Bᵀ C B in the order of cell numbers. `materials` [regions].
  PairStiffness(const Mesh& mesh, const std::vector<Material>& materials);

  /// force = K displacement, N/m, at the owned nodes; what it leaves at ghosts is meaningless. Both arrays
  /// hold all local nodes. `complete(begin, end)` is called for runs of owned nodes, in ascending order and
  /// each node once, as soon as their force is complete; from then on nothing reads their displacement, which
  /// may be advanced at once, while all of it is still in the cache.
  template <class Complete>
  void multiply(Vector2* displacement, Vector2* force, Complete&& complete) const;

  void multiply(Vector2* displacement, Vector2* force) const {
    multiply(displacement, force, [](int, int) {});
  }

  std::size_t pairs() const { return high_.size(); }
  std::size_t bytes() const {
    return pairs() * (sizeof(Block) + sizeof(int)) + rows_.size() * sizeof(Row) +
           chunks_.size() * sizeof(Chunk);
  }

 private:
  /// K_ij with i the node of lower number, row by row.
  struct Block {
    Scalar xx, xy, yx, yy;
  };
  struct Row {
    int node;   ///< local node, the lower of its pairs
    int first;  ///< where its pairs start
  };
  /// Some successive rows: few enough for the first-level cache.
  struct Chunk {
    int begin, end;  ///< rows
    int touched;     ///< owned nodes below this one are touched by this chunk or an earlier one
    int complete_begin, complete_end;  ///< owned nodes whose force is complete after it
  };

  int owned_ = 0, count_ = 0;
  std::vector<Row> rows_;  ///< ascending whole-mesh number of the node; a last row closes the list
  std::vector<int> high_;
  std::vector<Block> blocks_;
  std::vector<Chunk> chunks_;
};

template <class Scalar>
template <class Complete>
void PairStiffness<Scalar>::multiply(Vector2* displacement, Vector2* force, Complete&& complete) const {
  for (int ghost = owned_; ghost < count_; ++ghost) force[ghost] = {0, 0};
  const Row* const rows = rows_.data();
  const Block* block = blocks_.data();
  const int* const highs = high_.data();
  const int* high = highs;
  int touched = 0;
  for (const Chunk& chunk : chunks_) {
    for (; touched < chunk.touched; ++touched) force[touched] = {0, 0};
    for (int r = chunk.begin; r < chunk.end; ++r) {
      const int i = rows[r].node;
      const Lanes u = load(displacement[i]);
      Lanes f = load(force[i]);
      for (const int* const end = highs + rows[r + 1].first; high != end; ++high, ++block) {
        __builtin_prefetch(block + 32);  // the processor's own prefetch does not keep up with this stream
        const int j = *high;
        const Lanes d = load(displacement[j]) - u;
        const Lanes kx{block->xx, block->xy}, ky{block->yx, block->yy};
        const Lanes x = kx * d, y = ky * d;
        f += Lanes{x[0], y[0]} + Lanes{x[1], y[1]};
        store(force[j], load(force[j]) - (kx * Lanes{d[0], d[0]} + ky * Lanes{d[1], d[1]}));
      }
      store(force[i], f);
    }
    complete(chunk.complete_begin, chunk.complete_end);
  }
}

extern template class PairStiffness<double>;
extern template class PairStiffness<float>;

}  // namespace slipscale
