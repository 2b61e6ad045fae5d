#include "slipscale/base/provenance.hpp"

#include <mpi.h>

#include <array>
#include <ctime>

#include "slipscale/base/parallel.hpp"
#include "slipscale/version.hpp"

namespace slipscale {
namespace {

std::string utc(std::time_t time) {
  std::tm parts{};
  std::array<char, 32> text{};
  gmtime_r(&time, &parts);
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts)};
}

Provenance& own() {
  static Provenance told{"slipscale", version, "", utc(std::time(nullptr)), 1};
  return told;
}

}  // namespace

Provenance provenance() {
  Provenance found = own();
  int started = 0, ended = 0;
  MPI_Initialized(&started);
  MPI_Finalized(&ended);
  if (started && !ended) found.ranks = ranks_of(MPI_COMM_WORLD);
  return found;
}

void set_program(const std::string& program, const std::string& commit) {
  own().program = program;
  own().commit = commit;
}

}  // namespace slipscale
