#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "slipscale/dynamics/sliding_body.hpp"
#include "slipscale/files/interfaces_file.hpp"
#include "slipscale/mesh/ordered_gather.hpp"
#include "slipscale/solid/interface_forces.hpp"

namespace slipscale {

/// Tractions along the interfaces of inclusions while a body slides. The nodal force is all that the
/// inclusion's cells need to move as they do: with their row-sum mass m, stiffness K, bulk damping a, b and
/// acceleration g
///     F_i = m (a_n + a w_n − g) + K u_n + (b/Δt) K (u_n − u_{n−1}),
/// so that the viscous stress is part of the traction, and the forces on an inclusion add up to m (a_n + a
/// w_n − g) over all of its nodes. Where the step before was not kept, the viscous part is left out: at t =
/// 0, and in a row that follows a restart at once which none was to follow before.
class InterfaceRecord {
 public:
  /// Throws UserError where the region is not there, alone, or has no interface. Collective.
  InterfaceRecord(const SlidingBody& body, const InterfaceChoice& choice);

  /// Whether the step before a row has to be observed, too.
  bool needs_step_before() const { return past_ != nullptr; }
  /// After an observed step whose next one makes a row, where that is needed.
  void keep_past();
  /// What is odd about the inclusions; a sentence, or nothing.
  std::string doubt() const { return doubt_about(choice_.region, found_.inclusions); }
  /// Forces at all interface nodes of an observed step; on rank 0. Collective.
  std::vector<Vector2> forces() const;
  const Inclusions& inclusions() const { return found_.inclusions; }
  /// "interfaces of 26 inclusions of region 'inclusion', 1352 nodes", for the terminal.
  std::string describe() const;

  /// For a checkpoint; `resume` after the arrays were filled in. Nothing where no step before is needed.
  std::vector<StateGroup> state();
  void resume();

 private:
  const SlidingBody& body_;
  const InterfaceChoice choice_;
  const RegionInclusions found_;
  const InterfaceForces at_nodes_;
  OrderedGather gather_;
  std::unique_ptr<NodalVector> past_;      ///< u_{n−1}, m; null without stiffness damping
  double kept_ = 0;                        ///< steps made when that was kept; 0: none was
  mutable std::vector<Vector2> strained_;  ///< u_n + (b/Δt)(u_n − u_{n−1}), m, by local node
};

}  // namespace slipscale
