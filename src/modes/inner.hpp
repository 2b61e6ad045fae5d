#pragma once

#include <mpi.h>

#include <Eigen/Dense>

namespace slipscale {

/// AᵀB of columns that lie on all ranks, the same on every rank. Collective.
Eigen::MatrixXd inner(MPI_Comm comm, const Eigen::Ref<const Eigen::MatrixXd>& a,
                      const Eigen::Ref<const Eigen::MatrixXd>& b);
/// The sum over the ranks. Collective.
double sum_of(MPI_Comm comm, double value);

/// Solves A x = b by GMRES with the preconditioner P, A P y = b, x = P y, from x = 0 until the residual is
/// below `tolerance` times that of the start. Returns the residual reached, relative. Collective.
struct Gmres {
  int steps = 0;
  double residual = 0;
};
template <class Multiply, class Precondition>
Gmres gmres(MPI_Comm comm, const Multiply& multiply, const Precondition& precondition,
            const Eigen::VectorXd& right, double tolerance, int most, Eigen::VectorXd& x) {
  const double size = std::sqrt(sum_of(comm, right.squaredNorm()));
  x = Eigen::VectorXd::Zero(right.size());
  if (size == 0) return {};
  Eigen::MatrixXd v(right.size(), 1), z(right.size(), 0), h = Eigen::MatrixXd::Zero(most + 1, most);
  v.col(0) = right / size;
  Gmres found;
  Eigen::VectorXd y;
  for (int k = 0; k < most; ++k) {
    z.conservativeResize(Eigen::NoChange, k + 1);
    z.col(k) = precondition(v.col(k));
    Eigen::VectorXd w = multiply(z.col(k));
    for (int again = 0; again < 2; ++again) {
      const Eigen::VectorXd part = inner(comm, v, w);
      w -= v * part;
      h.col(k).head(k + 1) += part;
    }
    h(k + 1, k) = std::sqrt(sum_of(comm, w.squaredNorm()));
    const Eigen::MatrixXd little = h.topLeftCorner(k + 2, k + 1);
    Eigen::VectorXd start = Eigen::VectorXd::Zero(k + 2);
    start[0] = size;
    y = little.householderQr().solve(start);
    found = {k + 1, (start - little * y).norm() / size};
    if (found.residual <= tolerance || h(k + 1, k) <= 1e-300) break;
    v.conservativeResize(Eigen::NoChange, k + 2);
    v.col(k + 1) = w / h(k + 1, k);
  }
  x = z.leftCols(found.steps) * y;
  return found;
}

}  // namespace slipscale
