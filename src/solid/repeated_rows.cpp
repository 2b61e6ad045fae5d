#include "slipscale/solid/repeated_rows.hpp"

#include <cstring>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace slipscale {
namespace {

#define SLIPSCALE_BODY "slipscale/solid/gather_runs.inc"
#include "slipscale/solid/for_all_instructions.inc"

}  // namespace

bool Term::operator==(const Term& other) const {
  return std::memcmp(&straight, &other.straight, sizeof straight) == 0 &&
         std::memcmp(&crossed, &other.crossed, sizeof crossed) == 0 && offset == other.offset;
}

GatherRuns gather_runs_with(Instructions instructions) {
  switch (instructions) {
    case Instructions::avx512:
      return avx512::gather_runs;
    case Instructions::avx2:
      return avx2::gather_runs;
    default:
      return base::gather_runs;
  }
}

GatherQuartets gather_quartets_with(Instructions instructions) {
  switch (instructions) {
    case Instructions::avx512:
      return avx512::gather_quartets;
    case Instructions::avx2:
      return avx2::gather_quartets;
    default:
      return base::gather_quartets;
  }
}

}  // namespace slipscale
