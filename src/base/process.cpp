#include "process.hpp"

#include <chrono>
#include <cstdlib>

#include "slipscale/base/program.hpp"

namespace slipscale {
namespace {

const auto start = std::chrono::steady_clock::now();

}  // namespace

double seconds_since_start() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void start_alone() {
  std::signal(SIGPIPE, SIG_IGN);
  // mpirun, and a scheduler that starts ranks by itself, leave their marks in the environment.
  for (const char* mark : {"OMPI_COMM_WORLD_SIZE", "PMIX_NAMESPACE", "PMI_RANK", "PMI_FD"})
    if (std::getenv(mark)) return;
  (void)setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  // Processes that are alone would all have the same session folder, where one that ends takes it away
  // from one that starts, and the same names of shared memory: they go without, and without the shared
  // file pointers that lie there.
  (void)setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
  (void)setenv("OMPI_MCA_sharedfp", "^sm", 0);
  // Looking for a network takes .2 s, and there is nobody to speak to.
  (void)setenv("OMPI_MCA_pml", "ob1", 0);
  (void)setenv("OMPI_MCA_btl", "self", 0);
}

KeptSignals::KeptSignals() {
  for (std::size_t k = 0; k < kept_.size(); ++k) sigaction(kept_[k], nullptr, &before_[k]);
}

KeptSignals::~KeptSignals() {
  for (std::size_t k = 0; k < kept_.size(); ++k) sigaction(kept_[k], &before_[k], nullptr);
}

}  // namespace slipscale
