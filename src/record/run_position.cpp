#include "slipscale/record/run_position.hpp"

namespace slipscale {

TimeStep RunPosition::time_step() const {
  return {step, limit, safe_limit, static_cast<long>(count), {sharp_frequency, safe_frequency}};
}

void RunPosition::set_time_step(const TimeStep& time) {
  step = time.step;
  limit = time.limit;
  safe_limit = time.safe_limit;
  sharp_frequency = time.frequency.sharp;
  safe_frequency = time.frequency.safe;
  count = static_cast<double>(time.count);
}

StateGroup RunPosition::state(bool keeps) {
  StateGroup group{"run", {0}, 0, keeps, {}};
  const auto add = [&](const char* name, const char* units, const char* text, double& value) {
    group.arrays.push_back({name, units, text, 1, &value});
  };
  add("step", "s", "time step", step);
  add("stable_step", "s", "stability limit for the largest frequency", limit);
  add("safe_stable_step", "s", "the same for the bound of that frequency", safe_limit);
  add("largest_frequency", "1/s", "by Lanczos", sharp_frequency);
  add("largest_frequency_bound", "1/s", "of the largest element", safe_frequency);
  add("steps", "1", "to the end of the run", count);
  add("history_every", "1", "steps between the rows of history.h5", history_every);
  add("contact_every", "1", "steps between the rows of contact.h5", contact_every);
  add("contact_auto", "1", "1 when that number comes from `auto`", contact_auto);
  add("interfaces_every", "1", "steps between the rows of interfaces.h5", interfaces_every);
  add("interfaces_auto", "1", "1 when that number comes from `auto`", interfaces_auto);
  add("interface_rows", "1", "rows of interfaces.h5", interface_rows);
  add("fields_every", "1", "steps between the frames of fields.h5", fields_every);
  add("statistics_first", "1", "first step of the window of the statistics", window_first);
  add("statistics_last", "1", "last step of it", window_last);
  add("statistics_every", "1", "steps between its samples", window_every);
  add("history_rows", "1", "rows of history.h5", history_rows);
  add("contact_rows", "1", "rows of contact.h5", contact_rows);
  add("frames", "1", "frames of fields.h5", frames);
  add("last_recorded_step", "1", "whose record was written", last_sound);
  add("last_frame_step", "1", "whose frame was written", last_frame);
  add("largest_residual", "1", "of the energy balance, of what flowed", largest_residual);
  add("rounded_residual", "1", "of the energy balance in rows that rounding accounts for", rounded_residual);
  add("even_rows_from", "1", "row of history.h5 from which on rows are evenly spaced", even_from);
  add("force_kept", "1", "1 when /force_record is complete", force_kept);
  add("seconds", "s", "of the steps and their output", seconds);
  return group;
}

}  // namespace slipscale
