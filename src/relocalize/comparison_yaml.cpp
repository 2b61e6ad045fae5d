#include <functional>

#include "slipscale/base/print.hpp"
#include "slipscale/files/yaml.hpp"
#include "slipscale/relocalize/comparison_report.hpp"

namespace slipscale {
namespace {

constexpr std::array<const char*, 3> component_names{"xx", "yy", "xy"};
constexpr std::array<const char*, 3> source_names{"reference", "relocalised", "homogeneous"};

/// `write(part)` below the key of each part: all, layer, bulk and phases: <region>.
void for_parts(Yaml& yaml, const Comparison& comparison, const std::function<void(std::size_t part)>& write) {
  bool in_phases = false;
  for (std::size_t p = 0; p < comparison.parts.size(); ++p) {
    if (comparison.parts[p].phase && !in_phases) yaml.begin("phases");
    in_phases = comparison.parts[p].phase;
    yaml.begin(comparison.parts[p].name);
    write(p);
    yaml.end();
  }
  if (in_phases) yaml.end();
}

/// `write(component)` below xx, yy and xy.
void for_components(Yaml& yaml, const std::function<void(std::size_t component)>& write) {
  for (std::size_t i = 0; i < 3; ++i) {
    yaml.begin(component_names[i]);
    write(i);
    yaml.end();
  }
}

void write_errors(Yaml& yaml, const StressSums& sums) {
  for_components(yaml, [&](std::size_t i) {
    for (const auto source : {StressSource::relocalised, StressSource::homogeneous})
      yaml.number(source_names[source], sums.relative_error(source, i));
  });
}

void write_means(Yaml& yaml, const StressSums& sums) {
  for_components(yaml, [&](std::size_t i) {
    for (const auto source : {StressSource::reference, StressSource::relocalised, StressSource::homogeneous})
      yaml.number(source_names[source], sums.mean(source, i));
  });
}

void write_total(Yaml& yaml, const Comparison& found) {
  const auto total = over_frames(found);
  yaml.begin("area", "over that of all cells, 1");
  for_parts(yaml, found, [&](std::size_t p) { yaml.number("share", total[p].area / total.front().area); });
  yaml.end().begin("error", "relative L2 error over space and all frames");
  for_parts(yaml, found, [&](std::size_t p) { write_errors(yaml, total[p]); });
  yaml.end().begin("mean", "area average over all frames, Pa");
  for_parts(yaml, found, [&](std::size_t p) { write_means(yaml, total[p]); });
  yaml.end();
}

void write_quantiles(Yaml& yaml, const Comparison& found) {
  yaml.begin("quantiles", "by area of the cells, of the last frame, Pa");
  yaml.numbers("levels", found.levels);
  for_parts(yaml, found, [&](std::size_t p) {
    for_components(yaml, [&](std::size_t i) {
      for (std::size_t s = 0; s < StressSource::count; ++s)
        yaml.numbers(source_names[s], found.quantiles[p][s][i]);
    });
  });
  yaml.end();
}

void write_statistics(Yaml& yaml, const Comparison& found) {
  yaml.begin("statistics", "relative L2 error of statistics over time");
  for (const ComparedStatistic& statistic : found.statistics) {
    yaml.begin(statistic.name);
    for_parts(yaml, found, [&](std::size_t p) { write_errors(yaml, statistic.sums[p]); });
    yaml.end();
  }
  yaml.end();
}

void write_frames(Yaml& yaml, const Comparison& found) {
  yaml.begin("frames", "relative L2 error of each frame");
  yaml.numbers("time", found.time, "s");
  for_parts(yaml, found, [&](std::size_t p) {
    for_components(yaml, [&](std::size_t i) {
      for (const auto source : {StressSource::relocalised, StressSource::homogeneous}) {
        std::vector<double> errors;
        for (const auto& frame : found.frames) errors.push_back(frame[p].relative_error(source, i));
        yaml.numbers(source_names[source], errors);
      }
    });
  });
  yaml.end();
}

void write_probe(Yaml& yaml, const ComparedProbe& probe) {
  yaml.numbers("x", {probe.position[0], probe.position[1]}, "m");
  yaml.text("region", probe.region);
  for_components(yaml, [&](std::size_t i) {
    for (const auto source : {StressSource::relocalised, StressSource::homogeneous}) {
      const auto& found = (source == StressSource::relocalised ? probe.relocalised : probe.homogeneous)[i];
      yaml.begin(source_names[source]);
      yaml.number("correlation", found.correlation).number("slope", found.slope);
      yaml.number("error", found.relative_error).end();
    }
  });
}

}  // namespace

std::string comparison_yaml(const Comparison& comparison) {
  Yaml yaml;
  yaml.remark(
      "stress of the homogeneous run, with and without relocalisation, against the heterogeneous run");
  yaml.text("reference", comparison.reference);
  yaml.number("layer", comparison.zones.layer, "m, depth from the contact");
  yaml.number("bulk", comparison.zones.bulk, "m, distance from every edge");
  for (std::size_t k = 0; k < comparison.notes.size(); ++k) {
    if (k == 0) yaml.begin("notes");
    yaml.text(format("note_{}", k + 1), comparison.notes[k]);
    if (k + 1 == comparison.notes.size()) yaml.end();
  }
  if (!comparison.frames.empty()) write_total(yaml, comparison);
  if (!comparison.quantiles.empty()) write_quantiles(yaml, comparison);
  if (!comparison.statistics.empty()) write_statistics(yaml, comparison);
  if (!comparison.frames.empty()) write_frames(yaml, comparison);
  if (comparison.probes.empty()) return yaml.str();
  yaml.begin("probes", "histories against those of the heterogeneous run");
  for (std::size_t k = 0; k < comparison.probes.size(); ++k) {
    yaml.begin(std::to_string(k));
    write_probe(yaml, comparison.probes[k]);
    yaml.end();
  }
  return yaml.end().str();
}

}  // namespace slipscale
