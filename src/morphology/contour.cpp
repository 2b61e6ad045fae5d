#include "contour.hpp"

#include <algorithm>
#include <cmath>

#include "plane.hpp"

namespace slipscale::morphology {

Contour::Contour(const GreyPicture& picture, const std::array<bool, 2>& periodic, double pixel, double level)
    : count_{picture.columns, picture.rows}, periodic_(periodic), pixel_(pixel), level_(level) {
  grey_.reserve(picture.grey.size());
  for (std::ptrdiff_t row = picture.rows - 1; row >= 0; --row)
    grey_.insert(grey_.end(), picture.grey.begin() + row * picture.columns,
                 picture.grey.begin() + (row + 1) * picture.columns);
}

int Contour::folded(int k, int axis) const {
  const int count = count_[axis];
  return periodic_[axis] ? (k % count + count) % count : std::clamp(k, 0, count - 1);
}

Contour::Patch Contour::patch(const Vector2& x) const {
  std::array<std::array<int, 2>, 2> at{};  // [axis][lower, upper]
  Patch found{};
  for (int axis = 0; axis < 2; ++axis) {
    const double u = x[axis] / pixel_ - 0.5, low = std::floor(u);
    found.part[axis] = u - low;
    for (const int upper : {0, 1}) at[axis][upper] = folded(static_cast<int>(low) + upper, axis);
  }
  for (const int row : {0, 1})
    for (const int column : {0, 1})
      found.grey[row][column] =
          grey_[static_cast<std::size_t>(at[1][row]) * count_[0] + at[0][column]] - level_;
  return found;
}

double Contour::above(const Vector2& x) const {
  const Patch p = patch(x);
  return std::lerp(std::lerp(p.grey[0][0], p.grey[0][1], p.part[0]),
                   std::lerp(p.grey[1][0], p.grey[1][1], p.part[0]), p.part[1]);
}

std::vector<double> Contour::crossings(int axis, double at, double from, double to) const {
  std::vector<double> found;
  Vector2 x{};
  x[1 - axis] = at;
  const auto value = [&](double along) {
    x[axis] = along;
    return above(x);
  };
  double last = from, before = value(from);
  const auto visit = [&](double next) {
    const double here = value(next);
    if ((before >= 0) != (here >= 0)) found.push_back(last + (next - last) * before / (before - here));
    last = next;
    before = here;
  };
  for (double centre = (std::floor(from / pixel_ - 0.5) + 1.5) * pixel_; centre < to; centre += pixel_)
    if (centre > from) visit(centre);
  visit(to);
  return found;
}

std::optional<Foot> Contour::near(const Vector2& x) const {
  constexpr int most_steps = 20;
  constexpr double close = 1e-10, farthest = 2;  // in pixels
  Foot foot{x, {}};
  for (int step = 0; step < most_steps; ++step) {
    const Patch p = patch(foot.x);
    const Vector2 slope{
        std::lerp(p.grey[0][1] - p.grey[0][0], p.grey[1][1] - p.grey[1][0], p.part[1]) / pixel_,
        std::lerp(p.grey[1][0] - p.grey[0][0], p.grey[1][1] - p.grey[0][1], p.part[0]) / pixel_};
    const double steep = norm(slope);
    if (steep == 0) return std::nullopt;
    foot.normal = (-1 / steep) * slope;
    const double way = above(foot.x) / steep;
    foot.x = foot.x + std::clamp(way, -pixel_, pixel_) * foot.normal;
    if (norm(foot.x - x) > farthest * pixel_) return std::nullopt;
    if (std::abs(way) < close * pixel_) return foot;
  }
  return std::nullopt;
}

}  // namespace slipscale::morphology
