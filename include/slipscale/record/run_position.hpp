#pragma once

#include <vector>

#include "slipscale/base/state_group.hpp"
#include "slipscale/dynamics/scene.hpp"

namespace slipscale {

/// Where a run stands, for another process to go on with it: how it steps, how often it records, and what its
/// files hold. All numbers are doubles, as a checkpoint keeps them.
struct RunPosition {
  double step = 0, limit = 0, safe_limit = 0;                  ///< s, see TimeStep
  double sharp_frequency = 0, safe_frequency = 0;              ///< 1/s
  double count = 0;                                            ///< steps to the end
  double history_every = 0, contact_every = 0;                 ///< steps; 0: no such file
  double fields_every = 0;                                     ///< steps; 0: none, or frames at given times
  double window_first = 0, window_last = 0, window_every = 0;  ///< steps of the statistics
  double history_rows = 0, contact_rows = 0, frames = 0;       ///< of the files
  double last_sound = -1, last_frame = -1;                     ///< steps
  double largest_residual = 0;                                 ///< relative to what flowed
  double rounded_residual = 0;                                 ///< of rows that are rounding
  double contact_auto = 0;  ///< 1 when contact_every is what `auto` made of the first end
  double interfaces_every = 0, interfaces_auto = 0, interface_rows = 0;  ///< the same of interfaces.h5
  double even_from = 0;   ///< first row of history.h5 from which on rows are as far apart as now
  double force_kept = 0;  ///< 1 when the force of every step is among the rest, from the start on
  double seconds = 0;     ///< s, that the steps so far and their output took

  TimeStep time_step() const;
  void set_time_step(const TimeStep& time);
  /// As the group "run" of a state file; `keeps` on one rank.
  StateGroup state(bool keeps);
};

}  // namespace slipscale
