#include "real_modes.hpp"

#include <slepceps.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <numbers>

#include "inner.hpp"
#include "slipscale/base/log.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

using OwnedEPS = Owned<EPS, EPSDestroy>;

constexpr double digits = 1e-7;  ///< of the eigenvalues: they are a start, which the search improves

/// SLEPc within PETSc's life.
class Slepc {
 public:
  Slepc() {
    PetscBool started = PETSC_FALSE;
    petsc(SlepcInitialized(&started));
    if (started == PETSC_FALSE) petsc(SlepcInitialize(nullptr, nullptr, nullptr, nullptr));
  }
};

/// M^½ K⁻¹ M^½ and where to stop.
struct Inverse {
  const SlidingOperator& body;
  Column root;                                               ///< M^½
  double least = 0;                                          ///< eigenvalues below are not wanted, s²
  double reached = std::numeric_limits<double>::infinity();  ///< the least so far, s²
};

PetscErrorCode multiply(Mat matrix, Vec x, Vec y) {
  PetscFunctionBeginUser;
  void* context = nullptr;
  PetscCall(MatShellGetContext(matrix, &context));
  const auto& inverse = *static_cast<const Inverse*>(context);
  const PetscScalar* from = nullptr;
  PetscScalar* to = nullptr;
  PetscCall(VecGetArrayRead(x, &from));
  PetscCall(VecGetArrayWrite(y, &to));
  const Eigen::Index n = inverse.root.size();
  try {
    const Column right = inverse.root.cwiseProduct(Eigen::Map<const Column>(from, n));
    Eigen::Map<Column>(to, n) = inverse.root.cwiseProduct(inverse.body.solve(right).col(0));
  } catch (const std::exception& error) {
    SETERRQ(PETSC_COMM_SELF, PETSC_ERR_LIB, "%s", error.what());
  }
  PetscCall(VecRestoreArrayWrite(y, &to));
  PetscCall(VecRestoreArrayRead(x, &from));
  PetscFunctionReturn(PetscErrorCode{});
}

/// Keeps the least eigenvalue that has converged: they come in order.
PetscErrorCode watch(EPS, PetscInt, PetscInt found, PetscScalar* value, PetscScalar*, PetscReal*, PetscInt,
                     void* context) {
  PetscFunctionBeginUser;
  if (found > 0) static_cast<Inverse*>(context)->reached = value[found - 1];
  PetscFunctionReturn(PetscErrorCode{});
}

/// Stops when that is one that is not wanted any more.
PetscErrorCode enough(EPS eps, PetscInt step, PetscInt most, PetscInt found, PetscInt wanted,
                      EPSConvergedReason* reason, void* context) {
  PetscFunctionBeginUser;
  PetscCall(EPSStoppingBasic(eps, step, most, found, wanted, reason, nullptr));
  const auto& inverse = *static_cast<const Inverse*>(context);
  if (*reason == EPS_CONVERGED_ITERATING && inverse.reached < inverse.least) *reason = EPS_CONVERGED_USER;
  PetscFunctionReturn(PetscErrorCode{});
}

/// As many as a plate of this area and its mean wave speeds has below ω, after H. Weyl, and some more: two
/// kinds of waves, each with A ω²/(4π c²) modes and an edge term. Too few are mended by a second run.
double expected_count(const Model& model, double highest) {
  const Mesh& mesh = model.mesh;
  double sum = 0;
  for (std::size_t r = 0; r < mesh.regions.size(); ++r) {
    const WaveSpeeds c = wave_speeds(model.materials[r], 0, 1);
    sum += mesh.regions[r].area * (1 / (c.fast * c.fast) + 1 / (c.slow * c.slow));
  }
  const double modes = sum * highest * highest / (4 * std::numbers::pi);
  return std::ceil(1.1 * modes + 2 * std::sqrt(modes)) + 10;
}

struct Found {
  PetscInt count = 0;
  bool complete = false;
};

