#include <algorithm>
#include <cmath>

#include "fitted_grid.hpp"
#include "plane.hpp"

namespace slipscale::morphology {
namespace {

constexpr double farthest = 0.25;  ///< in cells; beyond it the interface is moved where it is straight too

/// Ways of the nodes on interfaces, m per unit of correction.
class Correction {
 public:
  Correction(Fit& fit, const std::vector<double>& drawn)
      : fit_(fit),
        drawn_(drawn),
        step_(std::min(fit.lattice.step(0), fit.lattice.step(1))),
        largest_(drawn.size()),
        straight_too_(drawn.size()) {}

  void work() {
    weigh();
    std::vector<double> by = solve();
    for (std::size_t part = 0; part < drawn_.size(); ++part)
      straight_too_[part] = !(std::abs(by[part]) * largest_[part] <= farthest * step_);
    if (std::ranges::find(straight_too_, true) != straight_too_.end()) {
      weigh();
      by = solve();
    }
    for (const auto& [node, way] : way_)
      if (std::isfinite(by[fit_.on[node]])) fit_.moved[node] = fit_.moved[node] + by[fit_.on[node]] * way;
  }

 private:
  /// A chord's error goes with the curvature. Nodes on the block's sides stay.
  void weigh() {
    way_.clear();
    std::ranges::fill(largest_, 0.0);
    for (const auto& [node, touch] : fit_.touches) {
      const int part = fit_.on[node];
      const Foot foot = fit_.foot(node, fit_.moved[node]);
      const double weight = straight_too_[part] ? 1 : foot.curvature * step_;
      const Place place = fit_.lattice.place(node);
      if (fit_.lattice.on_side(place, 0) || fit_.lattice.on_side(place, 1) || weight == 0) continue;
      way_[node] = weight * foot.normal;
      largest_[part] = std::max(largest_[part], weight);
    }
  }

  Vector2 moved(const Place& place, double by) const {
    const Vector2 x = fit_.position(place);
    const auto way = way_.find(fit_.lattice.node(place));
    return way == way_.end() ? x : x + by * way->second;
  }

  /// The area is quadratic in the correction: three values give it.
  std::vector<double> solve() const {
    const std::array<double, 3> at{-0.1 * step_, 0, 0.1 * step_};
    std::vector<std::array<double, 3>> area(drawn_.size());
    const double whole = fit_.lattice.step(0) * fit_.lattice.step(1);
    for (int row = 0; row < fit_.lattice.cells(1); ++row)
      for (int column = 0; column < fit_.lattice.cells(0); ++column) add({column, row}, at, whole, area);
    std::vector<double> by(drawn_.size());
    for (std::size_t part = 0; part < drawn_.size(); ++part) {
      const auto& [less, same, more] = area[part];
      const double slope = (more - less) / (at[2] - at[0]),
                   bend = (more - 2 * same + less) / (2 * at[2] * at[2]), missing = drawn_[part] - same;
      const double root = slope * slope + 4 * bend * missing;
      by[part] = missing == 0 ? 0 : 2 * missing / (slope + std::sqrt(root));
    }
    return by;
  }

  void add(const Place& low, const std::array<double, 3>& at, double whole,
           std::vector<std::array<double, 3>>& area) const {
    const auto places = corners(low);
    const int node = fit_.lattice.node(low);
    if (std::ranges::all_of(places, [&](const Place& p) { return untouched(fit_.lattice.node(p)); })) {
      if (fit_.inside[node] != nobody)
        for (double& sum : area[fit_.inside[node]]) sum += whole;
      return;
    }
    const Square cut = square(fit_, low);
    for (int k = 0; k < cut.count; ++k) {
      const Square::Cell& cell = cut.cells[k];
      if (cell.part == nobody) continue;
      for (int value = 0; value < 3; ++value) {
        std::array<Vector2, 4> x;
        for (int i = 0; i < cell.count; ++i) x[i] = moved(places[cell.corners[i]], at[value]);
        for (int i = 1; i + 1 < cell.count; ++i)
          area[cell.part][value] += 0.5 * cross(x[i] - x[0], x[i + 1] - x[0]);
      }
    }
  }

  bool untouched(int node) const { return fit_.on[node] == nobody && fit_.moved[node] == Vector2{}; }

  Fit& fit_;
  const std::vector<double>& drawn_;
  double step_;
  std::vector<double> largest_;
  std::vector<char> straight_too_;
  std::map<int, Vector2> way_;
};

}  // namespace

void correct_areas(Fit& fit, const std::vector<double>& drawn) { Correction(fit, drawn).work(); }

}  // namespace slipscale::morphology
