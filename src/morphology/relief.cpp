#include "relief.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "plane.hpp"
#include "slipscale/morphology/quality.hpp"
#include "slipscale/solid/element.hpp"
#include "slipscale/solid/material.hpp"

namespace slipscale::morphology {
namespace {

constexpr double good_enough =
    0.82;                          ///< step, as `step_around` counts it; the inner interfaces allow as much
constexpr double farthest = 0.75;  ///< in squares, that a node is moved
constexpr int most_passes = 12;
constexpr double sharpest = 18 * std::numbers::pi / 180;  ///< angle; a cell with less counts for less

}  // namespace

double step_around(const Fit& fit, const Place& place) {
  static const Eigen::Matrix3d elasticity = isotropic_stiffness(1, 0.3);
  constexpr int across = 3, nodes = across * across;
  Eigen::Matrix<double, 2 * nodes, 2 * nodes> stiffness;
  stiffness.setZero();
  std::array<double, nodes> mass{};
  double angle = sharpest;
  const auto index = [&](const Place& at) {
    const int column = at[0] - place[0] + 1, row = at[1] - place[1] + 1;
    return column < 0 || column >= across || row < 0 || row >= across ? -1 : row * across + column;
  };
  for (int row = -2; row < 2; ++row)
    for (int column = -2; column < 2; ++column) {
      const Place low{place[0] + column, place[1] + row};
      if (!fit.lattice.has_square(low)) continue;
      const auto places = corners(low);
      const Square cut = square(fit, low);
      for (int k = 0; k < cut.count; ++k) {
        const Square::Cell& cell = cut.cells[k];
        std::array<Vector2, 4> x;
        for (int i = 0; i < cell.count; ++i) x[i] = fit.position(places[cell.corners[i]]);
        const std::span<const Vector2> shape(x.data(), static_cast<std::size_t>(cell.count));
        for (int i = 0; i < cell.count; ++i)
          if (places[cell.corners[i]] == place)
            angle = std::min(angle, worst_angle({shape.begin(), shape.end()}));
        const ElementStiffness local = element_stiffness(shape, elasticity);
        const auto areas = corner_areas(shape);
        for (int i = 0; i < cell.count; ++i) {
          const int a = index(places[cell.corners[i]]);
          if (a < 0) continue;
          if (areas[i] <= 0) return 0;
          mass[a] += areas[i];
          for (int j = 0; j < cell.count; ++j)
            if (const int b = index(places[cell.corners[j]]); b >= 0)
              stiffness.block<2, 2>(2 * a, 2 * b) += local.block<2, 2>(2 * i, 2 * j);
        }
      }
    }
  for (int a = 0; a < nodes; ++a)
    for (int b = 0; b < nodes; ++b)
      if (mass[a] > 0 && mass[b] > 0) stiffness.block<2, 2>(2 * a, 2 * b) /= std::sqrt(mass[a] * mass[b]);
  const double largest = Eigen::SelfAdjointEigenSolver<decltype(stiffness)>(stiffness, Eigen::EigenvaluesOnly)
                             .eigenvalues()
                             .maxCoeff();
  const double step = 2 * std::sqrt(elasticity(0, 0) / largest / (fit.lattice.step(0) * fit.lattice.step(1)));
  return step * angle / sharpest;
}

namespace {

class Relief {
 public:
  explicit Relief(Fit& fit) : fit_(fit) {}

  int work() {
    const Lattice& lattice = fit_.lattice;
    std::set<int> near;  // nodes at interfaces that cut a side
    for (const auto& [node, touch] : fit_.touches)
      if (const Place at = lattice.place(node); lattice.on_side(at, 0) || lattice.on_side(at, 1))
        visit_around(at, 3, [&](const Place& place) { near.insert(lattice.node(place)); });
    for (int pass = 0; pass < most_passes; ++pass) {
      std::vector<std::pair<double, int>> poor;
      for (const int node : near)
        if (const double step = step_around(fit_, lattice.place(node)); step < good_enough)
          poor.push_back({step, node});
      std::ranges::sort(poor);
      const int before = moves_;
      for (const auto& [step, node] : poor)
        if (step_around(fit_, lattice.place(node)) < good_enough)
          visit_around(lattice.place(node), 1, [&](const Place& place) { slide(place); });
      if (moves_ == before) break;
    }
    return moves_;
  }

 private:
  template <class Visit>
  void visit_around(const Place& place, int reach, Visit&& visit) const {
    for (int row = -reach; row <= reach; ++row)
      for (int column = -reach; column <= reach; ++column)
        if (const Place near{place[0] + column, place[1] + row}; fit_.lattice.has_node(near)) visit(near);
  }

  double least_around(const Place& place) const {
    double least = 1e300;
    visit_around(place, 1, [&](const Place& near) { least = std::min(least, step_around(fit_, near)); });
    return least;
  }

  /// Directions in which a node may go.
  std::vector<Vector2> ways(const Place& place, int node) const {
    const bool x = fit_.lattice.on_side(place, 0), y = fit_.lattice.on_side(place, 1);
    const bool on = fit_.on[node] != nobody;
    if ((x && y) || ((x || y) && on)) return {};
    if (x || y) return {{x ? 0.0 : 1.0, y ? 0.0 : 1.0}};
    if (on) return {turned(fit_.foot(node, fit_.moved[node]).normal)};
    return {};
  }

  void slide(const Place& place) {
    const int node = fit_.lattice.node(place);
    const double h = std::min(fit_.lattice.step(0), fit_.lattice.step(1));
    double best = least_around(place);
    for (double length = 0.2; length > 0.02; length *= 0.5)
      for (const Vector2& way : ways(place, node))
        for (const double sign : {-1.0, 1.0})
          for (int stride = 0; stride < 4; ++stride) {
            const Vector2 before = fit_.moved[node];
            Vector2 by = before + (sign * length * h) * way;
            if (fit_.on[node] != nobody)
              by = fit_.foot(node, by).x - fit_.lattice.position(fit_.touches.at(node).seen);
            if (norm(by) > farthest * h) break;
            fit_.moved[node] = by;
            const double least = least_around(place);
            if (least <= best) {
              fit_.moved[node] = before;
              break;
            }
            best = least;
            ++moves_;
          }
  }

  Fit& fit_;
  int moves_ = 0;
};

}  // namespace

int relieve(Fit& fit) { return Relief(fit).work(); }

}  // namespace slipscale::morphology
