#pragma once

#include <vector>

#include "slipscale/base/state_group.hpp"
#include "slipscale/contact/contact_nodes.hpp"

namespace slipscale {

/// What has happened at each contact node since t = 0, over every step. What is found at t_n, status and
/// pressure, holds for the step from t_n to t_{n+1} and counts once that is over, so that at t_n all sums are
/// those of the time from 0 to t_n. One node at a time, in the order of the steps: the same bits on any
/// number of ranks.
class ContactSums {
 public:
  struct Sums {
    double slip = 0;           ///< ∫ |V − u̇_x| dt while closed, m; a node that sticks does not move
    double pressure_slip = 0;  ///< ∫ λ |V − u̇_x| dt, N: what Archard's law takes, times the tributary length
    double closed = 0;         ///< steps
    double force = 0;          ///< λ of all steps, N/m; times Δt the impulse
    double closures = 0;  ///< times that the node closed, the start in contact among them
  };

  void start(int nodes) { kept_ = true, done_.assign(nodes, {}), coming_.assign(nodes, {}); }
  bool kept() const { return kept_; }  ///< whether anybody asked, the same on all ranks
  int size() const { return static_cast<int>(done_.size()); }

  /// When the contact at t_n and u_{n+1} are known: `path` is the surface's over the coming step, m,
  /// `before` [slots] u_n and `after` u_{n+1} by local node, m.
  void add(const ContactNodes& contact, double path, const Vector2* before, const Vector2* after);

  const Sums& at(int k) const { return done_[k]; }  ///< at t_n

  /// For a checkpoint: adds its arrays to the group of the contact nodes.
  void add_state(StateGroup& contact_nodes);

 private:
  bool kept_ = false;
  std::vector<Sums> done_, coming_;  ///< by contact node; `coming_`: of the step that is not over
};

}  // namespace slipscale
