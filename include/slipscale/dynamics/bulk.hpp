#pragma once

#include "slipscale/base/vector2.hpp"
#include "slipscale/dynamics/scheme.hpp"

namespace slipscale {

/// Sums over the owned nodes that the energy ledger needs when the bulk dissipates.
struct BulkSums {
  double increment_force = 0;  ///< Δuᵀ K Δu of the step just closed, J/m
  double increment_inertia = 0;  ///< Δaᵀ M Δa of the step just closed, N²/kg/m
  double damping_past = 0;     ///< damping force at t_n times u_n − u_{n−1}, J/m
  double damping_next = 0;     ///< damping force at t_n times u_{n+1} − u_n, J/m
};

/// What the free motion of a node needs; arrays by local node.
struct BulkArrays {
  const double* inverse_mass;     ///< m/kg
  const Vector2* force;           ///< K u_n, N/m
  const Vector2* previous_force;  ///< K u_{n−1}, N/m; read only where the physics needs it
  Vector2 *displacement, *velocity, *acceleration;
};

/// The bulk physics that a scene can have; a scene without it does not pay for it.
struct BulkPhysics {
  bool mass_damping = false, stiffness_damping = false, numerical_dissipation = false;
  constexpr bool keeps_force() const { return mass_damping || stiffness_damping || numerical_dissipation; }
};

/// Free motion of one node over one step: predictor, acceleration from the internal force and the damping,
/// velocity, displacement. Called for every owned node as soon as its internal force is complete.
template <BulkPhysics physics>
class FreeMotion {
 public:
  FreeMotion(const BulkArrays& arrays, const StepCoefficients& step, const Damping& damping, const Vector2& gravity,
             BulkSums& sums)
      : arrays_(arrays), step_(step), gravity_(gravity), lag_(damping.stiffness / step.time_step),
        mass_damping_(damping.mass), sums_(sums) {}

  void operator()(int i) const {
    for (int axis = 0; axis < 2; ++axis) {
      double& u = arrays_.displacement[i][axis];
      double& v = arrays_.velocity[i][axis];
      double& a = arrays_.acceleration[i][axis];
      const double internal = arrays_.force[i][axis];
      const double w = v + step_.predictor * a;
      double resistance = internal;
      if constexpr (physics.stiffness_damping) resistance += lag_ * (internal - arrays_.previous_force[i][axis]);
      if constexpr (physics.mass_damping) resistance += mass_damping_ / arrays_.inverse_mass[i] * w;
      const double new_a = gravity_[axis] - resistance * arrays_.inverse_mass[i];
      const double new_v = w + step_.velocity * new_a;
      if constexpr (physics.keeps_force()) {
        // u_n − u_{n−1} = Δt v_{n−1} + ½Δt² a_{n−1} holds for every β2.
        const double half = 0.5 * step_.time_step * step_.time_step;
        const double past = step_.time_step * v + half * a;
        const double next = step_.time_step * new_v + half * new_a;
        const double change = new_a - a;
        if constexpr (physics.numerical_dissipation) {
          sums_.increment_force += past * (internal - arrays_.previous_force[i][axis]);
          sums_.increment_inertia += change * change / arrays_.inverse_mass[i];
        }
        if constexpr (physics.stiffness_damping || physics.mass_damping) {
          sums_.damping_past += (internal - resistance) * past;
          sums_.damping_next += (internal - resistance) * next;
        }
      }
      u += step_.time_step * w + step_.displacement * new_a;
      v = new_v;
      a = new_a;
    }
  }

 private:
  const BulkArrays arrays_;
  const StepCoefficients step_;
  const Vector2 gravity_;
  const double lag_, mass_damping_;
  BulkSums& sums_;
};

}  // namespace slipscale
