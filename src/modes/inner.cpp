#include "inner.hpp"

namespace slipscale {

Eigen::MatrixXd inner(MPI_Comm comm, const Eigen::Ref<const Eigen::MatrixXd>& a,
                      const Eigen::Ref<const Eigen::MatrixXd>& b) {
  Eigen::MatrixXd sum = a.transpose() * b;
  MPI_Allreduce(MPI_IN_PLACE, sum.data(), static_cast<int>(sum.size()), MPI_DOUBLE, MPI_SUM, comm);
  MPI_Bcast(sum.data(), static_cast<int>(sum.size()), MPI_DOUBLE, 0, comm);
  return sum;
}

double sum_of(MPI_Comm comm, double value) {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_SUM, comm);
  MPI_Bcast(&value, 1, MPI_DOUBLE, 0, comm);
  return value;
}

}  // namespace slipscale
