#pragma once

#include <type_traits>
#include <vector>

#include "slipscale/base/vector2.hpp"
#include "slipscale/contact/friction.hpp"
#include "slipscale/contact/nodal_step.hpp"

namespace slipscale {

/// What contact needs to know of the step from t_n to t_{n+1}.
struct ContactStep {
  StepCoefficients motion;
  double surface_travel = 0;  ///< path of the surface over the step, m
  double surface_speed = 0;   ///< V at t_n, m/s
};

template <class Law>
const Law& at_node(const Law& law, int) {
  return law;
}
template <class Law>
const Law& at_node(const std::vector<Law>& laws, int k) {
  return laws[k];
}

/// The owned nodes of this rank that can touch the rigid surface, in compact arrays, ascending node number.
///
/// Forward-increment Lagrange multipliers (Carpenter, Taylor, Katona, Int. J. Numer. Meth. Engng 32 (1991)
/// 103), as in the paper (see contact/friction.hpp): the multiplier at t_n enforces the constraint at
/// t_{n+1}. With lumped mass and a rigid plane the nodes do not see one another.
class ContactNodes {
 public:
  /// `slot` is where a node stands in the arrays `before` and `support` below; `held`: its x is prescribed.
  void add(int node, int slot, double mass, double tributary_length, double clearance, bool held);
  void start_memory(double traction, double pressure);  ///< at t = 0: a body that already slides, Pa
  /// The surface has moved up or down: what is left at the end of the coming step between it and a node
  /// where it was undeformed, m.
  void lift(int k, double next_clearance) {
    past_rise[k] = rise[k];
    rise[k] = clearance[k] - next_clearance;
    clearance[k] = next_clearance;
  }
  /// The same at t_n.
  double clearance_now(int k) const { return rise[k] == 0 ? clearance[k] : clearance[k] + rise[k]; }

  /// `law` is one for all nodes or a std::vector of them, [nodes].
  /// Signorini and friction at every node: 0 ≤ λ ⟂ gap_{n+1} ≥ 0, then the law. `before` [slots] is u_n.
  /// Adds the contact force to acceleration, predictor and displacement; a law that asks the slip rate needs
  /// the first. At a held node the motion along x stays and friction is taken from the reaction `support`
  /// [slots] of what holds it.
  template <class Law>
  void enforce(const Law& law, const ContactStep& step, const Vector2* before, Vector2* support,
               NodalState state);

  int size() const { return static_cast<int>(node.size()); }

  std::vector<int> node, slot;
  std::vector<double> mass, normal_mass;  ///< that resist a push along x and along y over the step, kg/m
  std::vector<double> tributary_length;   ///< A, m
  std::vector<double> clearance;          ///< height of the undeformed node above the surface at t_{n+1}, m
  std::vector<double> rise, past_rise;    ///< of the surface from t_n to t_{n+1} and to t_n; m
  std::vector<char> held;
  std::vector<FrictionMemory> memory;
  // At t_n, from the last `enforce`:
  std::vector<Vector2> force;    ///< (τA, λ), N/m
  std::vector<double> traction;  ///< τ on the body along +x, Pa
  std::vector<double> pressure;  ///< p = λ/A ≥ 0, Pa
  std::vector<ContactStatus> status;
  bool touched = false;  ///< whether any of them was closed at any step so far
};

template <class Law>
void ContactNodes::enforce(const Law& law, const ContactStep& step, const Vector2* before, Vector2* support,
                           NodalState state) {
  const double reach = step.motion.displacement;  // of unit acceleration over the step, s²
  for (int k = 0; k < size(); ++k) {
    const int i = node[k];
    const double m = mass[k], length = tributary_length[k];
    const Vector2& u = state.displacement[i];
    const double gap = clearance[k] + u[1];
    if (gap >= 0) {
      force[k] = {0, 0};
      traction[k] = pressure[k] = 0;
      status[k] = ContactStatus::open;
      memory[k] = {};
      continue;
    }
    touched = true;
    const double normal_m = normal_mass[k], normal = -gap * normal_m / reach;
    const double missing = before[slot[k]][0] + step.surface_travel - u[0];
    FrictionDemand demand{missing * m / (reach * length), normal / length, 0};
    if constexpr (std::remove_cvref_t<decltype(at_node(law, k))>::uses_slip_rate)
      demand.slip_rate =
          step.surface_speed - (state.predictor[i][0] - step.motion.predictor * state.acceleration[i][0]);
    // A held node that does not slip leaves its share undetermined: the surface carries what friction can.
    if (held[k] && missing == 0) demand.trial = support[slot[k]][0] / length;
    const Friction friction = at_node(law, k)(demand, memory[k]);
    force[k] = {friction.traction * length, normal};
    traction[k] = friction.traction;
    pressure[k] = demand.pressure;
    status[k] = friction.status;

    Vector2 push{force[k][0] / m, normal / normal_m};
    if (held[k]) {
      support[slot[k]][0] -= force[k][0];
      push[0] = 0;
    }
    for (int axis = 0; axis < 2; ++axis) accelerate(state, step.motion, i, axis, push[axis]);
  }
}

}  // namespace slipscale
