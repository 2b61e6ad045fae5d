#include "summary.hpp"

#include <algorithm>
#include <cmath>

#include "slipscale/files/yaml.hpp"
#include "slipscale/record/spectrum.hpp"
#include "slipscale/version.hpp"

namespace slipscale {
namespace {

template <class Value>
double mean(const std::vector<Observation>& rows, std::size_t from, Value&& value) {
  double sum = 0;
  for (std::size_t k = from; k < rows.size(); ++k) sum += value(rows[k]);
  return rows.size() > from ? sum / static_cast<double>(rows.size() - from) : 0;
}

/// Mean tangential over mean normal load, never the mean of the ratio, which runs away when the body lifts
/// off.
void write_friction(Yaml& yaml, const SummaryInput& in, std::size_t from) {
  const auto load = [&](const Observation& row) { return row.boundaries[in.measured]; };
  const double normal = mean(in.rows, from, [&](const auto& row) { return load(row).normal; });
  const double tangential = mean(in.rows, from, [&](const auto& row) { return load(row).tangential; });
  yaml.begin("load", "at boundary " + in.body.scene().measured);
  yaml.number("mean_normal_force", normal, "N/m");
  yaml.number("mean_tangential_force", tangential, "N/m");
  if (normal != 0)
    yaml.number("mean_friction", tangential / normal, "mean tangential over mean normal force");
  yaml.end();
  if (normal == 0) return;

  std::vector<double> signal;
  for (std::size_t k = from; k < in.rows.size(); ++k) signal.push_back(load(in.rows[k]).tangential / normal);
  // The last row may come early; the others are evenly spaced.
  if (signal.size() > 2 && (in.rows.back().step % in.history_every) != 0) signal.pop_back();
  const Spectrum spectrum = welch(signal, static_cast<double>(in.history_every) * in.time.step);
  std::vector<double> frequencies;
  for (const Peak& peak : peaks(spectrum, 3)) frequencies.push_back(peak.frequency);
  if (!frequencies.empty())
    yaml.numbers("spectrum_peaks", frequencies, "Hz, of tangential over mean normal force, strongest first");
}

void write_contact(Yaml& yaml, const SummaryInput& in, std::size_t from) {
  yaml.begin("contact");
  yaml.number("stick", mean(in.rows, from, [](const auto& row) { return row.stick; }),
              "part of the boundary's length");
  yaml.number("slip", mean(in.rows, from, [](const auto& row) { return row.slip; }));
  yaml.number("open", mean(in.rows, from, [](const auto& row) { return row.open; }));
  yaml.number("drive_power", mean(in.rows, from, [](const auto& row) { return row.drive_power; }), "W/m");
  yaml.number("power_into_body", mean(in.rows, from, [](const auto& row) { return row.power_into_body; }),
              "W/m");
  yaml.end();
}

void write_energy(Yaml& yaml, const SummaryInput& in) {
  const Energy& e = in.rows.back().energy;
  yaml.begin("energy", "J/m at the end; works and losses since t = 0");
  for (const EnergyTerm& term : energy_terms)
    if (term.value != &Energy::flowed) yaml.number(term.name, e.*term.value);
  yaml.number("largest_relative_residual", in.largest_residual, "of what flowed, over all rows");
  yaml.end();
}

void write_momentum(Yaml& yaml, const SummaryInput& in) {
  const Momentum& momentum = in.momentum;
  yaml.begin("body", "at the end, per metre of depth");
  yaml.number("mass", momentum.mass, "kg/m");
  yaml.numbers("momentum", {momentum.linear[0], momentum.linear[1]}, "x, y, kg/s");
  yaml.number("angular_momentum", momentum.angular,
              "kg m/s, about the middle of the block, counter-clockwise");
  yaml.end();
}

}  // namespace

std::string summary_text(const SummaryInput& in) {
  const double end = static_cast<double>(in.time.count) * in.time.step;
  const auto window = std::find_if(in.rows.begin(), in.rows.end(),
                                   [&](const Observation& row) { return row.time >= 0.5 * end; });
  const auto from = static_cast<std::size_t>(window - in.rows.begin());
  const auto nodes = static_cast<double>(in.body.model().mesh.nodes.total);
  Yaml yaml;
  yaml.remark("Headline numbers of a slide run; averages are over the second half of the run.");
  yaml.text("version", version);
  yaml.number("simulated_time", end, "s");
  yaml.integer("steps", in.time.count);
  yaml.number("step", in.time.step, "s");
  yaml.number("step_over_stable_step", in.time.step / in.time.limit);
  yaml.number("averages_from", in.rows[from].time, "s");
  if (in.measured >= 0) write_friction(yaml, in, from);
  if (in.body.scene().surface) write_contact(yaml, in, from);
  write_energy(yaml, in);
  write_momentum(yaml, in);
  for (std::size_t k = 0; k < in.remarks.size(); ++k) {
    if (k == 0) yaml.begin("notes");
    yaml.text("note_" + std::to_string(k + 1), in.remarks[k]);
    if (k + 1 == in.remarks.size()) yaml.end();
  }
  yaml.begin("cost");
  yaml.number("wall_time", in.seconds, "s, of the steps and their output");
  yaml.number("ns_per_node_and_step", 1e9 * in.seconds / (nodes * static_cast<double>(in.time.count + 1)));
  yaml.end();
  return yaml.str();
}

}  // namespace slipscale
