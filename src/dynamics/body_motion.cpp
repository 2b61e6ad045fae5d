// The free motion of all nodes, while their forces are gathered.
#include <algorithm>

#include "slipscale/dynamics/sliding_body.hpp"

namespace slipscale {
namespace {

BulkPhysics keeping_acceleration(BulkPhysics physics) {
  physics.keeps_acceleration = true;
  return physics;
}

/// Moves nodes whose forces are all there, and does something before and after while they are in the cache.
template <class Before, class After>
struct MoveFrom {
  const FreeMotion& move;
  const Vector2* force;
  Before before;
  After after;

  void prepare(int begin, int end) const { move.prepare(begin, end); }
  void operator()(int begin, int end) const {
    before(begin, end);
    move(begin, end, force);
    after(begin, end);
  }
};

/// Moves nodes by forces in passing, and keeps those of some nodes.
struct MovePassing {
  const FreeMotion& move;
  const std::vector<int>& keeps;  ///< ascending
  Vector2* kept;                  ///< by local node
  std::size_t next = 0;

  void prepare(int begin, int end) const { move.prepare(begin, end); }
  void operator()(int begin, int end, const Vector2* force) {
    for (; next < keeps.size() && keeps[next] < end; ++next) kept[keeps[next]] = force[keeps[next]];
    move(begin, end, force);
  }
};

}  // namespace

/// The force on a node inside the body is of use to its motion alone, except where the bulk dissipates, and
/// in observed steps.
void SlidingBody::free_motion(const StepCoefficients& step, Observed observed) {
  const bool everything = observed == Observed::everything;
  const BulkPhysics physics = everything ? keeping_acceleration(physics_) : physics_;
  const BulkArrays arrays{inverse_mass_.data(),      previous_force_.data(), u_.data(), w_.data(), a_.data(),
                          body_acceleration_.field()};
  const FreeMotion move(physics, model_.kernel.instructions, arrays, step, scene_.damping,
                        body_acceleration_.uniform(), ledger_.bulk_losses(), ledger_.weights(step_ == 0));
  const auto multiply = [&](const auto& moves) {
    std::visit([&](const auto& stiffness) { stiffness.multiply(u_.data(), force_.data(), moves); },
               model_.stiffness);
  };
  const auto nothing = [](int, int) {};
  if (everything) {
    const std::size_t owned = model_.mass.size();
    std::copy(u_.data() + owned, u_.data() + kept_.size(), kept_.data() + owned);
    const auto keep = [&](int begin, int end) {
      std::copy(u_.data() + begin, u_.data() + end, kept_.data() + begin);
    };
    const auto observe = [&](int begin, int end) { observe_nodes(step, begin, end); };
    multiply(MoveFrom{move, force_.data(), keep, observe});
  } else if (passing_.empty()) {
    multiply(MoveFrom{move, force_.data(), nothing, nothing});
  } else {
    MovePassing moves{move, boundary_.node, force_.data()};
    std::visit([&](const auto& stiffness) { stiffness.multiply_passing(u_.data(), passing_, moves); },
               model_.stiffness);
  }
  if (observed == Observed::boundary && !physics.keeps_acceleration) free_acceleration_at_boundary();
}

/// As the free motion makes it, to the same bits.
void SlidingBody::free_acceleration_at_boundary() {
  const double lag = scene_.damping.stiffness / time_step_;
  for (int k = 0; k < boundary_.size(); ++k) {
    const int i = boundary_.node[k];
    for (int axis = 0; axis < 2; ++axis) {
      const double internal = force_[i][axis];
      double resistance = internal;
      if (physics_.stiffness_damping) resistance += lag * (internal - boundary_.internal[k][axis]);
      if (physics_.mass_damping)
        resistance += scene_.damping.mass / inverse_mass_[i] * boundary_.predictor[k][axis];
      a_.data()[i][axis] = body_acceleration_.at(i)[axis] - resistance * inverse_mass_[i];
    }
  }
}

}  // namespace slipscale
