#include "slipscale/files/progress.hpp"

#include <fcntl.h>
#include <petscsys.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "slipscale/base/parallel.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/base/readable.hpp"

namespace slipscale {
namespace {

// A line stays below 80 columns: on a narrower terminal the carriage return would not reach its beginning.
constexpr double between_lines = 0.5, between_looks = 0.05;  // s

double seconds_between(std::chrono::steady_clock::time_point from, std::chrono::steady_clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

}  // namespace

bool writes_to_terminal() {
  if (!isatty(STDOUT_FILENO)) return false;
  if (!std::getenv("OMPI_COMM_WORLD_RANK")) return true;
  // Our terminal is mpirun's pseudo terminal; what counts is where mpirun writes.
  const int output =
      open(format("/proc/{}/fd/1", static_cast<int>(getppid())).c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK);
  const bool terminal = output >= 0 && isatty(output);
  if (output >= 0) close(output);
  return terminal;
}

std::string progress_line(double part, std::int64_t step, double time, double seconds_left) {
  return format("{:3.0f} %  step {}  {}  {} left", 100 * part, static_cast<long long>(step),
                engineering(time, "s"), readable_duration(seconds_left));
}

Progress::Progress(const std::string& mode, double start_time, double end_time)
    : Progress(mode != "none" && is_root(PETSC_COMM_WORLD) && writes_to_terminal(), start_time, end_time) {}

Progress::Progress(bool on, double start_time, double end_time)
    : on_(on), start_(start_time), end_(end_time) {}

void Progress::note(double friction, double energy_residual) {
  noted_ = true;
  friction_ = friction;
  residual_ = energy_residual;
}

void Progress::look(std::int64_t step, double time) {
  const auto now = Clock::now();
  // As many steps until the next look as take `between_looks`, growing at most tenfold at a time.
  const double taken = std::max(seconds_between(looked_, now), 1e-9);
  const double steps = static_cast<double>(std::max<std::int64_t>(step - last_step_, 1));
  const double wanted = std::clamp(steps * between_looks / taken, 1.0, 10 * steps);
  next_look_ = step + static_cast<std::int64_t>(wanted);
  last_step_ = step;
  looked_ = now;
  if (seconds_between(shown_, now) >= between_lines) {
    shown_ = now;
    show(step, time);
  }
}

void Progress::show(std::int64_t step, double time) {
  const double part = end_ > start_ ? std::clamp((time - start_) / (end_ - start_), 0.0, 1.0) : 1.0;
  const double spent = seconds_between(begun_, shown_);
  std::string line = progress_line(part, step, time, part > 0 ? spent * (1 - part) / part : 0);
  if (noted_) line += format("  friction {:.3f}  residual {:.0e}", friction_, residual_);
  const std::size_t width = line.size();
  line.resize(std::max(width, width_), ' ');  // over what the last line leaves behind
  width_ = width;
  print("\r" + line);
}

void Progress::finish() {
  if (on_ && width_ > 0) print("\n");
  width_ = 0;
}

}  // namespace slipscale
