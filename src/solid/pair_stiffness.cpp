#include "slipscale/solid/pair_stiffness.hpp"

#include <algorithm>

#include "assembled_pairs.hpp"
#include "quartets.hpp"
#include "row_terms.hpp"

namespace slipscale {
namespace {

constexpr int rows_of_a_chunk = 256;

/// What waits for its neighbours is moved to the front only every so many times that it has filled the room.
constexpr std::size_t rooms_for_what_passes = 3;

/// A run that vector instructions take at one stroke.
constexpr int long_run = 4;

/// What it costs to gather a run, in units of a node whose pairs are visited; measured.
double cost_of(int nodes) { return nodes < long_run ? 1.2 * nodes : 0.6 + 0.3 * nodes; }

/// 1 for each owned node whose force is gathered: those of the chunks where this costs less.
std::vector<char> choose_gathered(const AssembledPairs& pairs, const RowTerms& rows, int owned) {
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
    : owned_(mesh.nodes.owned),
      count_(mesh.nodes.size()),
      gather_runs_(gather_runs_with(kernel.instructions)),
      gather_quartets_(gather_quartets_with(kernel.instructions)) {
  const auto pairs = assemble_pairs<Scalar>(mesh, materials);
  const RowTerms rows(pairs);
  lay_out(pairs, rows,
          kernel.runs ? choose_gathered(pairs, rows, owned_)
                      : std::vector<char>(static_cast<std::size_t>(owned_), 0));
}

template <class Scalar>
void PairStiffness<Scalar>::lay_out(const AssembledPairs& pairs, const RowTerms& rows,
                                    const std::vector<char>& gathered) {
  TermLists lists;
  Quartets quartets(count_);
  reserve(pairs, gathered);
  int touched = 0, seen = 0;
  for (int begin = 0; begin < pairs.rows(); begin += rows_of_a_chunk) {
    const int end = std::min(begin + rows_of_a_chunk, pairs.rows());
    Chunk chunk;
    chunk.rows_begin = static_cast<int>(rows_.size());
    chunk.skews_begin = static_cast<int>(skews_.size());
    chunk.runs_begin = static_cast<int>(runs_.size());
    chunk.quartets_begin = static_cast<int>(quartets_.size());
    chunk.zero_begin = std::max(touched, seen);
    const int first = seen;
    for (int row = begin; row < end; ++row) {
      add_row(pairs, row, gathered);
      if (pairs.node[row] < owned_) seen = pairs.node[row] + 1;
    }
    chunk.gathered_begin = chunk.gathered_end = seen;
    if (first < seen && gathered[first]) chunk.gathered_begin = first;
    if (chunk.gathered_begin < seen) add_gathered(rows, first, seen, lists, quartets);
    chunk.rows_end = static_cast<int>(rows_.size());
    chunk.runs_end = static_cast<int>(runs_.size());
    chunk.quartets_end = static_cast<int>(quartets_.size());
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
  links_ = std::move(quartets.links);
  values_ = std::move(quartets.values);
  complete_in_order(pairs, gathered);
  skews_.shrink_to_fit(), runs_.shrink_to_fit(), quartets_.shrink_to_fit();
  links_.shrink_to_fit(), values_.shrink_to_fit();
}

/// Makes room for what `add_row` keeps.
template <class Scalar>
void PairStiffness<Scalar>::reserve(const AssembledPairs& pairs, const std::vector<char>& gathered) {
  std::size_t kept = 0, kept_rows = 1;
  for (int row = 0; row < pairs.rows(); ++row) {
    const auto before = kept;
    for (int pair = pairs.first[row]; pair < pairs.first[row + 1]; ++pair)
      kept += visited(pairs.node[row], gathered) || visited(pairs.high[pair], gathered);
    kept_rows += kept > before || visited(pairs.node[row], gathered);
  }
  high_.reserve(kept), blocks_.reserve(kept), rows_.reserve(kept_rows);
}

/// The owned nodes of a chunk: in runs where these are long, else in quartets.
template <class Scalar>
void PairStiffness<Scalar>::add_gathered(const RowTerms& rows, int begin, int end, TermLists& lists,
                                         Quartets& quartets) {
  gathered_ += end - begin;
  std::vector<Term> terms, next;
  int between = begin;  // where the nodes start that are in no run
  rows.of(begin, terms);
  for (int node = begin; node < end;) {
    int stop = node + 1;
    for (; stop < end; ++stop) {
      rows.of(stop, next);
      if (next != terms) break;
    }
    if (stop - node >= long_run) {
      if (between < node) add_quartets(rows, {between, node, 0, 0}, begin, end, lists, quartets);
      const auto [first, last] = lists.place(terms);
      runs_.push_back({node, stop, first, last});
      repeating_ += stop - node;
      between = stop;
    }
    std::swap(terms, next);
    node = stop;
  }
  if (between < end) add_quartets(rows, {between, end, 0, 0}, begin, end, lists, quartets);
}

/// The nodes of a stretch; where they are no multiple of four, with nodes beside it, whose forces are
/// gathered a second time, to the same bits. `begin` and `end` are those of the chunk.
template <class Scalar>
void PairStiffness<Scalar>::add_quartets(const RowTerms& rows, const Run& stretch, int begin, int end,
                                         TermLists& lists, Quartets& quartets) {
  std::array<std::vector<Term>, 4> terms;
  for (int node = stretch.begin; node < stretch.end; node += 4) {
    const int first = std::max(begin, std::min(node, end - 4));
    if (first + 4 <= end) {
      for (int k = 0; k < 4; ++k) rows.of(first + k, terms[k]);
      if (const auto quartet = quartets.make(first, terms)) {
        quartets_.push_back(*quartet);
        continue;
      }
    }
    for (int single = node; single < std::min(node + 4, stretch.end); ++single) {
      rows.of(single, terms[0]);
      const auto [of_first, of_last] = lists.place(terms[0]);
      runs_.push_back({single, single + 1, of_first, of_last});
    }
  }
}

/// Keeps the pairs of which an end is visited. A row without pairs is kept where its node is visited: its
/// force must be made zero.
template <class Scalar>
void PairStiffness<Scalar>::add_row(const AssembledPairs& pairs, int row, const std::vector<char>& gathered) {
  const int node = pairs.node[row];
  const auto first = static_cast<int>(high_.size());
  for (int pair = pairs.first[row]; pair < pairs.first[row + 1]; ++pair) {
    if (!visited(node, gathered) && !visited(pairs.high[pair], gathered)) continue;
    const auto& block = pairs.block[pair];
    high_.push_back(pairs.high[pair]);
    blocks_.push_back(
        {static_cast<Scalar>(block.xx), static_cast<Scalar>(block.xy), static_cast<Scalar>(block.yy)});
    if (block.skew != 0) skews_.push_back({static_cast<int>(rows_.size()), pairs.high[pair], block.skew});
  }
  if (visited(node, gathered) || first < static_cast<int>(high_.size())) rows_.push_back({node, first});
}

/// A node may move once nothing reads its displacement any more: its own row, and the rows of its neighbours
/// that are gathered. Four at a time, so that those who move them read whole lines of the cache.
template <class Scalar>
void PairStiffness<Scalar>::complete_in_order(const AssembledPairs& pairs,
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
    if (k + 1 < static_cast<int>(chunks_.size()))
      complete = std::max(chunks_[k].complete_begin, complete / 4 * 4);
    chunks_[k].complete_end = complete;
  }
  if (gathered_ < owned_) return;
  for (const Chunk& chunk : chunks_)
    passing_size_ =
        std::max(passing_size_, static_cast<std::size_t>(chunk.gathered_end - chunk.complete_begin));
  passing_size_ = rooms_for_what_passes * (passing_size_ + 4);
}

template class PairStiffness<double>;
template class PairStiffness<float>;

}  // namespace slipscale
