#include "slipscale/record/estimate.hpp"

#include <array>
#include <cmath>

#include "mesh_group.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

constexpr double per_dataset = 16384 + 2000;  // the last, partly filled chunk; headers and attributes
constexpr double per_frame = 8000;            // groups, headers and attributes; the mesh's too

}  // namespace

double series_bytes(double rows, double row_bytes, int datasets) {
  return rows * row_bytes + datasets * per_dataset;
}

double fields_bytes(double frames, std::int64_t points, std::int64_t cells,
                    const FieldQuantities& quantities) {
  const double vector = 3 * sizeof(double);
  const double frame = (quantities.u + quantities.v) * vector * static_cast<double>(points) +
                       (quantities.stress + quantities.strain) * vector * static_cast<double>(cells) +
                       per_frame;
  return frames * frame + mesh_bytes(static_cast<double>(points), static_cast<double>(cells)) + per_frame;
}

double statistics_bytes(std::int64_t points, std::int64_t cells) {
  const double tensors = 2 * (6 * 3 + 6) * sizeof(double);
  return tensors * static_cast<double>(cells) +
         mesh_bytes(static_cast<double>(points), static_cast<double>(cells)) + 4 * per_frame;
}

std::string readable_bytes(double bytes) {
  static constexpr std::array<const char*, 6> units = {"B", "kB", "MB", "GB", "TB", "PB"};
  std::size_t unit = 0;
  while (bytes >= 999.5 && unit + 1 < units.size()) {
    bytes /= 1000;
    ++unit;
  }
  return format(unit == 0 || bytes >= 99.95 ? "%.0f %s"
                : bytes >= 9.995            ? "%.1f %s"
                                            : "%.2f %s",
                bytes, units[unit]);
}

std::string readable_duration(double seconds) {
  if (!std::isfinite(seconds)) return "?";
  if (seconds < 9.95) return format("%.1f s", seconds);
  const auto whole = std::llround(seconds);
  if (whole < 60) return format("%lld s", whole);
  if (whole < 3600) return format("%lld min %02lld s", whole / 60, whole % 60);
  if (whole < 86400) return format("%lld h %02lld min", whole / 3600, whole % 3600 / 60);
  return format("%lld d %lld h", whole / 86400, whole % 86400 / 3600);
}

}  // namespace slipscale
