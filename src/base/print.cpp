#include "slipscale/base/print.hpp"

#include <petscsys.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "slipscale/base/parallel.hpp"

namespace slipscale {
namespace {

/// Width on the screen: UTF-8 continuation bytes (the second of `µ`) take no column.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string padding(std::size_t wanted, const std::string& text) {
  return std::string(wanted > width(text) ? wanted - width(text) : 0, ' ');
}

/// A prefix before `m^2` would be squared too and `kg` has one already: such units get none.
bool takes_prefix(const std::string& unit) {
  const std::string first = unit.substr(0, unit.find_first_of("/* "));
  return !unit.empty() && unit != "1" && unit != "%" && first != "kg" &&
         first.find_first_of("^0123456789") == std::string::npos;
}

}  // namespace

void print(const std::string& text) {
  const int rank = rank_of(PETSC_COMM_WORLD == MPI_COMM_NULL ? MPI_COMM_WORLD : PETSC_COMM_WORLD);
  if (rank != 0) return;
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

void print_notes(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) print("note: " + note + "\n");
}

std::string one_line(const std::string& text) {
  // Next line, line separator and paragraph separator in UTF-8.
  static constexpr std::array<std::string_view, 3> breaks{"\xC2\x85", "\xE2\x80\xA8", "\xE2\x80\xA9"};
  std::string line;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const auto c = static_cast<unsigned char>(text[k]);
    const auto found = std::find_if(breaks.begin(), breaks.end(), [&](std::string_view each) {
      return text.compare(k, each.size(), each) == 0;
    });
    if (found != breaks.end()) {
      line += ' ';
      k += found->size() - 1;
    } else if (c == '\n' || c == '\r' || c == '\t') {
      line += ' ';
    } else if (c < 0x20 || c == 0x7F) {
      line += format("\\x{:02x}", c);
    } else {
      line += text[k];
    }
  }
  return line;
}

std::string table(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    if (row.size() > widths.size()) widths.resize(row.size(), 0);
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], width(row[k]));
  }
  std::string text;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::string line;
    for (std::size_t k = 0; k < rows[r].size(); ++k) {
      const std::string& cell = rows[r][k];
      if (k == 0)
        line += cell + padding(widths[0], cell);
      else
        line += "  " + padding(widths[k], cell) + cell;
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    if (r > 0) continue;
    for (std::size_t k = 0; k < widths.size(); ++k) text += (k ? "  " : "") + std::string(widths[k], '-');
    text += "\n";
  }
  return text;
}

std::string engineering(double value, const std::string& unit) {
  static constexpr std::array<const char*, 17> prefixes = {"y", "z", "a", "f", "p", "n", "µ", "m", "",
                                                           "k", "M", "G", "T", "P", "E", "Z", "Y"};
  const std::string tail = unit.empty() || unit == "1" ? "" : " " + unit;
  if (value == 0) return "0" + tail;
  if (!std::isfinite(value) || !takes_prefix(unit)) return format("{:.4g}", value) + tail;
  // The exponent of the value as it will be printed: 999.96 rounds to 1000, which is the next prefix.
  const std::string rounded = format("{:.3e}", value);
  const int exponent = std::stoi(rounded.substr(rounded.find('e') + 1));
  const int step = static_cast<int>(std::floor(exponent / 3.0));
  if (step < -8 || step > 8) return rounded + tail;
  const int decimals = 3 - (exponent - 3 * step);
  return format("{:.{}f}", value / std::pow(10.0, 3 * step), decimals) + " " +
         prefixes[static_cast<std::size_t>(step + 8)] + unit;
}

}  // namespace slipscale
