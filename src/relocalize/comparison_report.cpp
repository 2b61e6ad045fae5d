#include "slipscale/relocalize/comparison_report.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

using Rows = std::vector<std::vector<std::string>>;

/// The pressed direction first.
constexpr std::array<std::pair<std::size_t, const char*>, 3> components{
    {{1, "σ_yy"}, {0, "σ_xx"}, {2, "σ_xy"}}};
constexpr auto reference = StressSource::reference, relocalised = StressSource::relocalised,
               homogeneous = StressSource::homogeneous;

std::string error_text(double error) {
  if (std::isnan(error)) return "-";
  return error > 0 && error < 1e-3 ? format("{:.1e}", error) : format("{:.4f}", error);
}

std::string mpa(double pascal) { return std::isnan(pascal) ? "-" : format("{:.4g}", 1e-6 * pascal); }

std::string change(double before, double after) {
  if (std::isnan(before) && std::isnan(after)) return "-";
  return error_text(before) + " → " + error_text(after);
}

/// How many times smaller relocalisation makes the error.
std::string gain(const StressSums& sums, std::size_t component) {
  const double before = sums.relative_error(homogeneous, component),
               after = sums.relative_error(relocalised, component);
  if (std::isnan(before) || std::isnan(after)) return "-";
  if (after == 0) return before > 0 ? "exact" : "-";
  return format("{:.2f}{}", before / after, before < after ? " WORSE" : "");
}

std::string short_label(const BlockPart& part) { return (part.phase ? "phase " : "") + part.name; }

std::string label(const BlockPart& part, const BlockZones& zones) {
  if (part.phase || part.name == "all") return short_label(part);
  if (part.name == "layer") return "layer (" + engineering(zones.layer, "m") + " at the contact)";
  return "bulk (" + engineering(zones.bulk, "m") + " off the edges)";
}

std::string frames_text(const Comparison& found) {
  std::string text = found.frames.size() == 1 ? "one frame, " : format("{} frames, ", found.frames.size());
  text += engineering(found.time.front(), "s");
  return found.frames.size() == 1 ? text : text + " to " + engineering(found.time.back(), "s");
}

/// Smallest and largest error of single frames over the whole block.
std::string single_frames_text(const Comparison& found, std::size_t component) {
  if (found.frames.size() < 2) return "";
  const auto range = [&](StressSource::Index source) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const auto& frame : found.frames) {
      const double error = frame.front().relative_error(source, component);
      if (std::isnan(error)) continue;
      low = std::min(low, error);
      high = std::max(high, error);
    }
    return low > high ? std::string("-") : error_text(low) + " to " + error_text(high);
  };
  return "single frames, all: homogeneous " + range(homogeneous) + ", relocalised " + range(relocalised) +
         "\n";
}

std::string errors_text(const Comparison& found, const std::vector<StressSums>& total) {
  std::string text =
      "relative L2 error against " + found.reference + " over space and time, " + frames_text(found) + "\n\n";
  for (const auto& [component, name] : components) {
    Rows rows{{name, "area", "homogeneous", "relocalised", "gain"}};
    for (std::size_t p = 0; p < total.size(); ++p)
      rows.push_back(
          {label(found.parts[p], found.zones), format("{:.1f} %", 100 * total[p].area / total.front().area),
           error_text(total[p].relative_error(homogeneous, component)),
           error_text(total[p].relative_error(relocalised, component)), gain(total[p], component)});
    text += table(rows) + single_frames_text(found, component) + "\n";
  }
  return text;
}

std::string averages_text(const Comparison& found, const std::vector<StressSums>& total) {
  Rows rows{{"average [MPa]", "", "heterogeneous", "relocalised", "homogeneous"}};
  for (const auto& [component, name] : components)
    for (std::size_t p = 0; p < total.size(); ++p)
      if (found.parts[p].phase || p == 0)
        rows.push_back({name, short_label(found.parts[p]), mpa(total[p].mean(reference, component)),
                        mpa(total[p].mean(relocalised, component)),
                        mpa(total[p].mean(homogeneous, component))});
  return table(rows) + "\n";
}

std::string quantiles_text(const Comparison& found) {
  if (found.quantiles.empty()) return "";
  Rows rows{{"quantile of σ_yy [MPa]", "", "heterogeneous", "relocalised", "homogeneous"}};
  for (std::size_t p = 0; p < found.parts.size(); ++p)
    for (std::size_t q = 0; q < found.levels.size(); ++q) {
      const auto of = [&](StressSource::Index source) { return mpa(found.quantiles[p][source][1][q]); };
      rows.push_back({short_label(found.parts[p]), format("{:g} %", 100 * found.levels[q]), of(reference),
                      of(relocalised), of(homogeneous)});
    }
  return table(rows) + "by area of the cells, at " + engineering(found.time.back(), "s") + "\n\n";
}

std::string statistics_text(const Comparison& found) {
  if (found.statistics.empty()) return "";
  std::string text = "statistics over time: relative L2 error, homogeneous → relocalised\n\n";
  for (const auto& [component, name] : components) {
    Rows rows{{name}};
    for (const BlockPart& part : found.parts) rows.front().push_back(short_label(part));
    for (const ComparedStatistic& statistic : found.statistics) {
      rows.push_back({statistic.name});
      for (const StressSums& sums : statistic.sums)
        rows.back().push_back(
            change(sums.relative_error(homogeneous, component), sums.relative_error(relocalised, component)));
    }
    text += table(rows) + "\n";
  }
  return text;
}

std::string probes_text(const Comparison& found) {
  if (found.probes.empty()) return "";
  Rows rows{{"σ_yy over time at [mm]", "phase", "correlation", "slope", "relative L2 error"}};
  for (const ComparedProbe& probe : found.probes) {
    const HistoryAgreement &before = probe.homogeneous[1], &after = probe.relocalised[1];
    rows.push_back({format("{:.4g}, {:.4g}", 1e3 * probe.position[0], 1e3 * probe.position[1]), probe.region,
                    change(before.correlation, after.correlation), change(before.slope, after.slope),
                    change(before.relative_error, after.relative_error)});
  }
  return table(rows) + "homogeneous → relocalised; slope of the regression line over the heterogeneous run\n";
}

}  // namespace

std::vector<StressSums> over_frames(const Comparison& comparison) {
  std::vector<StressSums> total(comparison.parts.size());
  for (const auto& frame : comparison.frames)
    for (std::size_t p = 0; p < total.size(); ++p) total[p] += frame[p];
  return total;
}

std::string describe(const Comparison& comparison) {
  std::string text;
  if (!comparison.frames.empty()) {
    const auto total = over_frames(comparison);
    text += errors_text(comparison, total) + averages_text(comparison, total) + quantiles_text(comparison);
  }
  return text + statistics_text(comparison) + probes_text(comparison);
}

}  // namespace slipscale
