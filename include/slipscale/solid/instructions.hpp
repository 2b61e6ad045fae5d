#pragma once

#include <string>

namespace slipscale {

/// Vector instructions that the inner loops are compiled for, whatever processor the program is built for:
/// those that every processor of its kind has, AVX2, AVX-512. They give the same bits: no loop adds what
/// another adds in a different order, and none fuses a product with a sum.
enum class Instructions { base, avx2, avx512 };

/// The widest that this processor has.
Instructions widest_instructions();

std::string name_of(Instructions instructions);

}  // namespace slipscale
