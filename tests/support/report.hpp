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

/// Prints the row on rank 0; tests/verification/table.py gathers the rows.
void report(const Finding& finding);

}  // namespace slipscale::testing_support
