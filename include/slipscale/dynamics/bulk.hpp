#pragma once

#include "slipscale/base/vector2.hpp"
#include "slipscale/dynamics/scheme.hpp"
#include "slipscale/solid/instructions.hpp"
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
  const double* inverse_mass;        ///< m/kg
  const Vector2* previous_force;     ///< K u_{n−1}, N/m; read only where the physics needs it
  Vector2* displacement;             ///< u, m
  Vector2* predictor;                ///< w, m/s
  Vector2* acceleration;             ///< a, m/s²; touched only where the physics keeps it
  const Vector2* gravity = nullptr;  ///< m/s²; read only where it varies from node to node
};

/// The bulk physics that a scene can have; a scene without it does not pay for it.
struct BulkPhysics {
  bool mass_damping = false, stiffness_damping = false, numerical_dissipation = false;
  bool keeps_acceleration =
      false;  ///< for an observed step, for the ledger when β2 > ½, for a law that asks the slip rate
  bool graded_gravity = false;  ///< the body acceleration varies from node to node
  constexpr bool keeps_force() const { return mass_damping || stiffness_damping || numerical_dissipation; }
};

/// What moves the nodes over one step.
struct FreeMotionState {
  BulkArrays arrays;
  StepCoefficients step;
  Lanes gravity;
  double lag;           ///< stiffness damping over the step
  double mass_damping;  ///< 1/s
  BulkLosses losses;
  LossWeights weights;
};

/// Free motion of nodes over one step: predictor, acceleration from the internal force and the damping,
/// velocity, displacement; and the losses of the bulk. Called for every run of owned nodes as soon as their
/// internal force, K u_n in N/m by local node, is complete; several nodes are moved at a time, to the same
/// bits.
class FreeMotion {
 public:
  FreeMotion(const BulkPhysics& physics, Instructions instructions, const BulkArrays& arrays,
             const StepCoefficients& step, const Damping& damping, const Vector2& gravity,
             const BulkLosses& losses, const LossWeights& weights)
      : move_(moving(physics, instructions)), state_{arrays,        step,
                                                     load(gravity), damping.stiffness / step.time_step,
                                                     damping.mass,  losses,
                                                     weights} {}

  void operator()(int begin, int end, const Vector2* force) const { move_(state_, begin, end, force); }

  /// Asks for what the motion of these nodes needs and nothing before it touches.
  void prepare(int begin, int end) const {
    constexpr int nodes_of_a_line = 4;
    for (int i = begin; i < end; i += nodes_of_a_line) {
      __builtin_prefetch(state_.arrays.predictor + i, 1);
      if (i % (2 * nodes_of_a_line) == 0) __builtin_prefetch(state_.arrays.inverse_mass + i);
    }
  }

 private:
  using Move = void (*)(const FreeMotionState&, int begin, int end, const Vector2* force);
  static Move moving(const BulkPhysics& physics, Instructions instructions);

  const Move move_;
  const FreeMotionState state_;
};

/// What is seen of nodes once they have moved, [nodes] from the first of them on.
struct SeenNodes {
  const Vector2 *predictor, *acceleration;  ///< w_{n+1}, m/s; a_n, m/s²
  const Vector2 *displacement, *force;      ///< u_n, m; K u_n, N/m
  const double* mass;                       ///< kg/m
  Vector2* velocity;                        ///< v_n, m/s: made
  double *kinetic, *correction, *strain;  ///< ½vᵀMv, (Δt²β2/4) aᵀMa, ½uᵀKu of each node, J/m: made
};

/// `back`: v_n = w_{n+1} − back a_n, s; `weight`: Δt²β2/4, s².
void see(const SeenNodes& nodes, int count, double back, double weight, Instructions instructions);

}  // namespace slipscale
