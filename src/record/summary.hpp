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
  long history_every, contact_every;     ///< steps
  const std::vector<double>& force;      ///< a `ForceRecord` of the measured boundary; empty without one
  double largest_residual;               ///< relative to what flowed
  double seconds;                        ///< wall time of the steps
  std::vector<std::string> remarks;      ///< on the scene and the run, a sentence each
  Momentum momentum;                     ///< at the end
  long steps;                            ///< made
  std::string why, command;              ///< of an interrupted run: who stopped it, how to go on
  std::size_t even_from;                 ///< the row from which on rows are as far apart as they are now
  std::string interfaces;                ///< what debonds first; empty where interfaces are not followed
};

/// summary.yaml: the headline numbers, on rank 0.
///
/// Averages are over `default_window`, the second half of the run, each with its standard error from blocks
/// of it (`mean_of`); whether the run had settled in it is judged by `settling` of the tangential over the
/// mean normal force, and the regime has its name by `regime`, all in averages.hpp. Peaks are those of
/// `welch` of the same signal (spectrum.hpp), of three half-overlapping segments, where it varies by more
/// than rounding; what the recorded rows may have folded into them is looked for in the force on every step.
/// The energy terms are those of `Energy` (ledger.hpp).
std::string summary_text(const SummaryInput& input);

}  // namespace slipscale
