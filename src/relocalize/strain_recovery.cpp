#include "slipscale/relocalize/strain_recovery.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <utility>

namespace slipscale {
namespace {

constexpr std::size_t fewest = 4;     ///< cells of a patch: one more than the polynomial has coefficients
constexpr double most_amplified = 4;  ///< of a patch: Σ w², by which the variance of noise grows
constexpr int most_growths = 3;       ///< of a patch
constexpr double on_a_line = 1e-12;   ///< least over largest moment of the centres, below which they are

struct Fit {
  std::vector<double> weights;  ///< of the patch's cells; their sum is 1
  bool well_posed = false;
};

/// Value at `x` of the linear polynomial that fits values at the centres best. Where the centres lie on a
/// line it is constant across that.
Fit fit(const std::vector<int>& patch, const std::vector<Vector2>& centres, const Vector2& x) {
  const auto at = [](const Vector2& p) { return Eigen::Vector2d(p[0], p[1]); };
  const double share = 1 / static_cast<double>(patch.size());
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const int cell : patch) mean += share * (at(centres[cell]) - at(x));  // seen from x: no digits lost
  Eigen::Matrix2d moment = Eigen::Matrix2d::Zero();
  for (const int cell : patch) {
    const Eigen::Vector2d arm = at(centres[cell]) - at(x) - mean;
    moment += arm * arm.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(moment);
  const Eigen::Vector2d values = axes.eigenvalues();
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();  // weight = share + slope · arm
  for (int i = 0; i < 2; ++i)
    if (values[i] > on_a_line * values[1])
      slope -= axes.eigenvectors().col(i).dot(mean) / values[i] * axes.eigenvectors().col(i);
  Fit found;
  double amplified = 0;
  for (const int cell : patch) {
    found.weights.push_back(share + slope.dot(at(centres[cell]) - at(x) - mean));
    amplified += found.weights.back() * found.weights.back();
  }
  found.well_posed =
      patch.size() >= fewest && values[0] > on_a_line * values[1] && amplified <= most_amplified;
  return found;
}

}  // namespace

PatchRecovery::PatchRecovery(const PlaneGrid& grid) : corner_first_(grid.first) {
  number_nodes(grid);
  std::vector<Vector2> position(around_first_.size() - 1);
  for (std::size_t k = 0; k < corner_nodes_.size(); ++k)
    position[corner_nodes_[k]] = grid.points[grid.corners[k]];
  const std::vector<Vector2> middles = centres(grid);
  for (std::size_t n = 0; n < position.size(); ++n) add_node(static_cast<int>(n), middles, position[n]);
}

/// A node is a point as one region sees it.
void PatchRecovery::number_nodes(const PlaneGrid& grid) {
  std::vector<std::pair<int, int>> nodes;
  nodes.reserve(grid.corners.size());
  for (int cell = 0; cell < grid.cells(); ++cell)
    for (int k = grid.first[cell]; k < grid.first[cell + 1]; ++k)
      nodes.emplace_back(grid.corners[k], grid.region[cell]);
  std::vector<std::pair<int, int>> distinct(nodes);
  std::sort(distinct.begin(), distinct.end());
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  corner_nodes_.reserve(nodes.size());
  around_first_.assign(distinct.size() + 1, 0);
  for (const auto& node : nodes) {
    const auto at = std::lower_bound(distinct.begin(), distinct.end(), node) - distinct.begin();
    corner_nodes_.push_back(static_cast<int>(at));
    ++around_first_[static_cast<std::size_t>(at) + 1];
  }
  for (std::size_t n = 1; n < around_first_.size(); ++n) around_first_[n] += around_first_[n - 1];
  around_.resize(corner_nodes_.size());
  std::vector<int> next(around_first_);
  for (int cell = 0; cell < grid.cells(); ++cell)
    for (const int node : nodes_of(cell)) around_[next[node]++] = cell;
}

std::vector<int> PatchRecovery::grown(const std::vector<int>& patch) const {
  std::vector<int> larger;
  for (const int cell : patch)
    for (const int node : nodes_of(cell))
      larger.insert(larger.end(), around_.begin() + around_first_[node],
                    around_.begin() + around_first_[node + 1]);
  std::sort(larger.begin(), larger.end());
  larger.erase(std::unique(larger.begin(), larger.end()), larger.end());
  return larger;
}

void PatchRecovery::add_node(int node, const std::vector<Vector2>& centres, const Vector2& x) {
  std::vector<int> patch(around_.begin() + around_first_[node], around_.begin() + around_first_[node + 1]);
  Fit found = fit(patch, centres, x);
  for (int growth = 0; !found.well_posed && growth < most_growths; ++growth) {
    patch = grown(patch);
    found = fit(patch, centres, x);
  }
  cell_.insert(cell_.end(), patch.begin(), patch.end());
  weight_.insert(weight_.end(), found.weights.begin(), found.weights.end());
  first_.push_back(static_cast<int>(cell_.size()));
}

StrainRecovery::StrainRecovery(const PlaneGrid& grid, Recovery recovery, std::span<const CellPlace> places) {
  if (recovery == Recovery::element) {
    for (const CellPlace& place : places) element_.push_back(place.cell);
    return;
  }
  patches_.emplace_back(grid);
  nodal_.reserve(places.size());
  for (const CellPlace& place : places) {
    NodalPoint point{{}, place.shape};
    const auto nodes = patches_.front().nodes_of(place.cell);
    std::copy(nodes.begin(), nodes.end(), point.node.begin());
    nodal_.push_back(point);
  }
}

template <std::size_t N>
void StrainRecovery::evaluate(std::span<const std::array<double, N>> cells,
                              std::span<std::array<double, N>> points,
                              std::vector<std::array<double, N>>& nodes) {
  for (std::size_t p = 0; p < element_.size(); ++p) points[p] = cells[element_[p]];
  if (patches_.empty()) return;
  nodes.resize(static_cast<std::size_t>(patches_.front().nodes()));
  patches_.front()(cells, std::span(nodes));
  for (std::size_t p = 0; p < nodal_.size(); ++p) {
    points[p].fill(0);
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t i = 0; i < N; ++i) points[p][i] += nodal_[p].shape[k] * nodes[nodal_[p].node[k]][i];
  }
}

template void StrainRecovery::evaluate(std::span<const std::array<double, 3>>,
                                       std::span<std::array<double, 3>>, std::vector<std::array<double, 3>>&);
template void StrainRecovery::evaluate(std::span<const std::array<double, 6>>,
                                       std::span<std::array<double, 6>>, std::vector<std::array<double, 6>>&);

}  // namespace slipscale
