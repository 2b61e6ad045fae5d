#pragma once

#include <optional>
#include <string>
#include <vector>

#include "slipscale/base/options.hpp"

/// What a user typed after an option, turned into numbers and flags. The whole text must be used up.
namespace slipscale::value {

std::optional<double> number(const std::string& text);  ///< finite; no text left over
std::optional<PetscInt> integer(const std::string& text);
std::optional<bool> truth(const std::string& text);       ///< true, false, yes, no, on, off, 1, 0
std::vector<std::string> items(const std::string& text);  ///< of a comma-separated list; none when empty

/// Whether a decimal number is printed again as it was written: 1.5 and 12 are, 1.50, +12 and 1.0e3 are not.
bool printed_alike(const std::string& text);

/// What the option wants, as it reads after "it must be": "a number > 0 (Pa)".
std::string wanted(const Option& option);

/// Throws `UserError` when `text` is not what the option wants; `name` is the option as the user wrote it.
void check(const Option& option, const std::string& name, const std::string& text);

}  // namespace slipscale::value
