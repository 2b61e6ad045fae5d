#pragma once

#include "slipscale/base/vector2.hpp"
#include "slipscale/dynamics/scheme.hpp"
#include "slipscale/solid/lanes.hpp"

namespace slipscale {

/// What owned nodes have lost so far where the bulk dissipates, along x and y, J/m; null where the physics
/// does not lose it. By node, so that no sum depends on the number of ranks.
struct BulkLosses {
  Vector2* damping = nullptr;  ///< to bulk damping; of the coming step already the part 1 − β2
  Vector2* coming = nullptr;   ///< that part; kept by steps that keep the acceleration
  Vector2* scheme = nullptr;   ///< to the time scheme, β2 > ½
};

/// How a step counts in them.
struct LossWeights {
  double past = 0;     ///< of the damping force's work along the step before, β2; 0 in the first step
  double next = 0;     ///< of its work along the coming step, 1 − β2
  double force = 0;    ///< of Δuᵀ K Δu of the step just closed, β2 − ½; 0 in the first step
  double inertia = 0;  ///< of Δaᵀ M Δa of that step, −(β2 − ½) β2 Δt²/2, s²; 0 in the first step
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
/// velocity, displacement; and the losses of the bulk. Called for every run of owned nodes as soon as their
/// internal force is complete.
template <BulkPhysics physics>
class FreeMotion {
 public:
  FreeMotion(const BulkArrays& arrays, const StepCoefficients& step, const Damping& damping,
             const Vector2& gravity, const BulkLosses& losses, const LossWeights& weights)
      : arrays_(arrays),
        step_(step),
        gravity_(load(gravity)),
        lag_(damping.stiffness / step.time_step),
        mass_damping_(damping.mass),
        losses_(losses),
        weights_(weights) {}

  void operator()(int begin, int end) const {
    // Local copies: the compiler cannot know that no store below changes the members.
    const BulkArrays arrays = arrays_;
    const StepCoefficients step = step_;
    const Lanes gravity = gravity_;
    const double lag = lag_, mass_damping = mass_damping_;
    // u_n − u_{n−1} = Δt w_n + (β2 − ½) Δt² a_{n−1}
    const double drift = step.displacement - step.time_step * step.time_step;
    const BulkLosses losses = losses_;
    const LossWeights weights = weights_;
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
          add(losses.scheme[i], weights.force * past * (internal - load(arrays.previous_force[i])) +
                                    weights.inertia / inverse_mass * change * change);
        }
        if constexpr (physics.stiffness_damping || physics.mass_damping) {
          const Lanes damper = resistance - internal;
          const Lanes next = weights.next * increment;
          add(losses.damping[i], damper * (weights.past * past + next));
          if constexpr (physics.keeps_acceleration) store(losses.coming[i], damper * next);
        }
      }
      store(arrays.displacement[i], load(arrays.displacement[i]) + increment);
      store(arrays.predictor[i], next_predictor(step, w, a));
      if constexpr (physics.keeps_acceleration) store(arrays.acceleration[i], a);
    }
  }

 private:
  const BulkArrays arrays_;
  const StepCoefficients step_;
  const Lanes gravity_;
  const double lag_, mass_damping_;
  const BulkLosses losses_;
  const LossWeights weights_;
};

}  // namespace slipscale
