#include "cells.hpp"

namespace slipscale::morphology {

Cells::Cells(const Domain& domain, double size) : domain_(domain) {
  constexpr double most = 2000;  // along an axis
  for (int axis = 0; axis < 2; ++axis)
    count_[axis] = static_cast<int>(std::clamp(std::floor(domain.extent(axis) / size), 1.0, most));
  entries_.resize(static_cast<std::size_t>(count_[0]) * count_[1]);
}

void Cells::clear() {
  for (auto& cell : entries_) cell.clear();
}

void Cells::add(int index, const Vector2& centre, double radius) {
  const Span at = span(centre, radius);
  for (int j = at.low[1]; j <= at.high[1]; ++j)
    for (int i = at.low[0]; i <= at.high[0]; ++i) {
      const Place place = placed({i, j});
      entries_[place.cell].push_back({index, place.turns, at.low});
    }
}

Cells::Span Cells::span(const Vector2& x, double radius) const {
  Span at;
  for (int axis = 0; axis < 2; ++axis) {
    const double size = domain_.extent(axis) / count_[axis], rest = x[axis] - domain_.box.lower[axis];
    at.low[axis] = static_cast<int>(std::floor((rest - radius) / size));
    at.high[axis] = static_cast<int>(std::floor((rest + radius) / size));
    if (domain_.periodic[axis]) continue;
    at.low[axis] = std::clamp(at.low[axis], 0, count_[axis] - 1);
    at.high[axis] = std::clamp(at.high[axis], 0, count_[axis] - 1);
  }
  return at;
}

Cells::Place Cells::placed(std::array<int, 2> cell) const {
  Place place{};
  for (int axis = 0; axis < 2; ++axis) {
    int& k = cell[axis];
    place.turns[axis] = (k >= 0 ? k : k - count_[axis] + 1) / count_[axis];
    k -= place.turns[axis] * count_[axis];
  }
  place.cell = static_cast<std::size_t>(cell[1]) * count_[0] + cell[0];
  return place;
}

}  // namespace slipscale::morphology
