#pragma once

#include <string>
#include <vector>

#include "cell_system.hpp"

namespace slipscale {

/// SNES and KSP for the load cases of one cell, under the options prefix `cell_`: set up once.
class CellSolver {
 public:
  /// `force` is the size of the forces that act, N/m: a homogeneous cell leaves nothing but its rounding.
  /// Throws UserError when PETSc does not take the user's choice of solver. Collective, as `solve`.
  CellSolver(MPI_Comm comm, CellSystem& system, double force);

  /// Solves the system as it is now loaded, and loads it with the solution. Throws UserError with the reason
  /// and what to try when that does not converge.
  CaseCost solve(int load_case);

  double set_up_seconds() const { return seconds_; }
  /// Options of the user's that an iterative solver would read, and a factorisation does not.
  std::vector<std::string> idle_options() const;
  std::string description() const;  ///< "cg + gamg", say

 private:
  /// Conjugate gradients with algebraic multigrid, or a factorisation of small cells.
  void choose_solver();
  /// What follows from the user's choice, where he says nothing else: conjugate gradients stop by the norm
  /// that SNES looks at, and SNES is content with what they reach, so that one Newton step will do; Cholesky
  /// is that of MUMPS.
  void complete_choice();
  void set_up();
  bool is_direct() const;
  [[noreturn]] void refuse_factorisation() const;
  [[noreturn]] void refuse(int load_case, const CaseCost& cost, SNESConvergedReason reason) const;

  CellSystem& system_;
  const double force_;
  OwnedMat matrix_;
  OwnedVec u_, residual_;
  OwnedSNES snes_;
  double seconds_ = 0;
};

}  // namespace slipscale
