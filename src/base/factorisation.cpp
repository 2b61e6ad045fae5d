#include "slipscale/base/factorisation.hpp"

#include <algorithm>
#include <string_view>

#include "slipscale/base/error.hpp"

namespace slipscale {
namespace {

constexpr PetscInt least_workspace = 40, most_workspace = 2000;  ///< per cent beyond what was foreseen

}  // namespace

bool enlarge_workspace(KSP ksp) {
  PC pc = nullptr;
  PCFailedReason reason = PC_NOERROR;
  petsc(KSPGetPC(ksp, &pc));
  petsc(PCGetFailedReason(pc, &reason));
  if (reason == PC_NOERROR) return false;
  Mat factor = nullptr, matrix = nullptr;
  MatSolverType package = nullptr;
  petsc(PCFactorGetMatrix(pc, &factor));
  petsc(MatFactorGetSolverType(factor, &package));
  if (!package || std::string_view(package) != MATSOLVERMUMPS) return false;
  PetscInt percent = 0, info = 0;
  petsc(MatMumpsGetInfog(factor, 1, &info));
  petsc(MatMumpsGetIcntl(factor, 14, &percent));
  if ((info != -8 && info != -9) || percent >= most_workspace) return false;
  petsc(MatMumpsSetIcntl(factor, 14, std::max(least_workspace, 2 * percent)));
  petsc(MatFactorClearError(factor));
  petsc(KSPGetOperators(ksp, &matrix, nullptr));
  // PETSc factorises again when the matrix has changed, and counts this as a change; not a bit differs after.
  petsc(MatScale(matrix, 2));
  petsc(MatScale(matrix, 0.5));
  return true;
}

}  // namespace slipscale
