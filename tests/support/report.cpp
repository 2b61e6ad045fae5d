#include "report.hpp"

#include <petscsys.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "slipscale/base/print.hpp"

namespace slipscale::testing_support {

std::string shown_error(double error, double rounding) {
  return error < rounding ? format("< {:.0e}", rounding) : format("{:.1e}", error);
}

double worse(double one, double other) {
  if (std::isnan(one) || std::isnan(other)) return std::numeric_limits<double>::infinity();
  return std::max(one, other);
}

double largest_of_ranks(double value) {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD);
  return value;
}

void report(const Finding& finding) {
  const std::string order = finding.order.empty() ? "-" : finding.order;
  print("verification | " + finding.topic + " | " + finding.quantity + " | " + finding.expected + " | " +
        finding.found + " | " + order + " | " + finding.source + "\n");
}

}  // namespace slipscale::testing_support
