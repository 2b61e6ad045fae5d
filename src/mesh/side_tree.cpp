#include "side_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace slipscale::mesh_stages {

SideTree::SideTree(std::vector<OuterSide> sides) : sides_(std::move(sides)) {
  if (!sides_.empty()) build({0, 0, sides_.size()});
}

Box SideTree::box_of(const OuterSide& side) {
  const double little = 1e-6 * std::hypot(side.b[0] - side.a[0], side.b[1] - side.a[1]);
  Box box;
  for (int d = 0; d < 2; ++d) {
    box.lower[d] = std::min(side.a[d], side.b[d]) - little;
    box.upper[d] = std::max(side.a[d], side.b[d]) + little;
  }
  return box;
}

void SideTree::build(const Part& part) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Box box{{far, far}, {-far, -far}};
  for (std::size_t k = part.begin; k < part.end; ++k) {
    const Box each = box_of(sides_[k]);
    for (int d = 0; d < 2; ++d) {
      box.lower[d] = std::min(box.lower[d], each.lower[d]);
      box.upper[d] = std::max(box.upper[d], each.upper[d]);
    }
  }
  if (boxes_.size() <= part.box) boxes_.resize(part.box + 1);
  boxes_[part.box] = box;
  if (part.size() <= leaf) return;
  const int axis = box.width() >= box.height() ? 0 : 1;
  const auto begin = sides_.begin();
  std::nth_element(
      begin + static_cast<std::ptrdiff_t>(part.begin), begin + static_cast<std::ptrdiff_t>(part.low().end),
      begin + static_cast<std::ptrdiff_t>(part.end), [&](const OuterSide& one, const OuterSide& two) {
        return one.a[axis] + one.b[axis] < two.a[axis] + two.b[axis];
      });
  build(part.low());
  build(part.high());
}

bool SideTree::touch(const Box& one, const Box& two, const Vector2& shift) const {
  for (int d = 0; d < 2; ++d)
    if (one.upper[d] < two.lower[d] + shift[d] || two.upper[d] + shift[d] < one.lower[d]) return false;
  return true;
}

}  // namespace slipscale::mesh_stages
