#pragma once

#include <vector>

#include "slipscale/morphology/drawing.hpp"

namespace slipscale {

/// The edge length wanted at each point of the block.
class SizeField {
 public:
  SizeField(const MeshSize& size, const Box& block, const Drawing& drawing);
  double operator()(const Vector2& x) const;  ///< m
  bool uniform() const { return size_.bulk <= size_.interface && size_.bulk <= size_.surface; }

 private:
  double distance_to_interface(const Vector2& x) const;

  const MeshSize size_;
  const Box block_;
  double reach_ = 0;  ///< distance beyond which interfaces do not matter, m; width of a bin
  int columns_ = 1, rows_ = 1;
  std::vector<std::vector<Vector2>> bins_;  ///< points on interfaces, dense against the edge length there
};

}  // namespace slipscale
