#pragma once

#include <array>
#include <csignal>

namespace slipscale {

/// While it lives, the signals by which schedulers and terminals ask a program to end (SIGTERM, SIGINT,
/// SIGUSR1) are only noted, for a run to end in good order at a step that suits it. A second signal ends the
/// program at once; one that comes within .3 s of the first is the same request, which a launcher has passed
/// on as well. One object at a time.
class StopRequest {
 public:
  StopRequest();
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  /// The signal that came to this process; 0: none.
  int signal() const;

 private:
  static constexpr std::array<int, 3> noted_{SIGTERM, SIGINT, SIGUSR1};
  std::array<struct sigaction, 3> before_{};
};

/// "SIGTERM".
const char* signal_name(int signal);

}  // namespace slipscale
