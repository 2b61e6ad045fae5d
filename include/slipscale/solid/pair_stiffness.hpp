#pragma once

#include <algorithm>
#include <vector>

#include "slipscale/base/large_array.hpp"
#include "slipscale/mesh/mesh.hpp"
#include "slipscale/solid/lanes.hpp"
#include "slipscale/solid/material.hpp"
#include "slipscale/solid/repeated_rows.hpp"

namespace slipscale {

/// How the stiffness is worked with; the bits are the same.
struct StiffnessKernel {
  bool runs = true;  ///< successive nodes with equal rows are summed together; else every pair is visited
  Instructions instructions = widest_instructions();
};

struct AssembledPairs;
class RowTerms;
class TermLists;
class Quartets;

/// The stiffness of a body as a graph of node pairs.
///
/// A rigid translation costs nothing, so each row of 2×2 blocks sums to zero and the diagonal need not be
/// stored: f_i = Σ_j K_ij (u_j − u_i). Symmetry, K_ji = K_ijᵀ, lets each pair serve both its ends. Of each
/// block the symmetric part is stored; the skew part, (C12 − C66)/2 ∫ ∇N_i × ∇N_j, is a boundary integral
/// that cancels between cells of one material, so it is kept apart for the few pairs on outer edges and
/// interfaces. Pairs are visited in the order of their whole-mesh numbers (low, high), so the sum at a node
/// has the same bits on any number of ranks.
///
/// Where a mesh is a grid, successive nodes have their neighbours at the same distances in the arrays, with
/// the same blocks to the last bit. The forces on such a run of nodes are gathered, many nodes at once, with
/// the blocks in registers, each node's parts in the order in which the visit of the pairs would add them: to
/// the same bits. Whether a chunk of rows is gathered or visited depends on what repeats in it.
///
/// `Scalar` is what the symmetric parts are stored in; all arithmetic is in double precision. The skew parts
/// of a row cancel around its node, which is what makes the whole symmetric: they stay in double precision.
template <class Scalar>
class PairStiffness {
 public:
  /// Assembles Σ_cells ∫ Bᵀ C B in the order of cell numbers. `materials` [regions].
  PairStiffness(const Mesh& mesh, const std::vector<Material>& materials, const StiffnessKernel& kernel = {});

  /// force = K displacement, N/m, at the owned nodes; what it leaves at ghosts is meaningless. Both arrays
  /// hold all local nodes. `complete(begin, end)` is called for runs of owned nodes, in ascending order and
  /// each node once, as soon as their force is complete; from then on nothing reads their displacement, which
  /// may be advanced at once, while all of it is still in the cache. Some time before,
  /// `complete.prepare(begin, end)` is called, where there is such.
  template <class Complete>
  void multiply(Vector2* displacement, Vector2* force, Complete&& complete) const;

  void multiply(Vector2* displacement, Vector2* force) const {
    multiply(displacement, force, [](int, int) {});
  }

  /// The same where every force is gathered: only those of some successive nodes are there at a time, in
  /// `passing` of `passing_size()` entries, and go no further than the cache. `complete(begin, end, force)`
  /// finds that of node i at force[i].
  template <class Complete>
  void multiply_passing(Vector2* displacement, LargeArray<Vector2>& passing, Complete&& complete) const;
  /// Zero where some forces are not gathered but made by visits.
  std::size_t passing_size() const { return passing_size_; }

  int gathered() const { return gathered_; }    ///< owned nodes whose force is gathered
  int repeating() const { return repeating_; }  ///< of these, the ones in runs
  std::size_t bytes() const {
    return high_.size() * (sizeof(Block) + sizeof(int)) + rows_.size() * sizeof(Row) +
           skews_.size() * sizeof(Skew) + chunks_.size() * sizeof(Chunk) + runs_.size() * sizeof(Run) +
           terms_.size() * sizeof(Term) + quartets_.size() * sizeof(Quartet) + links_.size() * sizeof(Link) +
           values_.size() * sizeof(double);
  }

 private:
  /// Symmetric part of K_ij, row by row.
  struct Block {
    Scalar xx, xy, yy;
  };
  /// Skew part of K_ij with i the node of lower number: +value in xy, −value in yx.
  struct Skew {
    int row, high;
    double value;
  };
  struct Row {
    int node;   ///< local node, the lower of its pairs
    int first;  ///< where its pairs start
  };
  /// Some successive rows: few enough for the first-level cache. Its pairs are visited first, then its runs
  /// are gathered; what a visit adds to the force on a gathered node is lost.
  struct Chunk {
    int rows_begin = 0, rows_end = 0, skews_begin = 0, runs_begin = 0, runs_end = 0;
    int quartets_begin = 0, quartets_end = 0;
    int gathered_begin = 0, gathered_end = 0;  ///< its owned nodes, where they are gathered
    int zero_begin = 0, zero_end = 0;          ///< owned nodes that its visits are the first to add to
    int complete_begin = 0, complete_end = 0;  ///< owned nodes whose force is complete after it
  };

