#pragma once

#include <array>
#include <csignal>

namespace slipscale {

/// Before MPI starts. A process that nobody launched with others needs none of Open MPI's daemons, which cost
/// most of the time of a short run; and a reader that closes the pipe of our output (`slide … | head`) ends
/// the printing, not the run.
void start_alone();

/// Signals by which a terminal, a shell or a scheduler ends or keeps a run (hang-up, quit, terminate, a
/// closed pipe) mean after the start of MPI and PETSc what they meant before it, nohup's choice included: the
/// libraries' handlers answer them with a dump, or swallow them. Keeps from construction to destruction.
class KeptSignals {
 public:
  KeptSignals();
  ~KeptSignals();
  KeptSignals(const KeptSignals&) = delete;
  KeptSignals& operator=(const KeptSignals&) = delete;

 private:
  static constexpr std::array<int, 4> kept_{SIGHUP, SIGQUIT, SIGTERM, SIGPIPE};
  std::array<struct sigaction, 4> before_{};
};

}  // namespace slipscale
