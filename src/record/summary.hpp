#pragma once

#include <string>
#include <vector>

#include "slipscale/record/observation.hpp"

namespace slipscale {

/// What the headline numbers of a run are made of.
struct SummaryInput {
  const SlidingBody& body;
  const TimeStep& time;
  const std::vector<Observation>& rows;  ///< rank 0: the rows of history.h5
  int measured;                          ///< index of the measured boundary; −1 without one
  long history_every;                    ///< steps
  double largest_residual;               ///< relative to what flowed
  double seconds;                        ///< wall time of the steps
  std::vector<std::string> remarks;      ///< on the scene and the run, a sentence each
  Momentum momentum;                     ///< at the end
};

/// summary.yaml: the headline numbers, averages over the second half of the run. Rank 0.
std::string summary_text(const SummaryInput& input);

}  // namespace slipscale