  void lay_out(const AssembledPairs& pairs, const RowTerms& rows, const std::vector<char>& gathered);
  void add_gathered(const RowTerms& rows, int begin, int end, TermLists& lists, Quartets& quartets);
  void add_quartets(const RowTerms& rows, const Run& stretch, int begin, int end, TermLists& lists,
                    Quartets& quartets);
  bool visited(int node, const std::vector<char>& gathered) const { return node < owned_ && !gathered[node]; }
  void reserve(const AssembledPairs& pairs, const std::vector<char>& gathered);
  void add_row(const AssembledPairs& pairs, int row, const std::vector<char>& gathered);
  void complete_in_order(const AssembledPairs& pairs, const std::vector<char>& gathered);
  void visit(const Chunk& chunk, const Vector2* displacement, Vector2* force) const;
  void gather(const Chunk& chunk, const Vector2* displacement, Vector2* force) const;
  template <class Complete>
  void prepare(const Chunk& chunk, Complete& complete) const;

  int owned_ = 0, count_ = 0;
  int repeating_ = 0, gathered_ = 0;
  std::size_t passing_size_ = 0;
  GatherRuns gather_runs_;
  GatherQuartets gather_quartets_;
  LargeArray<Row> rows_;  ///< ascending whole-mesh number of the node; a last row closes the list
  LargeArray<int> high_;
  LargeArray<Block> blocks_;
  std::vector<Skew> skews_;  ///< in the order of the pairs; a last one of no row closes the list
  LargeArray<Run> runs_;     ///< none across two chunks
  std::vector<Term> terms_;
  LargeArray<Quartet> quartets_;
  LargeArray<Link> links_;
  LargeArray<double> values_;
  std::vector<Chunk> chunks_;
};

template <class Scalar>
template <class Complete>
void PairStiffness<Scalar>::multiply(Vector2* displacement, Vector2* force, Complete&& complete) const {
  for (int ghost = owned_; ghost < count_; ++ghost) force[ghost] = {0, 0};
  for (const Chunk& chunk : chunks_) {
    prepare(chunk, complete);
    if (chunk.rows_begin < chunk.rows_end) visit(chunk, displacement, force);
    gather(chunk, displacement, force);
    if (chunk.complete_begin < chunk.complete_end) complete(chunk.complete_begin, chunk.complete_end);
  }
}

template <class Scalar>
template <class Complete>
void PairStiffness<Scalar>::multiply_passing(Vector2* displacement, LargeArray<Vector2>& passing,
                                             Complete&& complete) const {
  long first = 0;  // the node whose force is at the front
  for (const Chunk& chunk : chunks_) {
    if (chunk.gathered_end - first > static_cast<long>(passing.size())) {
      const long front = chunk.complete_begin / 4 * 4;  // as the arrays by node lie in the cache
      std::copy(passing.data() + (front - first), passing.data() + (chunk.gathered_begin - first),
                passing.data());
      first = front;
    }
    Vector2* const force = passing.data() - first;
    prepare(chunk, complete);
    gather(chunk, displacement, force);
    if (chunk.complete_begin < chunk.complete_end) complete(chunk.complete_begin, chunk.complete_end, force);
  }
}

template <class Scalar>
template <class Complete>
void PairStiffness<Scalar>::prepare(const Chunk& chunk, Complete& complete) const {
  if constexpr (requires { complete.prepare(0, 0); })
    complete.prepare(chunk.complete_begin, chunk.complete_end);
}

template <class Scalar>
void PairStiffness<Scalar>::gather(const Chunk& chunk, const Vector2* displacement, Vector2* force) const {
  gather_runs_(runs_.data() + chunk.runs_begin, runs_.data() + chunk.runs_end, terms_.data(), displacement,
               force);
  gather_quartets_(quartets_.data() + chunk.quartets_begin, quartets_.data() + chunk.quartets_end,
                   links_.data(), values_.data(), displacement, force);
}

template <class Scalar>
void PairStiffness<Scalar>::visit(const Chunk& chunk, const Vector2* displacement, Vector2* force) const {
  for (int node = chunk.zero_begin; node < chunk.zero_end; ++node) force[node] = {0, 0};
  const Row* const rows = rows_.data();
  const int* const highs = high_.data();
  const int* high = highs + rows[chunk.rows_begin].first;
  const Block* block = blocks_.data() + rows[chunk.rows_begin].first;
  const Skew* skew = skews_.data() + chunk.skews_begin;
  for (int r = chunk.rows_begin; r < chunk.rows_end; ++r) {
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
}

extern template class PairStiffness<double>;
extern template class PairStiffness<float>;

}  // namespace slipscale
