#pragma once

#include <array>
#include <vector>

#include "slipscale/base/formula.hpp"
#include "slipscale/base/large_array.hpp"
#include "slipscale/base/state_group.hpp"
#include "slipscale/contact/nodal_step.hpp"
#include "slipscale/mesh/mesh.hpp"

namespace slipscale {

/// What accelerates every part of a body: the same everywhere and always, or formulas either of the place or
/// of time.
struct BodyAccelerationChoice {
  Vector2 value{};                         ///< m/s²; 1 where a formula stands
  std::array<SharedFormula, 2> formula{};  ///< the value is that number times it

  bool any() const { return value != Vector2{}; }
  bool of_time() const {
    return (formula[0] && formula[0]->of_time()) || (formula[1] && formula[1]->of_time());
  }
  bool of_place() const {
    return (formula[0] && formula[0]->of_place()) || (formula[1] && formula[1]->of_place());
  }
};

/// The same at work on one rank.
class BodyAcceleration {
 public:
  BodyAcceleration(const BodyAccelerationChoice& choice, const Mesh& mesh, double beta2, double time_step);

  /// At the beginning of a step from t_n = `time`, where the one before it is closed. False where a formula
  /// makes no number.
  bool follow(double time);
  bool of_time() const { return choice_.of_time(); }

  const Vector2& uniform() const { return uniform_; }  ///< at t_n, m/s²; where `field` is null
  const Vector2* field() const { return field_.empty() ? nullptr : field_.data(); }  ///< [owned nodes]
  Vector2 at(int node) const { return field_.empty() ? uniform_ : field_[node]; }

  /// Work so far at a node of that mass [kg/m], which is displaced by u, J/m. Of what does not vary in time
  /// it is that of its potential, without the part at the start.
  double work(int node, double mass, const Vector2& displacement) const {
    if (of_time()) return mass * done_[node];
    const Vector2 g = at(node);
    return mass * (g[0] * displacement[0] + g[1] * displacement[1]);
  }
  /// Of what varies in time: the work along the step that was made, see EnergyLedger.
  void add_work(const NodalState& state, double next_time);

  /// For a checkpoint: adds what later rows need of the steps so far.
  void add_state(StateGroup& nodes);

 private:
  const BodyAccelerationChoice choice_;
  const double beta2_, time_step_;
  Vector2 uniform_;
  std::vector<Vector2> field_;
  LargeArray<double> done_, waiting_;  ///< by node, over its mass: to t_n, and along the coming step, m²/s²
};

}  // namespace slipscale
