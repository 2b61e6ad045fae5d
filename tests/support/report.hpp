#pragma once

#include <string>

namespace slipscale::testing_support {

/// One row of the verification table: what an independent source says and what slipscale finds. The texts
/// hold no `|`.
struct Finding {
  std::string topic;     ///< the case, e.g. "Shear slab, 200 elements"
  std::string quantity;  ///< with its unit, e.g. "largest error of u, m"
  std::string expected;  ///< the stated value or bound
  std::string found;
  std::string order = "";  ///< observed order of convergence, where the case has one
  std::string source;      ///< paper and equation, exact solution, or who computed it
};

/// An error for the table: rounding errors differ from rank count to rank count, so only their bound is
/// shown.
std::string shown_error(double error, double rounding);

/// The larger error; infinite where one of them is no number, which std::max would pass over.
double worse(double one, double other);

/// The largest of all ranks of PETSC_COMM_WORLD. Collective.
double largest_of_ranks(double value);

/// Prints the row on rank 0; tests/verification/table.py gathers the rows.
void report(const Finding& finding);

}  // namespace slipscale::testing_support
