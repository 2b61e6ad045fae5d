#include "slipscale/morphology/picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "slipscale/morphology/grey_image.hpp"

namespace slipscale {
namespace {

using Colour = std::array<std::uint8_t, 3>;

/// Matrix in pale grey, then colours that stay apart for the colour-blind (Okabe and Ito).
constexpr std::array<Colour, 8> palette{{{224, 224, 220},
                                         {0, 114, 178},
                                         {230, 159, 0},
                                         {0, 158, 115},
                                         {204, 121, 167},
                                         {86, 180, 233},
                                         {213, 94, 0},
                                         {240, 228, 66}}};
constexpr double longer_side = 1200;

class Canvas {
 public:
  Canvas(const CompositeMesh& mesh) {
    Vector2 high = low_ = mesh.nodes.front();
    for (const Vector2& x : mesh.nodes)
      for (int axis = 0; axis < 2; ++axis) {
        low_[axis] = std::min(low_[axis], x[axis]);
        high[axis] = std::max(high[axis], x[axis]);
      }
    scale_ = longer_side / std::max(high[0] - low_[0], high[1] - low_[1]);
    columns = std::max(1, static_cast<int>(std::lround((high[0] - low_[0]) * scale_)));
    rows = std::max(1, static_cast<int>(std::lround((high[1] - low_[1]) * scale_)));
    rgb.assign(3 * static_cast<std::size_t>(columns) * rows, 255);
  }

  /// In pixels, y downwards.
  Vector2 pixel(const Vector2& x) const {
    return {(x[0] - low_[0]) * scale_, rows - (x[1] - low_[1]) * scale_};
  }

  void paint(int column, int row, const Colour& colour) {
    if (column < 0 || column >= columns || row < 0 || row >= rows) return;
    std::ranges::copy(colour, rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(row) * columns + column));
  }

  /// Every pixel whose centre lies in the convex polygon.
  void fill(const std::vector<Vector2>& corners, const Colour& colour) {
    double top = rows, bottom = 0;
    for (const Vector2& x : corners) {
      top = std::min(top, x[1]);
      bottom = std::max(bottom, x[1]);
    }
    for (int row = std::max(0, static_cast<int>(top - 0.5)); row < std::min<double>(rows, bottom + 0.5);
         ++row) {
      double from = columns, to = 0;
      const double y = row + 0.5;
      for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
        const Vector2 &a = corners[i], &b = corners[j];
        if ((a[1] > y) == (b[1] > y)) continue;
        const double x = a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]);
        from = std::min(from, x);
        to = std::max(to, x);
      }
      for (int column = static_cast<int>(std::ceil(from - 0.5)); column + 0.5 <= to; ++column)
        paint(column, row, colour);
    }
  }

  void line(const Vector2& a, const Vector2& b, const Colour& colour) {
    const int count = 1 + static_cast<int>(std::max(std::abs(b[0] - a[0]), std::abs(b[1] - a[1])));
    for (int i = 0; i <= count; ++i)
      paint(static_cast<int>(a[0] + (b[0] - a[0]) * i / count),
            static_cast<int>(a[1] + (b[1] - a[1]) * i / count), colour);
  }

  int columns = 0, rows = 0;
  std::vector<std::uint8_t> rgb;

 private:
  Vector2 low_{};
  double scale_ = 1;
};

Colour darker(const Colour& colour) {
  Colour dark;
  for (int i = 0; i < 3; ++i) dark[i] = static_cast<std::uint8_t>(colour[i] * 7 / 10);
  return dark;
}

}  // namespace

void write_picture(const CompositeMesh& mesh, const std::string& path) {
  Canvas canvas(mesh);
  const bool with_edges =
      static_cast<double>(canvas.columns) * canvas.rows / static_cast<double>(mesh.cells.size()) >= 6 * 6;
  for (const bool edges : {false, true}) {
    if (edges && !with_edges) break;
    for (const CompositeMesh::Cell& cell : mesh.cells) {
      std::vector<Vector2> corners = mesh.corners(cell);
      for (Vector2& x : corners) x = canvas.pixel(x);
      const Colour& colour = palette[static_cast<std::size_t>(cell.region) % palette.size()];
      if (!edges) canvas.fill(corners, colour);
      for (std::size_t i = 0; edges && i < corners.size(); ++i)
        canvas.line(corners[i], corners[(i + 1) % corners.size()], darker(colour));
    }
  }
  write_png(path, canvas.columns, canvas.rows, canvas.rgb);
}

}  // namespace slipscale
