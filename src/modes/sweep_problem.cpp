#include "sweep_problem.hpp"

#include <algorithm>
#include <cmath>

#include "inner.hpp"

namespace slipscale {
namespace {

constexpr double least = 1e-9;  ///< of a direction of the vectors, over the largest

Eigen::MatrixXd directions(const std::vector<Eigen::VectorXcd>& vectors, Eigen::Index size) {
  Eigen::MatrixXd all(size, 2 * static_cast<Eigen::Index>(vectors.size()));
  Eigen::Index column = 0;
  for (const Eigen::VectorXcd& y : vectors) {
    Eigen::VectorXcd filled = Eigen::VectorXcd::Zero(size);
    filled.head(y.size()) = y;
    all.col(column++) = filled.real();
    all.col(column++) = filled.imag();
  }
  return orthonormal_part(all);
}

}  // namespace

Eigen::MatrixXd orthonormal_part(const Eigen::MatrixXd& vectors) {
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(vectors, Eigen::ComputeThinU);
  const auto kept = (svd.singularValues().array() > least * svd.singularValues()[0]).count();
  return svd.matrixU().leftCols(kept);
}

SweepProblem::SweepProblem(const ModesBasis& basis, const std::vector<Eigen::VectorXcd>& vectors)
    : part_(directions(vectors, basis.size())) {
  const SlidingOperator& body = basis.body();
  const Column& mass = body.free().mass();
  MPI_Bcast(part_.data(), static_cast<int>(part_.size()), MPI_DOUBLE, 0, body.comm());
  problem_.stiffness = part_.transpose() * basis.problem().stiffness * part_;
  problem_.friction = part_.transpose() * basis.problem().friction * part_;
  const Eigen::Index size = part_.cols();
  Columns ku(body.free().size(), size);
  const auto closed = static_cast<Eigen::Index>(body.closed().size());
  Eigen::MatrixXd reaction(closed, size);
  constexpr Eigen::Index at_once = 16;  // columns of U, which is as large as K U and needed for nothing else
  for (Eigen::Index begin = 0; begin < size; begin += at_once) {
    const Columns u = basis.shapes() * part_.middleCols(begin, std::min(at_once, size - begin));
    for (Eigen::Index k = 0; k < u.cols(); ++k)
      body.multiply(u.col(k).data(), ku.col(begin + k).data(), reaction.col(begin + k).data());
  }
  // G U has rows at the x of closed nodes alone; those of both sides over √m.
  Eigen::MatrixXd gu = Eigen::MatrixXd::Zero(closed, size), there = gu;
  for (Eigen::Index k = 0; k < closed; ++k)
    if (const int place = body.sliding_places()[static_cast<std::size_t>(k)]; place >= 0) {
      const double light = 1 / std::sqrt(mass[place]);
      gu.row(k) =
          light * body.direction() * body.closed()[static_cast<std::size_t>(k)].weight * reaction.row(k);
      there.row(k) = light * ku.row(place);
    }
  ku.array().colwise() /= mass.array().sqrt();
  stiff_ = inner(body.comm(), ku, ku);
  beside_ = inner(body.comm(), gu, there);
  slides_ = inner(body.comm(), gu, gu);
}

double SweepProblem::residual(const SlidingLaw& law, const ReducedMode& mode) const {
  const Eigen::VectorXcd& y = mode.vector;
  const SlidingLaw::Value value = law.at(mode.exponent);
  const Complex q = value.inertia, g = value.friction;
  const double stiff = y.dot(stiff_ * y).real(), inertia = std::norm(q) * y.squaredNorm();
  const Complex crossed = q * y.dot(problem_.stiffness * y) - std::conj(g) * y.dot(beside_ * y) -
                          std::conj(g) * q * y.dot(problem_.friction.transpose() * y);
  const double square = stiff + inertia + std::norm(g) * y.dot(slides_ * y).real() + 2 * crossed.real();
  return std::sqrt(std::max(0.0, square)) / (std::sqrt(stiff) + std::sqrt(inertia));
}

}  // namespace slipscale
