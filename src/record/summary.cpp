#include "summary.hpp"

#include <algorithm>
#include <cmath>

#include "slipscale/base/print.hpp"
#include "slipscale/base/readable.hpp"
#include "slipscale/files/yaml.hpp"
#include "slipscale/record/averages.hpp"
#include "slipscale/record/spectrum.hpp"
#include "slipscale/version.hpp"

namespace slipscale {
namespace {

constexpr std::size_t peaks_listed = 3;
constexpr double still = 1e-9;  ///< of the mean normal force: what varies less is constant to rounding

/// The rows over which averages are taken.
class Window {
 public:
  explicit Window(const SummaryInput& in) : rows_(in.rows) {
    std::vector<double> times;
    for (const Observation& row : rows_) times.push_back(row.time);
    from_ = std::max(default_window(times), in.even_from);
  }

  double begin() const { return rows_[from_].time; }
  double end() const { return rows_.back().time; }
  std::size_t size() const { return rows_.size() - from_; }

  template <class Value>
  std::vector<double> values(Value&& value) const {
    std::vector<double> found;
    for (std::size_t k = from_; k < rows_.size(); ++k) found.push_back(value(rows_[k]));
    return found;
  }

 private:
  const std::vector<Observation>& rows_;
  std::size_t from_ = 0;
};

/// A mean and, beside it, `<name>_error`.
void write_average(Yaml& yaml, const std::string& name, const Average& average, const std::string& comment) {
  yaml.number(name, average.value, comment);
  if (!std::isnan(average.error)) yaml.number(name + "_error", average.error);
}

/// Frequencies of which the rows of history.h5 tell, and which of them are not what they seem.
void write_spectrum(Yaml& yaml, const SummaryInput& in, std::vector<double> signal, double normal) {
  const auto [lowest, highest] = std::ranges::minmax(signal);
  if (!(highest - lowest > still)) {
    yaml.remark("no frequency: the tangential force is constant to rounding");
    return;
  }
  // The last row may come early; the others are evenly spaced.
  if (signal.size() > 2 && (in.rows.back().step % in.history_every) != 0) signal.pop_back();
  const double interval = static_cast<double>(in.history_every) * in.time.step;
  const Spectrum spectrum = welch(signal, interval);
  const std::vector<Peak> found = peaks(spectrum, peaks_listed);
  if (found.empty()) return;
  std::vector<double> frequencies;
  for (const Peak& peak : found) frequencies.push_back(peak.frequency);
  yaml.numbers("spectrum_peaks", frequencies, "Hz, of tangential over mean normal force, strongest first");
  yaml.number("spectrum_resolution", spectrum.step, "Hz");
  if (const double dominant = dominant_frequency(spectrum); dominant > 0)
    yaml.number("dominant_frequency", dominant, "Hz");
  else
    yaml.remark("no dominant frequency: what varies most is slower than the window can tell");

  std::vector<double> dense;
  for (const double force : in.force) dense.push_back(force / normal);
  const Spectrum all = welch(dense, in.time.step);
  const std::vector<Alias> wrong = aliases(found, 1 / interval, all);
  if (wrong.empty()) return;
  std::string text;
  for (const Alias& alias : wrong)
    text += format("{}{} may be an alias of {}", text.empty() ? "" : ", ", engineering(alias.recorded, "Hz"),
                   engineering(alias.source, "Hz"));
  yaml.text("aliases",
            text + format(": a row every {} shows nothing above {}; give a smaller -history_every or "
                          "-history_interval",
                          engineering(interval, "s"), engineering(0.5 / interval, "Hz")));
}

/// Writes the load, and returns friction and its amplitude; zero without load.
std::pair<double, double> write_load(Yaml& yaml, const SummaryInput& in, const Window& window) {
  const auto load = [&](const Observation& row) { return row.boundaries[in.measured]; };
  const auto normal = window.values([&](const auto& row) { return load(row).normal; });
  const auto tangential = window.values([&](const auto& row) { return load(row).tangential; });
  yaml.begin("load", "at boundary " + in.body.scene().measured);
  const Average mean_normal = mean_of(normal);
  write_average(yaml, "mean_normal_force", mean_normal, "N/m");
  write_average(yaml, "mean_tangential_force", mean_of(tangential), "N/m");
  std::vector<double> signal;
  const Average friction = ratio_of_means(tangential, normal);
  if (mean_normal.value != 0) {
    for (const double force : tangential) signal.push_back(force / mean_normal.value);
    write_average(yaml, "mean_friction", friction, "mean tangential over mean normal force");
    yaml.number("amplitude", deviation_of(signal), "standard deviation of tangential over mean normal force");
    const Settling found = settling(signal);
    yaml.line("settled", found.settled ? "true" : "false",
              "whether the second half of the window is like the first");
    yaml.number("drift", found.drift, "of the mean, from the first half of the window to the second");
    yaml.number("amplitude_ratio", found.amplitude_ratio,
                "amplitude of the second half over that of the first");
  }
  yaml.end();
  if (signal.empty()) return {0, 0};
  write_spectrum(yaml, in, signal, mean_normal.value);
  return {friction.value, deviation_of(signal)};
}

void write_contact(Yaml& yaml, const Window& window, std::pair<double, double> friction) {
  const auto mean = [&](auto&& value) { return mean_of(window.values(value)); };
  const Average stick = mean([](const auto&row) { return row.stick; }),
                open = mean([](const auto&row) { return row.open; }),
                drive = mean([](const auto&row) { return row.drive_power; }),
                into = mean([](const auto&row) { return row.power_into_body; });
  yaml.begin("contact");
  yaml.text("regime",
            regime(stick.value, open.value, friction.second, friction.first,
                   drive.value != 0 ? into.value / drive.value : 0),
            "names of Peillex, Baillet, Berthier, IJTC2007-44438");
  write_average(yaml, "stick", stick, "part of the boundary's length");
  write_average(yaml, "slip", mean([](const auto& row) { return row.slip; }), "");
  write_average(yaml, "open", open, "");
  write_average(yaml, "drive_power", drive, "W/m");
  write_average(yaml, "power_into_body", into, "W/m");
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

void write_window(Yaml& yaml, const SummaryInput& in, const Window& window) {
  const auto interval = [&](long every) { return static_cast<double>(every) * in.time.step; };
  yaml.number("averages_from", window.begin(), "s").number("averages_to", window.end(), "s");
  yaml.integer("averages_rows", static_cast<std::int64_t>(window.size()), "of history.h5");
  yaml.integer("averages_blocks", error_blocks, "of them, from whose scatter the errors come");
  yaml.number("history_interval", interval(in.history_every), "s between the rows of history.h5");
  if (in.body.scene().surface)
    yaml.number("contact_interval", interval(in.contact_every), "s between the rows of contact.h5");
}

}  // namespace

std::string summary_text(const SummaryInput& in) {
  const auto nodes = static_cast<double>(in.body.model().mesh.nodes.total);
  const Window window(in);
  Yaml yaml;
  yaml.remark("Headline numbers of a slide run; averages are over the second half of the run, with standard");
  yaml.remark("errors from blocks of it.");
  yaml.text("version", version);
  yaml.text("state", in.why.empty() ? "finished" : "interrupted");
  if (!in.why.empty()) {
    yaml.text("interrupted_by", in.why);
    yaml.text("go_on_with", in.command);
  }
  yaml.number("simulated_time", static_cast<double>(in.steps) * in.time.step, "s");
  yaml.integer("steps", in.steps);
  yaml.number("step", in.time.step, "s");
  yaml.number("step_over_stable_step", in.time.step / in.time.limit);
  write_window(yaml, in, window);
  std::pair<double, double> friction{0, 0};
  if (in.measured >= 0) friction = write_load(yaml, in, window);
  if (in.body.scene().surface) write_contact(yaml, window, friction);
  write_energy(yaml, in);
  if (!in.interfaces.empty()) yaml.text("interfaces", in.interfaces, "all peaks: interfaces.yaml");
  if (in.why.empty()) write_momentum(yaml, in);
  for (std::size_t k = 0; k < in.remarks.size(); ++k) {
    if (k == 0) yaml.begin("notes");
    yaml.text("note_" + std::to_string(k + 1), in.remarks[k]);
    if (k + 1 == in.remarks.size()) yaml.end();
  }
  yaml.begin("cost");
  yaml.number("wall_time", in.seconds, "s, of the steps and their output");
  yaml.number("ns_per_node_and_step", 1e9 * in.seconds / (nodes * static_cast<double>(in.steps + 1)));
  yaml.end();
  return yaml.str();
}

}  // namespace slipscale
