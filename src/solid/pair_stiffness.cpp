#include "slipscale/solid/pair_stiffness.hpp"

#include <algorithm>

#include "assembled_pairs.hpp"
#include "row_terms.hpp"

namespace slipscale {
namespace {

constexpr int rows_of_a_chunk = 256;

/// A run that vector instructions take at one stroke.
constexpr int long_run = 4;

/// What it costs to gather a run, in units of a node whose pairs are visited; measured.
double cost_of(int nodes) { return nodes < long_run ? 1.6 * nodes : 0.6 + 0.3 * nodes; }

/// 1 for each owned node whose force is gathered: those of the chunks where this costs less.
template <class Scalar>
std::vector<char> choose_gathered(const AssembledPairs<Scalar>& pairs, const RowTerms<Scalar>& rows,
                                  int owned) {
  std::vector<char> gathered(static_cast<std::size_t>(owned), 0);
  std::vector<Term> terms, before;
  for (int begin = 0; begin < pairs.rows(); begin += rows_of_a_chunk) {
    const int end = std::min(begin + rows_of_a_chunk, pairs.rows());
    double cost = 0;
    int visited = 0, run = 0, last = -2;
    const auto close_run = [&] {
      if (run > 0) cost += cost_of(run);
      run = 0;
    };
    for (int row = begin; row < end; ++row) {
      const int node = pairs.node[row];
      if (node >= owned) continue;
      ++visited;
      std::swap(terms, before);
      rows.of(node, terms);
      if (node != last + 1 || terms != before) close_run();
      ++run;
      last = node;
    }
    close_run();
    if (cost >= visited) continue;
    for (int row = begin; row < end; ++row)
      if (pairs.node[row] < owned) gathered[pairs.node[row]] = 1;
  }
  return gathered;
}

}  // namespace

template <class Scalar>
PairStiffness<Scalar>::PairStiffness(const Mesh& mesh, const std::vector<Material>& materials,
                                     const StiffnessKernel& kernel)
    : owned_(mesh.nodes.owned), count_(mesh.nodes.size()), gather_(gather_runs_with(kernel.instructions)) {
  const auto pairs = assemble_pairs<Scalar>(mesh, materials);
  const RowTerms<Scalar> rows(pairs);
  lay_out(pairs, rows,
          kernel.runs ? choose_gathered(pairs, rows, owned_)
                      : std::vector<char>(static_cast<std::size_t>(owned_), 0));
}

template <class Scalar>
void PairStiffness<Scalar>::lay_out(const AssembledPairs<Scalar>& pairs, const RowTerms<Scalar>& rows,
                                    const std::vector<char>& gathered) {
  TermLists lists;
  std::vector<Term> terms;
  int touched = 0, seen = 0;
  for (int begin = 0; begin < pairs.rows(); begin += rows_of_a_chunk) {
    const int end = std::min(begin + rows_of_a_chunk, pairs.rows());
    Chunk chunk;
    chunk.rows_begin = static_cast<int>(rows_.size());
    chunk.skews_begin = static_cast<int>(skews_.size());
    chunk.runs_begin = static_cast<int>(runs_.size());
    chunk.zero_begin = std::max(touched, seen);
    for (int row = begin; row < end; ++row) {
      add_row(pairs, row, gathered);
      const int node = pairs.node[row];
      if (node >= owned_) continue;
      seen = node + 1;
      if (!gathered[node]) continue;
      rows.of(node, terms);
      const auto [first, last] = lists.place(terms);
      const bool goes_on = static_cast<int>(runs_.size()) > chunk.runs_begin && runs_.back().end == node &&
                           runs_.back().first == first;
      if (goes_on)
        ++runs_.back().end;
      else
        runs_.push_back({node, node + 1, first, last});
    }
    chunk.rows_end = static_cast<int>(rows_.size());
    chunk.runs_end = static_cast<int>(runs_.size());
    for (int row = chunk.rows_begin; row < chunk.rows_end; ++row)
      if (rows_[row].node < owned_) touched = std::max(touched, rows_[row].node + 1);
    if (chunk.rows_begin < chunk.rows_end)
      for (std::size_t k = rows_[chunk.rows_begin].first; k < high_.size(); ++k)
        if (high_[k] < owned_) touched = std::max(touched, high_[k] + 1);
    chunk.zero_end = std::max(touched, chunk.zero_begin);
    chunks_.push_back(chunk);
  }
  rows_.push_back({-1, static_cast<int>(high_.size())});
  skews_.push_back({-1, -1, 0});
  terms_ = lists.take();
  complete_in_order(pairs, gathered);
  rows_.shrink_to_fit(), high_.shrink_to_fit(), blocks_.shrink_to_fit(), runs_.shrink_to_fit();
}

/// Keeps the pairs of which an end is visited. A row without pairs is kept where its node is visited: its
/// force must be made zero.
template <class Scalar>
void PairStiffness<Scalar>::add_row(const AssembledPairs<Scalar>& pairs, int row,
                                    const std::vector<char>& gathered) {
  const auto visited = [&](int node) { return node < owned_ && !gathered[node]; };
  const int node = pairs.node[row];
  const auto first = static_cast<int>(high_.size());
  for (int pair = pairs.first[row]; pair < pairs.first[row + 1]; ++pair) {
    if (!visited(node) && !visited(pairs.high[pair])) continue;
    const auto& block = pairs.block[pair];
    high_.push_back(pairs.high[pair]);
    blocks_.push_back({block.xx, block.xy, block.yy});
    if (block.skew != 0) skews_.push_back({static_cast<int>(rows_.size()), pairs.high[pair], block.skew});
  }
  if (visited(node) || first < static_cast<int>(high_.size())) rows_.push_back({node, first});
}

/// A node may move once nothing reads its displacement any more: its own row, and the rows of its neighbours
/// that are gathered.
template <class Scalar>
void PairStiffness<Scalar>::complete_in_order(const AssembledPairs<Scalar>& pairs,
                                              const std::vector<char>& gathered) {
  std::vector<int> chunk_of(static_cast<std::size_t>(count_));
  for (int row = 0; row < pairs.rows(); ++row) chunk_of[pairs.node[row]] = row / rows_of_a_chunk;
  std::vector<int> last_reader(chunk_of.begin(), chunk_of.begin() + owned_);
  for (int row = 0; row < pairs.rows(); ++row) {
    const int low = pairs.node[row];
    for (int pair = pairs.first[row]; pair < pairs.first[row + 1]; ++pair) {
      const int high = pairs.high[pair];
      if (low < owned_ && high < owned_ && gathered[high])
        last_reader[low] = std::max(last_reader[low], chunk_of[high]);
    }
  }
  int complete = 0;
  for (int k = 0; k < static_cast<int>(chunks_.size()); ++k) {
    chunks_[k].complete_begin = complete;
    while (complete < owned_ && last_reader[complete] <= k) ++complete;
    chunks_[k].complete_end = complete;
  }
}

template <class Scalar>
int PairStiffness<Scalar>::gathered() const {
  int nodes = 0;
  for (const Run& run : runs_) nodes += run.end - run.begin;
  return nodes;
}

template <class Scalar>
int PairStiffness<Scalar>::repeating() const {
  int nodes = 0;
  for (const Run& run : runs_)
    if (run.end - run.begin >= long_run) nodes += run.end - run.begin;
  return nodes;
}

template class PairStiffness<double>;
template class PairStiffness<float>;

}  // namespace slipscale
