#pragma once

#include <array>
#include <string>
#include <vector>

#include "slipscale/dynamics/sliding_body.hpp"

namespace slipscale {

/// The tangential force at one boundary on every step of the last part of a run, up to 2^17 steps: what tells
/// whether the rows of history.h5 were too sparse. Each rank sums over its own nodes and keeps the sum, so a
/// step costs no reduction; the ranks' sums are added when the run is over. They are kept with twice the
/// digits of a double, of which the last does not show where the mesh was cut.
class ForceRecord {
 public:
  /// `boundary`: index into SlidingBody::boundary_names; −1 records nothing.
  ForceRecord(const SlidingBody& body, int boundary, long last_step);

  /// After the step t_n → t_{n+1} was made.
  void add(long n) {
    if (n >= first_) record(n);
  }

  /// For a checkpoint after step n: the sums so far of all ranks, on rank 0; `resume` after they were filled
  /// in. Collective.
  StateGroup state(long n);
  void resume();

  /// On rank 0 the force of the body along the boundary, N/m, one a step; empty elsewhere. Collective.
  std::vector<double> gather() const;

 private:
  void record(long n);

  const SlidingBody& body_;
  std::vector<int> slots_;
  Vector2 tangent_{};
  long first_;
  using Sum =
      std::array<double, 2>;  ///< the sum is that of both, the second below the last digit of the first
  static void add_term(Sum& sum, double term);
  static void add_sums(void* from, void* to, int* count, MPI_Datatype*);

  std::vector<Sum> sums_;
  std::vector<double> carried_;
};

}  // namespace slipscale
