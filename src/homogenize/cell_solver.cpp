#include "cell_solver.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <source_location>

#include "slipscale/base/error.hpp"
#include "slipscale/base/factorisation.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

constexpr double tolerance = 1e-10;  ///< of the residual, relative
constexpr double loosest = 0.1;      ///< of the same, whatever the linear solver is content with
constexpr double rounding = 1e-13;   ///< of the residual, over the forces of a homogeneous cell
constexpr double rounding_unit = 64 * PETSC_MACHINE_EPSILON;  ///< likewise, over what cancels in it
constexpr PetscInt direct_below = 5000;  ///< unknowns: a factorisation is quicker than multigrid; and nearly
                                         ///< incompressible phases are none for multigrid
constexpr PetscInt most_iterations = 500;

using Clock = std::chrono::steady_clock;
double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

PetscErrorCode form_residual(SNES, Vec u, Vec out, void* system) {
  return static_cast<CellSystem*>(system)->residual(u, out);
}

PetscErrorCode form_jacobian(SNES, Vec, Mat, Mat matrix, void* system) {
  return static_cast<CellSystem*>(system)->jacobian(matrix);
}

/// SNES's own test; besides, content with what rounding leaves. A weak contrast leaves no more than that to
/// begin with, and a strong one under given stress never comes down to `tolerance`: the soft phase moves so
/// far that the stiff one's forces are rounded.
PetscErrorCode converged(SNES snes, PetscInt step, PetscReal, PetscReal, PetscReal residual,
                         SNESConvergedReason* reason, void* system) {
  PetscFunctionBeginUser;
  PetscCall(SNESConvergedDefault(snes, step, 0, 0, residual, reason, nullptr));
  if (*reason != SNES_CONVERGED_ITERATING) PetscFunctionReturn(PetscErrorCode{});
  PetscReal size = 0;
  PetscCall(static_cast<CellSystem*>(system)->cancelling_forces(&size));
  if (residual <= rounding_unit * size) *reason = SNES_CONVERGED_FNORM_ABS;
  PetscFunctionReturn(PetscErrorCode{});
}

bool given(const char* option) {
  PetscBool found = PETSC_FALSE;
  petsc(PetscOptionsHasName(nullptr, "cell_", option, &found));
  return found == PETSC_TRUE;
}

bool is(PetscObject object, const char* type) {
  PetscBool found = PETSC_FALSE;
  petsc(PetscObjectTypeCompare(object, type, &found));
  return found == PETSC_TRUE;
}

/// A choice that PETSc does not take is the user's mistake, and found on all ranks alike.
void accept(PetscErrorCode code, std::source_location where = std::source_location::current()) {
  static constexpr std::array choices{PETSC_ERR_ARG_OUTOFRANGE,   PETSC_ERR_ARG_WRONG,
                                      PETSC_ERR_ARG_UNKNOWN_TYPE, PETSC_ERR_USER,
                                      PETSC_ERR_MISSING_FACTOR,   PETSC_ERR_SUP};
  if (std::ranges::find(choices, code) == choices.end()) return petsc(code, where);
  std::string said = take_petsc_message();
  said = said.substr(0, said.rfind(" ["));  // where in PETSc
  said.erase(said.find_last_not_of(" .") + 1);
  throw UserError("PETSc takes no such choice among the options -cell_snes_, -cell_ksp_ and -cell_pc_ (" +
                  said + "); give another value, or leave it out");
}

}  // namespace

CellSolver::CellSolver(MPI_Comm comm, CellSystem& system, double force) : system_(system), force_(force) {
  const auto start = Clock::now();
  matrix_ = system.matrix();
  u_ = system.vector();
  residual_ = system.vector();
  petsc(MatSetNearNullSpace(matrix_, system.rigid_motions()));
  petsc(SNESCreate(comm, snes_.put()));
  petsc(SNESSetOptionsPrefix(snes_, "cell_"));
  petsc(SNESSetFunction(snes_, residual_, form_residual, &system));
  petsc(SNESSetJacobian(snes_, matrix_, matrix_, form_jacobian, &system));
  petsc(SNESSetConvergenceTest(snes_, converged, &system, nullptr));
  petsc(SNESSetTolerances(snes_, rounding * force_, 2 * tolerance, 0, 10, PETSC_DEFAULT));
  SNESLineSearch search = nullptr;
  petsc(SNESGetLineSearch(snes_, &search));
  petsc(SNESLineSearchSetType(search, SNESLINESEARCHBASIC));
  choose_solver();
  accept(SNESSetFromOptions(snes_));
  complete_choice();
  // The problem is linear: one Jacobian and one preconditioner serve all load cases.
  petsc(SNESSetLagJacobian(snes_, -2));
  petsc(SNESSetLagJacobianPersists(snes_, PETSC_TRUE));
  petsc(SNESSetLagPreconditioner(snes_, -2));
  petsc(SNESSetLagPreconditionerPersists(snes_, PETSC_TRUE));
  set_up();
  seconds_ = since(start);
}

void CellSolver::set_up() {
  KSP ksp = nullptr;
  PC pc = nullptr;
  PCFailedReason reason = PC_NOERROR;
  petsc(SNESSetUp(snes_));
  petsc(SNESGetKSP(snes_, &ksp));
  petsc(SNESComputeJacobian(snes_, u_, matrix_, matrix_));
  petsc(KSPSetOperators(ksp, matrix_, matrix_));
  do accept(KSPSetUp(ksp));
  while (enlarge_workspace(ksp));
  petsc(KSPGetPC(ksp, &pc));
  petsc(PCGetFailedReason(pc, &reason));
  if (reason != PC_NOERROR && is_direct()) refuse_factorisation();
}

