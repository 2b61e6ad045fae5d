#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "scenes.hpp"

namespace slipscale::testing_support {

/// A scene that can be looked at in other ways without changing what happens. Units SI.
struct Case {
  std::string name;
  Block block;
  std::vector<Material> materials;  ///< [regions]
  Scene scene;
  double step = 5e-9;  ///< s
  int steps = 0;
};

/// Scene R up to 30 µs, where nodes slip and open.
Case pressed_case(Shape shape, bool stored_strength);
/// A block that lands at an angle, with both dampings, gravity, β2 > ½ and a law that asks the slip rate;
/// within 10 µs nodes stick, slip and open.
Case landing_case(bool stored_strength);
/// The same with an inclusion that has no symmetry to the axes, neither in shape nor in its stiffness.
Case with_inclusion(Case original);

/// The image in a mirror x → width − x: also of the mesh, and of couplings of stretch with shear.
Case mirrored(Case original);
/// V, all loads and velocities, the gap and the slip lengths L and V* times `factor`; L* = T|V| with them.
Case scaled(Case original, double factor);

struct Units {
  double length = 1, time = 1, mass = 1;  ///< new units in one old unit
  double speed() const { return length / time; }
  double acceleration() const { return length / (time * time); }
  double stress() const { return mass / (length * time * time); }
  double density() const { return mass / (length * length * length); }
};
Case in_units(Case original, const Units& units);

/// The end of a run: displacement and velocity of all nodes by column and row of the block.
struct State {
  std::map<std::pair<long, long>, std::array<double, 4>> places;  ///< u_x, u_y in m, v_x, v_y in m/s
  StatusCount count;                                              ///< over all steps
};
State run(const Case& what);

State mirrored(const State& state, int columns);
State divided(const State& state, double displacement, double velocity);

/// Largest difference of any component, relative to the largest value of that component in `expected`;
/// infinite when a value is not finite, a component is zero everywhere or the places differ.
double largest_difference(const State& expected, const State& found);

}  // namespace slipscale::testing_support
