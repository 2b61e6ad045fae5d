#include "slipscale/base/factorisation.hpp"

#include <algorithm>
#include <string>
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
  // PETSc does not factorise again what has failed: it begins anew, and reads the options again.
  const char* prefix = nullptr;
  petsc(KSPGetOptionsPrefix(ksp, &prefix));
  const std::string option = std::string("-") + (prefix ? prefix : "") + "mat_mumps_icntl_14";
  petsc(PetscOptionsSetValue(nullptr, option.c_str(),
                             std::to_string(std::max(least_workspace, 2 * percent)).c_str()));
  petsc(KSPGetOperators(ksp, &matrix, nullptr));
  petsc(PetscObjectReference(reinterpret_cast<PetscObject>(matrix)));
  petsc(PCReset(pc));
  petsc(KSPSetOperators(ksp, matrix, matrix));
  petsc(MatDestroy(&matrix));  // the reference
  return true;
}

}  // namespace slipscale
