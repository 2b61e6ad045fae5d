#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace slipscale::spelling {

/// Lower case, ASCII only, as PETSc's options database folds its names.
std::string fold(const std::string& word);

/// Insertions, deletions, replacements and swaps of neighbours that turn each beginning of `from` into `to`:
/// entry `i` belongs to the first `i` letters of `from`. Optimal string alignment; nothing is folded.
std::vector<std::size_t> distances(const std::string& from, const std::string& to);

/// The largest distance at which a word of that length still passes for a slip of the finger.
std::size_t tolerance(std::size_t length);

}  // namespace slipscale::spelling
