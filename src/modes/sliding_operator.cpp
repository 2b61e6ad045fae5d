#include "slipscale/modes/sliding_operator.hpp"

#include "assembled_stiffness.hpp"
#include "slipscale/base/factorisation.hpp"
#include "slipscale/base/log.hpp"

namespace slipscale {

using OwnedKSP = Owned<KSP, KSPDestroy>;

struct SlidingOperator::Factor {
  OwnedMat matrix;
  OwnedKSP ksp;
};

SlidingOperator::SlidingOperator(MPI_Comm comm, const Model& model, FreeComponents free,
                                 std::vector<ClosedNode> closed, double direction)
    : comm_(comm),
      model_(model),
      free_(std::move(free)),
      closed_(std::move(closed)),
      direction_(direction),
      u_(std::make_unique<NodalVector>(comm, model.mesh.nodes, true)),
      force_(model.mesh.nodes.number.size(), {0, 0}) {
  for (const ClosedNode& each : closed_) sliding_.push_back(free_.place_of(each.node, 0));
}

SlidingOperator::~SlidingOperator() = default;

void SlidingOperator::factorise() const {
  static const LogEvent event("ModesFactor");
  const LogEvent::Scope scope(event);
  const MPI_Comm comm = comm_;
  factor_ = std::make_unique<Factor>();
  {
    const OwnedMat whole = assembled_stiffness(comm, model_), c = free_.matrix();
    petsc(MatPtAP(whole, c, MAT_INITIAL_MATRIX, PETSC_DEFAULT, factor_->matrix.put()));
  }
  petsc(MatSetOption(factor_->matrix, MAT_SYMMETRIC, PETSC_TRUE));
  petsc(MatSetOption(factor_->matrix, MAT_SPD, PETSC_TRUE));
  KSP* ksp = factor_->ksp.put();
  petsc(KSPCreate(comm, ksp));
  petsc(KSPSetOptionsPrefix(*ksp, "modes_"));
  petsc(KSPSetOperators(*ksp, factor_->matrix, factor_->matrix));
  petsc(KSPSetType(*ksp, KSPPREONLY));
  PC pc = nullptr;
  petsc(KSPGetPC(*ksp, &pc));
  petsc(PCSetType(pc, PCCHOLESKY));
  petsc(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  petsc(KSPSetFromOptions(*ksp));
  do petsc(KSPSetUp(*ksp));
  while (enlarge_workspace(*ksp));
  PCFailedReason reason = PC_NOERROR;
  petsc(PCGetFailedReason(pc, &reason));
  int failed = reason != PC_NOERROR;
  MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, comm);
  if (failed)
    throw UserError(
        "the stiffness of the body cannot be factorised (PETSc and MUMPS: singular, or out of memory); look "
        "for parts that hang by one node, hold the body with -boundary_<boundary>_x or _y, or take more "
        "memory or ranks");
}

void SlidingOperator::internal_force(const Vector2* u, Vector2* force) const {
  const auto owned = static_cast<std::size_t>(model_.mesh.nodes.owned);
  if (u != u_->data()) std::copy_n(u, owned, u_->data());
  u_->begin_update();
  u_->end_update();
  model_.multiply(u_->data(), force_.data());
  if (force != force_.data()) std::copy_n(force_.data(), owned, force);
}

void SlidingOperator::multiply(const double* w, double* kw, double* reaction) const {
  free_.expand(w, u_->data());
  internal_force(u_->data(), force_.data());
  free_.restrict_to(force_.data(), kw);
  for (std::size_t k = 0; k < closed_.size(); ++k) reaction[k] = force_[closed_[k].node][1];
}

Columns SlidingOperator::solve(const Columns& right) const {
  if (!factor_) factorise();
  static const LogEvent event("ModesSolve");
  const LogEvent::Scope scope(event);
  Columns from = right, to = Columns::Zero(right.rows(), right.cols());
  const auto rows = static_cast<PetscInt>(right.rows()), columns = static_cast<PetscInt>(right.cols());
  if (columns == 0) return to;
  OwnedMat b, x;
  petsc(MatCreateDense(comm_, rows, PETSC_DECIDE, free_.total(), columns, from.data(), b.put()));
  petsc(MatCreateDense(comm_, rows, PETSC_DECIDE, free_.total(), columns, to.data(), x.put()));
  petsc(KSPMatSolve(factor_->ksp, b, x));
  return to;
}

}  // namespace slipscale
