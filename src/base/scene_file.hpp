#pragma once

#include <string>
#include <vector>

#include "slipscale/base/options.hpp"

/// A scene is one YAML document. It means here what it means to Python's yaml (YAML 1.1), or it is refused:
///
/// - Nested keys join with _; a list of words or numbers joins with commas. No lists in lists, no options in
///   lists, no tags, no second document, at most 50 levels.
/// - A key stands once in its map, and a name, however it is nested, once in the file; capitals do not count.
///   A merge (`<<: *base`) adds what the map does not give itself. Keys that begin with $$ at the top are
///   there to be referred to only.
/// - A value without quotes is a text, a decimal number or a flag. Numbers: 12, -0.5, 1.5e+9, and 1e9, which
///   Python keeps as a text and both read as a number in the end. Flags: true, false, yes, no, on, off.
/// - What YAML 1.1 reads otherwise than it looks is refused without quotes, as a value and as a key: 010
///   (base 8), 0x1F, 0b1, 1:30 (base 60), 1_000, .inf, .nan, dates; a flag or a number such as 1.50, where
///   the option wants a text; a key that is a flag, a number other than digits, or nothing.
/// - A value that is empty, ~ or null is none: refused, but for PETSc's options and for `run_<entry>`.
/// - A NUL byte and text that is not UTF-8 are refused.
namespace slipscale {

/// The options of a scene. `file` is for messages. Throws `UserError`. Every rank must pass the same text.
std::vector<Written> read_scene_text(const std::string& file, const std::string& text, int order);

}  // namespace slipscale
