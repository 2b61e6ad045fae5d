#pragma once

#include <string>

namespace slipscale {

/// What YAML 1.1 (and with it Python's yaml) takes a text for that stands in a file without quotes.
enum class PlainYaml {
  text,
  number,   ///< decimal: 5, -0.3, 1.5e+9
  flag,     ///< true, false, yes, no, on, off; in small letters, capitals, or with a capital first
  nothing,  ///< empty, ~, null
  other     ///< what nobody means: 010 (base 8), 0x1F, 1:30 (base 60), 1_000, .inf, a date
};
PlainYaml plain_yaml(const std::string& text);

/// In words that complete "which YAML takes for": "a number in base 8".
std::string plain_yaml_words(const std::string& text);

}  // namespace slipscale
