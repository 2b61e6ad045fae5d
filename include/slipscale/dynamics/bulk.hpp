#pragma once

#include "slipscale/base/vector2.hpp"
#include "slipscale/dynamics/scheme.hpp"
#include "slipscale/solid/lanes.hpp"

namespace slipscale {

/// Sums over the owned nodes that the energy ledger needs when the bulk dissipates.
struct BulkSums {
  double increment_force = 0;    ///< Δuᵀ K Δu of the step just closed, J/m
  double increment_inertia = 0;  ///< Δaᵀ M Δa of the step just closed, N²/kg/m
  double damping_past = 0;       ///< damping force at t_n times u_n − u_{n−1}, J/m
  double damping_next = 0;       ///< damping force at t_n times u_{n+1} − u_n, J/m
};

/// What the free motion of a node needs; arrays by local node.
struct BulkArrays {
  const double* inverse_mass;     ///< m/kg
  const Vector2* force;           ///< K u_n, N/m
  const Vector2* previous_force;  ///< K u_{n−1}, N/m; read only where the physics needs it
  Vector2* displacement;          ///< u, m
  Vector2* predictor;             ///< w, m/s
  Vector2* acceleration;          ///< a, m/s²; touched only where the physics keeps it
};

/// The bulk physics that a scene can have; a scene without it does not pay for it.
struct BulkPhysics {
  bool mass_damping = false, stiffness_damping = false, numerical_dissipation = false;
  bool keeps_acceleration =
      false;  ///< for an observed step, for the ledger when β2 > ½, for a law that asks the slip rate
  constexpr bool keeps_force() const { return mass_damping || stiffness_damping || numerical_dissipation; }
};

/// Free motion of nodes over one step: predictor, acceleration from the internal force and the damping,
/// velocity, displacement. Called for every run of owned nodes as soon as their internal force is complete.
template <BulkPhysics physics>
class FreeMotion {
 public:
  FreeMotion(const BulkArrays& arrays, const StepCoefficients& step, const Damping& damping,
             const Vector2& gravity, BulkSums& sums)
      : arrays_(arrays),
        step_(step),
        gravity_(load(gravity)),
        lag_(damping.stiffness / step.time_step),
        mass_damping_(damping.mass),
        sums_(sums) {}

  void operator()(int begin, int end) const {
    // Local copies: the compiler cannot know that no store below changes the members.
    const BulkArrays arrays = arrays_;
    const StepCoefficients step = step_;
    const Lanes gravity = gravity_;
    const double lag = lag_, mass_damping = mass_damping_;
    // u_n − u_{n−1} = Δt w_n + (β2 − ½) Δt² a_{n−1}
    const double drift = step.displacement - step.time_step * step.time_step;
    Lanes increment_force{}, increment_inertia{}, damping_past{}, damping_next{};
    for (int i = begin; i < end; ++i) {
      const Lanes w = load(arrays.predictor[i]), internal = load(arrays.force[i]);
      const double inverse_mass = arrays.inverse_mass[i];
      Lanes resistance = internal;
      if constexpr (physics.stiffness_damping)
        resistance += lag * (internal - load(arrays.previous_force[i]));
      if constexpr (physics.mass_damping) resistance += mass_damping / inverse_mass * w;
      const Lanes a = gravity - resistance * inverse_mass;
      const Lanes increment = displacement_increment(step, w, a);
      if constexpr (physics.keeps_force()) {
        Lanes past = step.time_step * w;
        if constexpr (physics.numerical_dissipation) {
          const Lanes old_a = load(arrays.acceleration[i]), change = a - old_a;
          past += drift * old_a;
          increment_force += past * (internal - load(arrays.previous_force[i]));
          increment_inertia += change * change / inverse_mass;
        }
        if constexpr (physics.stiffness_damping || physics.mass_damping) {
          damping_past += (internal - resistance) * past;
          damping_next += (internal - resistance) * increment;
        }
      }
      store(arrays.displacement[i], load(arrays.displacement[i]) + increment);
      store(arrays.predictor[i], next_predictor(step, w, a));
      if constexpr (physics.keeps_acceleration) store(arrays.acceleration[i], a);
    }
    if constexpr (physics.keeps_force()) {
      sums_.increment_force += increment_force[0] + increment_force[1];
      sums_.increment_inertia += increment_inertia[0] + increment_inertia[1];
      sums_.damping_past += damping_past[0] + damping_past[1];
      sums_.damping_next += damping_next[0] + damping_next[1];
    }
  }

 private:
  const BulkArrays arrays_;
  const StepCoefficients step_;
  const Lanes gravity_;
  const double lag_, mass_damping_;
  BulkSums& sums_;
};

}  // namespace slipscale
