#include "slipscale/morphology/mesh_size.hpp"

#include <algorithm>
#include <cmath>

namespace slipscale {

SizeField::SizeField(const MeshSize& size, const Box& block, const Drawing& drawing)
    : size_(size), block_(block) {
  if (size.interface >= size.bulk) return;
  reach_ = (size.bulk - size.interface) / size.growth;
  columns_ = std::clamp(static_cast<int>(block.width() / reach_), 1, 4096);
  rows_ = std::clamp(static_cast<int>(block.height() / reach_), 1, 4096);
  bins_.resize(static_cast<std::size_t>(columns_) * rows_);
  for (const Drawing::Segment& segment : drawing.segments) {
    if (segment.sides) continue;
    const Vector2 &a = drawing.points[segment.from], &b = drawing.points[segment.to];
    const int count = 1 + static_cast<int>(2 * std::hypot(b[0] - a[0], b[1] - a[1]) / size.interface);
    for (int i = 0; i <= count; ++i) {
      const double part = static_cast<double>(i) / count;
      const Vector2 x{a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])};
      const int column = std::clamp(static_cast<int>((x[0] - block.lower[0]) / block.width() * columns_), 0,
                                    columns_ - 1),
                row = std::clamp(static_cast<int>((x[1] - block.lower[1]) / block.height() * rows_), 0,
                                 rows_ - 1);
      bins_[static_cast<std::size_t>(row) * columns_ + column].push_back(x);
    }
  }
}

double SizeField::distance_to_interface(const Vector2& x) const {
  const int column = static_cast<int>((x[0] - block_.lower[0]) / block_.width() * columns_),
            row = static_cast<int>((x[1] - block_.lower[1]) / block_.height() * rows_);
  double nearest = reach_ * reach_;
  for (int r = std::max(0, row - 1); r <= std::min(rows_ - 1, row + 1); ++r)
    for (int c = std::max(0, column - 1); c <= std::min(columns_ - 1, column + 1); ++c)
      for (const Vector2& point : bins_[static_cast<std::size_t>(r) * columns_ + c]) {
        const double dx = x[0] - point[0], dy = x[1] - point[1];
        nearest = std::min(nearest, dx * dx + dy * dy);
      }
  return std::sqrt(nearest);
}

double SizeField::operator()(const Vector2& x) const {
  double size = size_.bulk;
  if (size_.surface < size_.bulk)
    size = std::min(size, size_.surface + size_.growth * std::max(0.0, x[1] - block_.lower[1]));
  if (size_.interface < size_.bulk)
    size = std::min(size, size_.interface + size_.growth * distance_to_interface(x));
  return size;
}

}  // namespace slipscale
