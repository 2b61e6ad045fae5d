#pragma once

#include <petscsys.h>

#include <string>
#include <vector>

namespace slipscale {

/// Numbers that a run carries from one step to the next, for a checkpoint to keep and to bring back: rows of
/// `width` each, one after the other, in the order of the keys of their group.
struct StateArray {
  std::string name, units, text;
  int width = 1;
  double* values = nullptr;
};

/// Arrays over the same things: nodes, cells, contact nodes, or the run as a whole.
struct StateGroup {
  std::string name;
  std::vector<PetscInt> keys;  ///< of this rank's rows: whole-mesh numbers, say
  /// Keys are 0 to `total` − 1, each on one rank that keeps it; 0: few rows, of any keys.
  PetscInt total = 0;
  /// Whether this rank's rows are the ones that are kept. What several ranks hold alike one of them keeps,
  /// and all get back.
  bool keeps = true;
  std::vector<StateArray> arrays;
};

}  // namespace slipscale
