#include <algorithm>

#include "slipscale/morphology/grey_image.hpp"

namespace slipscale {
namespace {

/// The pixel that stands for one `at` places along an axis of `count`, which may lie outside.
int folded(int at, int count, bool periodic) {
  const int period = periodic ? count : 2 * count;
  const int place = (at % period + period) % period;
  return place < count ? place : period - 1 - place;
}

}  // namespace

void median_filter(GreyPicture& picture, const std::array<bool, 2>& periodic, int reach) {
  if (reach == 0) return;
  const std::vector<double> before = picture.grey;
  std::vector<double> around;
  std::vector<int> columns;
  for (int row = 0; row < picture.rows; ++row)
    for (int column = 0; column < picture.columns; ++column) {
      around.clear();
      columns.clear();
      for (int k = -reach; k <= reach; ++k)
        columns.push_back(folded(column + k, picture.columns, periodic[0]));
      for (int k = -reach; k <= reach; ++k) {
        const std::size_t line =
            static_cast<std::size_t>(folded(row + k, picture.rows, periodic[1])) * picture.columns;
        for (const int other : columns) around.push_back(before[line + other]);
      }
      const auto middle = around.begin() + static_cast<std::ptrdiff_t>(around.size() / 2);
      std::ranges::nth_element(around, middle);
      picture.grey[static_cast<std::size_t>(row) * picture.columns + column] = *middle;
    }
}

}  // namespace slipscale
