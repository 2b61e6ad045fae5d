#pragma once

#include <string>

#include "slipscale/base/options.hpp"

namespace slipscale {

/// The rigid surface below the body. It moves along +x and reaches its speed along a cosine ramp.
///
/// It is flat unless its height is a formula of x: then it pushes the body up and down as that height does
/// where each node started, which holds for slopes so small that normal and vertical may be taken for one
/// another. A profile that travels with the surface is a formula of x − Vt.
struct Surface {
  std::string boundary;  ///< the body's boundary that meets it
  double height = 0;     ///< m
  double speed = 0;      ///< V, m/s
  double ramp = 0;       ///< s; 0: at full speed from the start
  // Where a formula stands, the value is that number, 1, times it:
  SharedFormula height_formula{}, speed_formula{};

  double velocity(double time) const;  ///< m/s
  double travel(double time) const;    ///< path since t = 0, m; of a speed without formula
  /// Path from one time to another, m; where the speed is a formula the integral by Gauss's rule of three
  /// points, of order 6 in their distance.
  double travel(double from, double to) const;
  bool moves() const { return speed_formula || speed != 0; }
  double height_at(double x, double time) const {
    return height_formula ? height * (*height_formula)({x, 0}, time) : height;
  }
};

Schema surface_schema();
bool has_surface(const Options& options);
extern const Idle without_surface;  ///< what options say that need one
Surface read_surface(const Options& options);
std::string describe(const Surface& surface);

}  // namespace slipscale