/// Runs SLEPc for `wanted` modes.
Found run(const SlidingOperator& body, Inverse& inverse, PetscInt wanted, OwnedEPS& eps, OwnedMat& shell) {
  const auto rows = static_cast<PetscInt>(body.free().size());
  petsc(MatCreateShell(body.comm(), rows, rows, PETSC_DETERMINE, PETSC_DETERMINE, &inverse, shell.put()));
  petsc(MatShellSetOperation(shell, MATOP_MULT, reinterpret_cast<void (*)()>(multiply)));
  EPS* solver = eps.put();
  petsc(EPSCreate(body.comm(), solver));
  petsc(EPSSetOptionsPrefix(*solver, "modes_"));
  petsc(EPSSetOperators(*solver, shell, nullptr));
  petsc(EPSSetProblemType(*solver, EPS_HEP));
  petsc(EPSSetWhichEigenpairs(*solver, EPS_LARGEST_REAL));
  petsc(EPSSetTolerances(*solver, digits, 1000));
  petsc(EPSSetDimensions(*solver, wanted,
                         std::min<PetscInt>(body.free().total(), wanted + std::max<PetscInt>(40, wanted / 4)),
                         PETSC_DEFAULT));
  inverse.reached = std::numeric_limits<double>::infinity();
  petsc(EPSMonitorSet(*solver, watch, &inverse, nullptr));
  petsc(EPSSetStoppingTestFunction(*solver, enough, &inverse, nullptr));
  OwnedVec start;
  petsc(MatCreateVecs(shell, start.put(), nullptr));
  petsc(VecSet(start, 1));
  Vec starts[] = {start.get()};
  petsc(EPSSetInitialSpace(*solver, 1, starts));
  petsc(EPSSetFromOptions(*solver));
  petsc(EPSSolve(*solver));
  Found found;
  petsc(EPSGetConverged(*solver, &found.count));
  PetscScalar last = 0;
  if (found.count > 0) petsc(EPSGetEigenvalue(*solver, found.count - 1, &last, nullptr));
  found.complete = found.count >= body.free().total() || last < inverse.least;
  return found;
}

}  // namespace

RealModes real_modes(const SlidingOperator& body, double highest, int count) {
  static const LogEvent event("ModesReal");
  const LogEvent::Scope scope(event);
  static const Slepc slepc;
  const PetscInt total = body.free().total();
  if (count > total)
    throw UserError(format("-modes_basis is {}, but the body has only {} free components; give at most that",
                           count, total));
  const double expected = expected_count(body.model(), highest);
  constexpr double far_beyond = 10;
  if (count == 0 && expected > far_beyond * static_cast<double>(total))
    throw UserError(
        format("-modes_to asks for about {:.2g} modes, of a mesh with {} free components; give a frequency "
               "below {:.2g} Hz",
               expected, total,
               highest / (2 * std::numbers::pi) * std::sqrt(static_cast<double>(total) / expected)));
  Inverse inverse{body, body.free().mass().cwiseSqrt(), count > 0 ? 0 : 1 / (highest * highest),
                  std::numeric_limits<double>::infinity()};
  PetscInt wanted = count > 0 ? count : static_cast<PetscInt>(std::min<double>(total, expected));
  OwnedMat shell;
  OwnedEPS eps;
  Found found = run(body, inverse, wanted, eps, shell);
  while (count == 0 && !found.complete && wanted < total) {
    wanted = std::min(total, 2 * wanted);
    found = run(body, inverse, wanted, eps, shell);
  }
  const PetscInt take = count > 0 ? std::min<PetscInt>(found.count, count) : found.count;
  if (count > 0 && take < count)
    throw RunError(format("SLEPc found {} of the {} real modes of -modes_basis; give fewer", take, count));
  RealModes modes{Eigen::VectorXd(take), Columns(body.free().size(), take)};
  OwnedVec vector;
  petsc(MatCreateVecs(shell, vector.put(), nullptr));
  for (PetscInt k = 0; k < take; ++k) {
    PetscScalar value = 0;
    petsc(EPSGetEigenpair(eps, k, &value, nullptr, vector, nullptr));
    modes.eigenvalue[k] = 1 / value;
    const PetscScalar* array = nullptr;
    petsc(VecGetArrayRead(vector, &array));
    modes.shape.col(k) = Eigen::Map<const Column>(array, body.free().size()).cwiseQuotient(inverse.root);
    petsc(VecRestoreArrayRead(vector, &array));
  }
  return modes;
}

}  // namespace slipscale