CaseCost CellSolver::solve(int load_case) {
  const auto start = Clock::now();
  petsc(VecSet(u_, 0));
  petsc(SNESSolve(snes_, nullptr, u_));
  CaseCost cost;
  SNESConvergedReason reason;
  petsc(SNESGetConvergedReason(snes_, &reason));
  petsc(SNESGetIterationNumber(snes_, &cost.newton_steps));
  petsc(SNESGetLinearSolveIterations(snes_, &cost.iterations));
  cost.converged = SNESConvergedReasons[reason];
  if (reason < 0) refuse(load_case, cost, reason);
  system_.load(u_);
  cost.seconds = since(start);
  return cost;
}

std::string CellSolver::description() const {
  KSP ksp = nullptr;
  PC pc = nullptr;
  KSPType solver = nullptr;
  PCType preconditioner = nullptr;
  petsc(SNESGetKSP(snes_, &ksp));
  petsc(KSPGetPC(ksp, &pc));
  petsc(KSPGetType(ksp, &solver));
  petsc(PCGetType(pc, &preconditioner));
  return std::string(solver) + " + " + preconditioner;
}

void CellSolver::choose_solver() {
  KSP ksp = nullptr;
  PC pc = nullptr;
  PetscInt unknowns = 0;
  petsc(VecGetSize(u_, &unknowns));
  petsc(SNESGetKSP(snes_, &ksp));
  petsc(KSPGetPC(ksp, &pc));
  petsc(KSPSetTolerances(ksp, tolerance, rounding * force_, PETSC_DEFAULT, most_iterations));
  if (unknowns < direct_below || system_.is_nearly_incompressible()) {
    petsc(KSPSetType(ksp, KSPPREONLY));
    petsc(PCSetType(pc, PCCHOLESKY));
    petsc(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
    return;
  }
  petsc(KSPSetType(ksp, KSPCG));
  petsc(PCSetType(pc, PCGAMG));
}

void CellSolver::complete_choice() {
  KSP ksp = nullptr;
  PC pc = nullptr;
  petsc(SNESGetKSP(snes_, &ksp));
  petsc(KSPGetPC(ksp, &pc));
  // The norm that SNES looks at.
  if (is(reinterpret_cast<PetscObject>(ksp), KSPCG) && !given("-ksp_norm_type"))
    petsc(KSPSetNormType(ksp, KSP_NORM_UNPRECONDITIONED));
  PetscReal linear = 0;
  petsc(KSPGetTolerances(ksp, &linear, nullptr, nullptr, nullptr));
  if (!given("-snes_rtol"))
    petsc(SNESSetTolerances(snes_, PETSC_DEFAULT, std::min(2 * linear, loosest), PETSC_DEFAULT, PETSC_DEFAULT,
                            PETSC_DEFAULT));
  if (is(reinterpret_cast<PetscObject>(pc), PCCHOLESKY) && !given("-pc_factor_mat_solver_type"))
    petsc(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  if (is(reinterpret_cast<PetscObject>(pc), PCGAMG) && !given("-pc_gamg_threshold")) {
    // Weak couplings are left out of the aggregates: without this a contrast of 1e4 takes five times the
    // iterations.
    PetscReal threshold = 0.05;
    petsc(PCGAMGSetThreshold(pc, &threshold, 1));
  }
}

bool CellSolver::is_direct() const {
  KSP ksp = nullptr;
  petsc(SNESGetKSP(snes_, &ksp));
  return is(reinterpret_cast<PetscObject>(ksp), KSPPREONLY);
}

std::vector<std::string> CellSolver::idle_options() const {
  std::vector<std::string> idle;
  if (!is_direct()) return idle;
  for (const char* option : {"-ksp_rtol", "-ksp_atol", "-ksp_divtol", "-ksp_max_it", "-ksp_norm_type",
                             "-ksp_monitor", "-ksp_monitor_true_residual", "-ksp_converged_reason"})
    if (given(option)) idle.push_back(std::string("-cell_") + (option + 1));
  return idle;
}

void CellSolver::refuse_factorisation() const {
  throw UserError(
      "the stiffness of the cell cannot be factorised (PETSc and MUMPS: singular, or out of memory); look "
      "for "
      "parts that hang by one node or phases of next to no stiffness, take more memory or ranks, or try "
      "-cell_ksp_type cg -cell_pc_type gamg");
}

void CellSolver::refuse(int load_case, const CaseCost& cost, SNESConvergedReason reason) const {
  static constexpr const char* cases[] = {"xx", "yy", "xy"};
  std::string why = "SNES " + cost.converged, cure;
  const bool direct = is_direct();
  if (reason == SNES_DIVERGED_LINEAR_SOLVE) {
    KSP ksp = nullptr;
    KSPConvergedReason linear;
    petsc(SNESGetKSP(snes_, &ksp));
    petsc(KSPGetConvergedReason(ksp, &linear));
    why += format(", KSP {} after {} iterations", KSPConvergedReasons[linear],
                  static_cast<int>(cost.iterations));
    cure = direct ? "the factorisation has failed: try -cell_ksp_type cg -cell_pc_type gamg"
                  : "try -cell_pc_type cholesky -cell_ksp_type preonly, or allow more with -cell_ksp_max_it";
  } else {
    why += format(" after {} Newton steps", static_cast<int>(cost.newton_steps));
    cure = "one step is enough where the linear solver does its work: leave the options -cell_snes_ out";
    cure += direct
                ? ", or be content with a larger residual (-cell_snes_rtol 1e-6)"
                : " and see -cell_ksp_converged_reason, or try -cell_pc_type cholesky -cell_ksp_type preonly";
  }
  throw UserError(
      format("the cell problem under unit load {} did not converge ({}); {}", cases[load_case], why, cure));
}

}  // namespace slipscale
