#include "slipscale/base/readable.hpp"

#include <array>
#include <cmath>

#include "slipscale/base/print.hpp"

namespace slipscale {

std::string readable_bytes(double bytes) {
  static constexpr std::array<const char*, 6> units = {"B", "kB", "MB", "GB", "TB", "PB"};
  std::size_t unit = 0;
  while (bytes >= 999.5 && unit + 1 < units.size()) {
    bytes /= 1000;
    ++unit;
  }
  const int decimals = unit == 0 || bytes >= 99.95 ? 0 : bytes >= 9.995 ? 1 : 2;
  return format("{:.{}f} {}", bytes, decimals, units[unit]);
}

std::string readable_duration(double seconds) {
  if (!std::isfinite(seconds)) return "?";
  if (seconds < 9.95) return format("{:.1f} s", seconds);
  const auto whole = std::llround(seconds);
  if (whole < 60) return format("{} s", whole);
  if (whole < 3600) return format("{} min {:02} s", whole / 60, whole % 60);
  if (whole < 86400) return format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
  return format("{} d {} h", whole / 86400, whole % 86400 / 3600);
}

}  // namespace slipscale
