#pragma once

#include <string>

#include "slipscale/base/options.hpp"

namespace slipscale {

/// The rigid flat surface below the body. It moves along +x and reaches its speed along a cosine ramp.
struct Surface {
  std::string boundary;  ///< the body's boundary that meets it
  double height = 0;     ///< m
  double speed = 0;      ///< V, m/s
  double ramp = 0;       ///< s; 0: at full speed from the start

  double velocity(double time) const;  ///< m/s
  double travel(double time) const;    ///< path since t = 0, m
};

Schema surface_schema();
bool has_surface(const Options& options);
extern const Idle without_surface;  ///< what options say that need one
Surface read_surface(const Options& options);

}  // namespace slipscale
