#include "slipscale/base/stop_request.hpp"

#include <ctime>

namespace slipscale {
namespace {

volatile std::sig_atomic_t noted_signal = 0;
timespec noted_at{};  ///< written before `noted_signal` is set, read after it

double seconds_since(const timespec& then) {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec - then.tv_sec) +
         1e-9 * static_cast<double>(now.tv_nsec - then.tv_nsec);
}

void note(int number) {
  constexpr double passed_on = 0.3;  // s
  if (noted_signal == 0) {
    clock_gettime(CLOCK_MONOTONIC, &noted_at);
    noted_signal = number;
  } else if (seconds_since(noted_at) > passed_on) {
    (void)std::signal(number, SIG_DFL);
    (void)std::raise(number);
  }
}

}  // namespace

StopRequest::StopRequest() {
  noted_signal = 0;
  struct sigaction action {};
  action.sa_handler = note;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (std::size_t k = 0; k < noted_.size(); ++k) sigaction(noted_[k], &action, &before_[k]);
}

StopRequest::~StopRequest() {
  for (std::size_t k = 0; k < noted_.size(); ++k) sigaction(noted_[k], &before_[k], nullptr);
}

int StopRequest::signal() const { return noted_signal; }

const char* signal_name(int signal) {
  return signal == SIGTERM   ? "SIGTERM"
         : signal == SIGINT  ? "SIGINT"
         : signal == SIGUSR1 ? "SIGUSR1"
                             : "a signal";
}

}  // namespace slipscale
