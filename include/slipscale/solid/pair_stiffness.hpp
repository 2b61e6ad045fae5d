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
/// stored: f_i = Σ_j K_ij (u_j − u_i). Symmetry, K_ji = K_ijᵀ, lets each pair serve both its ends. Of each
/// block the symmetric part is stored; the skew part, (C12 − C66)/2 ∫ ∇N_i × ∇N_j, is a boundary integral
/// that cancels between cells of one material, so it is kept apart for the few pairs on outer edges and
/// interfaces. Pairs are visited in the order of their whole-mesh numbers (low, high), so the sum at a node
/// has the same bits on any number of ranks.
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
           skews_.size() * sizeof(Skew) + chunks_.size() * sizeof(Chunk);
  }

 private:
  /// Symmetric part of K_ij, row by row.
  struct Block {
    Scalar xx, xy, yy;
  };
  /// Skew part of K_ij with i the node of lower number: +value in xy, −value in yx.
  struct Skew {
    int row, high;
    Scalar value;
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

  template <class Sums>
  void store_blocks(const Sums& sums);

  int owned_ = 0, count_ = 0;
  std::vector<Row> rows_;  ///< ascending whole-mesh number of the node; a last row closes the list
  std::vector<int> high_;
  std::vector<Block> blocks_;
  std::vector<Skew> skews_;  ///< in the order of the pairs; a last one of no row closes the list
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
  const Skew* skew = skews_.data();
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
        const Lanes pull =
            Lanes{block->xx, block->xy} * Lanes{d[0], d[0]} + Lanes{block->xy, block->yy} * Lanes{d[1], d[1]};
        f += pull;
        store(force[j], load(force[j]) - pull);
      }
      for (; skew->row == r; ++skew) {
        const int j = skew->high;
        const Lanes d = load(displacement[j]) - u;
        const Lanes turn = Lanes{skew->value, -skew->value} * Lanes{d[1], d[0]};
        f += turn;
        store(force[j], load(force[j]) + turn);
      }
      store(force[i], f);
    }
    complete(chunk.complete_begin, chunk.complete_end);
  }
}

extern template class PairStiffness<double>;
extern template class PairStiffness<float>;

}  // namespace slipscale
