#include <array>
#include <utility>

#include "slipscale/dynamics/bulk.hpp"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace slipscale {
namespace {

#define SLIPSCALE_BODY "slipscale/dynamics/free_motion.inc"
#include "slipscale/solid/for_all_instructions.inc"

using Move = void (*)(const FreeMotionState&, int begin, int end, const Vector2* force);

/// In the order of `Instructions`.
template <BulkPhysics physics>
constexpr std::array<Move, 3> ways{base::move<physics>, avx2::move<physics>, avx512::move<physics>};

template <std::size_t... k>
constexpr auto table_of(std::index_sequence<k...>) {
  return std::array{
      ways<BulkPhysics{(k & 1) != 0, (k & 2) != 0, (k & 4) != 0, (k & 8) != 0, (k & 16) != 0}>...};
}

}  // namespace

FreeMotion::Move FreeMotion::moving(const BulkPhysics& physics, Instructions instructions) {
  static constexpr auto table = table_of(std::make_index_sequence<32>());
  const unsigned row = (physics.mass_damping ? 1u : 0u) | (physics.stiffness_damping ? 2u : 0u) |
                       (physics.numerical_dissipation ? 4u : 0u) | (physics.keeps_acceleration ? 8u : 0u) |
                       (physics.graded_gravity ? 16u : 0u);
  return table[row][static_cast<std::size_t>(instructions)];
}

void see(const SeenNodes& nodes, int count, double back, double weight, Instructions instructions) {
  static constexpr std::array see_with{base::see_nodes, avx2::see_nodes, avx512::see_nodes};
  see_with[static_cast<std::size_t>(instructions)](nodes, count, back, weight);
}

}  // namespace slipscale
