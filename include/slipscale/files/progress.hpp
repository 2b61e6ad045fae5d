#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace slipscale {

/// Standard output goes to a terminal, through mpirun too (Open MPI gives its programs a terminal of their
/// own even when its output goes to a file).
bool writes_to_terminal();

/// One line on rank 0's terminal that is written over at most twice a second: how far, how long still, and
/// how sound.
class Progress {
 public:
  /// On when `mode` is not "none", on rank 0 of PETSC_COMM_WORLD, when standard output is a terminal. Times
  /// in s.
  Progress(const std::string& mode, double start_time, double end_time);
  /// The same with the decision taken by the caller.
  Progress(bool on, double start_time, double end_time);
  ~Progress() { finish(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// The state at the last recorded row: friction coefficient, and energy residual over the energy put in.
  void note(double friction, double energy_residual);

  /// To be called every step; looks at the clock only as often as the line needs it.
  void step(std::int64_t step, double time) {
    if (on_ && step >= next_look_) look(step, time);
  }

  /// Ends the line, when there is one.
  void finish();

  bool on() const { return on_; }

 private:
  using Clock = std::chrono::steady_clock;
  void look(std::int64_t step, double time);
  void show(std::int64_t step, double time);

  bool on_, noted_ = false;
  double start_, end_;
  double friction_ = 0, residual_ = 0;
  std::int64_t next_look_ = 0, last_step_ = -1;
  Clock::time_point begun_ = Clock::now(), looked_ = begun_, shown_ = begun_;
  std::size_t width_ = 0;  ///< of the line on the screen
};

/// The line's text, without the carriage return.
std::string progress_line(double part, std::int64_t step, double time, double seconds_left);

}  // namespace slipscale
