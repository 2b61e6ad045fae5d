#pragma once

#include <array>
#include <optional>
#include <vector>

#include "body.hpp"
#include "slipscale/morphology/grey_image.hpp"

namespace slipscale::morphology {

/// The line on which the grey of a picture, bilinear between the centres of its pixels, has one level. The
/// picture goes on across periodic axes; at other sides the half pixel outside the centres has their grey.
class Contour {
 public:
  /// The lower left corner of the picture lies in the origin; `pixel` in m.
  Contour(const GreyPicture& picture, const std::array<bool, 2>& periodic, double pixel, double level);

  double level() const { return level_; }
  void set_level(double level) { level_ = level; }
  double pixel() const { return pixel_; }
  int pixels(int axis) const { return count_[axis]; }

  /// Grey less the level.
  double above(const Vector2& x) const;
  bool inside(const Vector2& x) const { return above(x) >= 0; }

  /// Where the contour crosses the line x[1 - axis] = at between two places on it: all crossings, ascending,
  /// m. The grey is linear between the lines through the centres.
  std::vector<double> crossings(int axis, double at, double from, double to) const;

  /// A point of the contour near x, by Newton's method along the gradient; none where that does not come to
  /// one within two pixels. Its curvature is left at zero.
  std::optional<Foot> near(const Vector2& x) const;

 private:
  /// The four centres around x: their grey less the level, and where between them x lies.
  struct Patch {
    std::array<std::array<double, 2>, 2> grey;  ///< [row][column]
    Vector2 part;
  };
  Patch patch(const Vector2& x) const;
  int folded(int k, int axis) const;

  std::array<int, 2> count_;
  std::array<bool, 2> periodic_;
  double pixel_, level_;
  std::vector<double> grey_;  ///< row by row from the bottom
};

}  // namespace slipscale::morphology
