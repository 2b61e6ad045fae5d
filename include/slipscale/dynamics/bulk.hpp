#pragma once

#include "slipscale/base/vector2.hpp"
#include "slipscale/dynamics/scheme.hpp"
#include "slipscale/solid/instructions.hpp"
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

/// What moves the nodes over one step.
struct FreeMotionState {
  BulkArrays arrays;
  StepCoefficients step;
  Lanes gravity;
  double lag;           ///< stiffness damping over the step
  double mass_damping;  ///< 1/s
  // As `BulkSums`, along x and along y; each taken node after node, so that it does not depend on how many
  // nodes are moved at a time.
  Lanes increment_force{}, increment_inertia{}, damping_past{}, damping_next{};
};

/// Free motion of nodes over one step: predictor, acceleration from the internal force and the damping,
/// velocity, displacement. Called for every run of owned nodes as soon as their internal force is complete;
/// several nodes are moved at a time, to the same bits.
class FreeMotion {
 public:
  FreeMotion(const BulkPhysics& physics, Instructions instructions, const BulkArrays& arrays,
             const StepCoefficients& step, const Damping& damping, const Vector2& gravity)
      : move_(moving(physics, instructions)),
        state_{arrays, step, load(gravity), damping.stiffness / step.time_step, damping.mass} {}

  void operator()(int begin, int end) { move_(state_, begin, end); }
  BulkSums sums() const {
    const auto both = [](const Lanes& lanes) { return lanes[0] + lanes[1]; };
    return {both(state_.increment_force), both(state_.increment_inertia), both(state_.damping_past),
            both(state_.damping_next)};
  }

 private:
  using Move = void (*)(FreeMotionState&, int begin, int end);
  static Move moving(const BulkPhysics& physics, Instructions instructions);

  Move move_;
  FreeMotionState state_;
};

}  // namespace slipscale
