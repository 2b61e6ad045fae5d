#pragma once

#include <string>

namespace slipscale {

/// Where a result comes from: what a file may say of the program that wrote it.
struct Provenance {
  std::string program;  ///< "slide"; "slipscale" where no `run_program` said so (tests, other programs)
  std::string version;  ///< of slipscale, "0.1.0"
  std::string commit;   ///< of the sources, 12 digits and "-dirty" where they were changed; "" without git
  std::string date;     ///< UTC at which the program started, ISO 8601: "2026-01-31T12:00:00Z"
  int ranks = 1;        ///< of MPI_COMM_WORLD; 1 before MPI starts
};

/// Of this process; the same on every rank but for the date, of which rank 0's counts.
Provenance provenance();

/// Says which program this is. `run_program` does so.
void set_program(const std::string& program, const std::string& commit);

}  // namespace slipscale
