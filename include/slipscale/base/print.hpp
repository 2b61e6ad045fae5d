#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

namespace slipscale {

/// Prints to standard output on rank 0 of PETSC_COMM_WORLD and flushes.
void print(const std::string& text);

/// Prints each on a line of its own behind `note: `: what was made of the input, for the user to see.
void print_notes(const std::vector<std::string>& notes);

/// The text with everything that begins a new line, in any alphabet, as a blank and other control characters
/// as \x1b: what a name of the user may hold.
std::string one_line(const std::string& text);

/// Values into a text: `format("{:.3g} m", length)`. libfmt's, which checks the pattern when it is compiled;
/// the standard library's std::format takes the same patterns.
using fmt::format;

/// Columns padded to their widest cell, two spaces apart, the first row underlined as the heading. The first
/// column is flush left, the others flush right.
std::string table(const std::vector<std::vector<std::string>>& rows);

/// A quantity with an SI prefix and its unit, three or four digits: `engineering(3.2e-9, "s")` is "3.200 ns".
std::string engineering(double value, const std::string& unit);

}  // namespace slipscale
