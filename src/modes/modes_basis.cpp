#include "slipscale/modes/modes_basis.hpp"

#include <cmath>

#include "inner.hpp"
#include "slipscale/base/log.hpp"

namespace slipscale {
namespace {

/// Columns with XᵀMX = I that span the given ones, but for what is rounding beside the largest.
Columns orthonormal(MPI_Comm comm, const Column& mass, const Columns& x, double least) {
  const Eigen::MatrixXd gram = inner(comm, x, mass.asDiagonal() * x);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram);
  const Eigen::VectorXd& value = solver.eigenvalues();
  Eigen::Index first = 0;
  while (first < value.size() && !(value[first] > least * least)) ++first;
  const Eigen::Index kept = value.size() - first;
  return x *
         (solver.eigenvectors().rightCols(kept) * value.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal());
}

}  // namespace

namespace {

/// On any rank. Collective.
bool depends_on_slip(MPI_Comm comm, const SlidingOperator& body) {
  int depends = !body.slip_slope.empty();
  MPI_Allreduce(MPI_IN_PLACE, &depends, 1, MPI_INT, MPI_MAX, comm);
  return depends != 0;
}

}  // namespace

Eigen::Index ModesBasis::add(Columns x, double least) {
  static const LogEvent event("ModesBasis");
  const LogEvent::Scope scope(event);
  const MPI_Comm comm = body_.comm();
  const Column& mass = body_.free().mass();
  const Eigen::Index n = body_.free().size(), old = size();
  if (shape_.rows() != n) shape_.resize(n, 0);
  for (Eigen::Index k = 0; k < x.cols(); ++k) {
    const double length = std::sqrt(sum_of(comm, x.col(k).dot(mass.cwiseProduct(x.col(k)))));
    if (length > 0) x.col(k) /= length;
  }
  const auto project = [&] {
    if (old > 0) x -= shape_ * inner(comm, shape_, mass.asDiagonal() * x);
  };
  project();
  x = orthonormal(comm, mass, x, least);
  project();
  x = orthonormal(comm, mass, x, 0.5);
  const Eigen::Index added = x.cols();
  if (added == 0) return 0;

  const auto closed = static_cast<Eigen::Index>(body_.closed().size());
  Columns kx(n, added);
  shape_.conservativeResize(Eigen::NoChange, old + added);
  shape_.rightCols(added) = x;
  reaction_.conservativeResize(closed, old + added);
  for (Eigen::Index k = 0; k < added; ++k)
    body_.multiply(x.col(k).data(), kx.col(k).data(), reaction_.col(old + k).data());
  const Eigen::MatrixXd beside = inner(comm, shape_, kx);
  problem_.stiffness.conservativeResize(old + added, old + added);
  problem_.stiffness.rightCols(added) = beside;
  problem_.stiffness.bottomLeftCorner(added, old) = beside.topRows(old).transpose();
  // G has rows for the x of closed nodes alone.
  Eigen::MatrixXd slides = Eigen::MatrixXd::Zero(closed, old + added);
  for (Eigen::Index k = 0; k < closed; ++k)
    if (const int place = body_.sliding_places()[static_cast<std::size_t>(k)]; place >= 0)
      slides.row(k) =
          body_.direction() * body_.closed()[static_cast<std::size_t>(k)].weight * shape_.row(place);
  problem_.friction = inner(comm, slides, reaction_);
  if (depends_on_slip(comm, body_)) {
    Eigen::MatrixXd there = Eigen::MatrixXd::Zero(closed, old + added), damped = there;
    for (Eigen::Index k = 0; k < closed; ++k)
      if (const int place = body_.sliding_places()[static_cast<std::size_t>(k)]; place >= 0) {
        there.row(k) = shape_.row(place);
        damped.row(k) = body_.slip_slope[static_cast<std::size_t>(k)] * shape_.row(place);
      }
    problem_.slip = inner(comm, there, damped);
  }
  return added;
}

Columns ModesBasis::shape_of(const Eigen::MatrixXcd& vectors) const {
  Eigen::MatrixXd parts(vectors.rows(), 2 * vectors.cols());
  for (Eigen::Index k = 0; k < vectors.cols(); ++k)
    parts.middleCols(2 * k, 2) << vectors.col(k).real(), vectors.col(k).imag();
  return shape_ * parts;
}

Eigen::VectorXcd ModesBasis::reaction_of(const Eigen::VectorXcd& vector) const { return reaction_ * vector; }

ModesBasis::Residual ModesBasis::residual(const SlidingLaw& law, const SlidingMode& mode) const {
  return residual(law, mode, shape_of(mode.vector));
}

ModesBasis::Residual ModesBasis::residual(const SlidingLaw& law, const SlidingMode& mode,
                                          const Columns& u) const {
  static const LogEvent event("ModesResidual");
  const LogEvent::Scope scope(event);
  const MPI_Comm comm = body_.comm();
  const Column& mass = body_.free().mass();
  Columns ku(u.rows(), 2);
  const auto closed = static_cast<Eigen::Index>(body_.closed().size());
  Eigen::MatrixXd reaction(closed, 2);
  for (Eigen::Index part = 0; part < 2; ++part)
    body_.multiply(u.col(part).data(), ku.col(part).data(), reaction.col(part).data());
  const SlidingLaw::Value value = law.at(mode.exponent);
  // N u in complex numbers, as pairs of real columns.
  Eigen::VectorXcd force(u.rows()), lambda(closed);
  for (Eigen::Index k = 0; k < u.rows(); ++k)
    force[k] = Complex(ku(k, 0), ku(k, 1)) + value.inertia * mass[k] * Complex(u(k, 0), u(k, 1));
  for (Eigen::Index k = 0; k < closed; ++k) lambda[k] = {reaction(k, 0), reaction(k, 1)};
  body_.add_friction(-value.friction, lambda, force);
  body_.add_slip(
      value.slip, [&](int k) { return Complex(u(k, 0), u(k, 1)); }, force);
  Residual found{Columns(u.rows(), 2), 0};
  found.force << force.real(), force.imag();
  const Column light = mass.cwiseInverse();
  const auto norm = [&](const Columns& x) {
    return std::sqrt(sum_of(comm, (light.asDiagonal() * x.cwiseAbs2()).sum()));
  };
  const double size = norm(ku) + std::abs(value.inertia) * norm(mass.asDiagonal() * u);
  found.force /= size;
  found.size = norm(found.force);
  return found;
}

}  // namespace slipscale
