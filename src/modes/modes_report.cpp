#include "slipscale/modes/modes_report.hpp"

#include <cmath>
#include <functional>
#include <numbers>

#include "slipscale/base/print.hpp"
#include "slipscale/files/hdf5.hpp"
#include "slipscale/files/yaml.hpp"
#include "slipscale/version.hpp"

namespace slipscale {
namespace {

double frequency_of(const SlidingMode& mode) { return mode.exponent.imag() / (2 * std::numbers::pi); }

std::string tenfold_text(const ReportedMode& mode) {
  const auto time = mode.time_to_tenfold();
  return time ? engineering(*time, "s") : "-";
}

void write_mode(Yaml& yaml, const ModesReport& report, const ReportedMode& each) {
  yaml.exact("frequency", each.frequency(), "Hz").exact("growth_rate", each.growth_rate(), "1/s");
  yaml.exact("damping_ratio", each.damping_ratio());
  if (const auto time = each.time_to_tenfold())
    yaml.exact("time_to_tenfold", *time, "s");
  else
    yaml.line("time_to_tenfold", "null", "it decays");
  yaml.exact("near_contact_energy", each.measures.near_contact,
             "of the strain energy, within a tenth of the height of the surface");
  yaml.begin("friction_work", "J/m over a period, of a mode that carries 1 J/m, by region");
  for (std::size_t r = 0; r < report.regions.size(); ++r)
    yaml.exact(report.regions[r], each.measures.friction_work[r]);
  yaml.end();
  yaml.exact("residual", each.mode.residual, "on the whole body, relative");
  if (!each.scheme) return;
  yaml.begin("scheme", "of the time scheme");
  yaml.exact("frequency", frequency_of(*each.scheme), "Hz");
  yaml.exact("growth_rate", each.scheme->exponent.real(), "1/s");
  yaml.exact("residual", each.scheme->residual).end();
}

/// Numbers that are read back to 12 digits.
std::string list(const std::vector<double>& values) {
  std::string text;
  for (const double value : values)
    text += (text.empty() ? "" : ", ") + (std::isfinite(value) ? format("{:.11e}", value) : ".nan");
  return "[" + text + "]";
}

std::vector<double> parts(const ModePath& path, bool frequency) {
  std::vector<double> found;
  for (const Complex& p : path.exponent)
    found.push_back(frequency ? p.imag() / (2 * std::numbers::pi) : p.real());
  return found;
}

/// A list of mappings: the first line of each begins with a dash.
std::string as_list_item(const std::string& text, int depth) {
  const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
  std::string lines;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = text.find('\n', begin);
    lines += indent + (begin == 0 ? "- " : "  ") + text.substr(begin, end - begin) + "\n";
    begin = end + 1;
  }
  return lines;
}

/// `write` makes the lines of each item.
std::string list_of(const std::string& key, std::size_t count, int depth,
                    const std::function<void(Yaml& item, std::size_t k)>& write) {
  std::string text(static_cast<std::size_t>(2 * (depth - 1)), ' ');
  text += key + (count == 0 ? ": []\n" : ":\n");
  for (std::size_t k = 0; k < count; ++k) {
    Yaml item;
    write(item, k);
    text += as_list_item(item.str(), depth);
  }
  return text;
}

std::string sweep_yaml(const ModesSweep& sweep) {
  std::string text = "  " + sweep.choice.name + ":\n";
  text += "    values: " + list(sweep.choice.values) + "  # " + sweep.choice.unit + "\n";
  text += "    basis: " + std::to_string(sweep.basis) + "\n";
  text += "    found_on_the_whole_body_at: " + list(sweep.places) + "\n";
  text += format("    largest_residual: {:.2e}\n", sweep.worst);
  text += "    same_contact: " + list(sweep.same_contact) +
          "  # first and last value at which the same nodes touch\n";
  text += list_of("becomes_unstable", sweep.limits.size(), 3, [&](Yaml& item, std::size_t k) {
    const StabilityLimit& limit = sweep.limits[k];
    item.exact("value", limit.value, sweep.choice.unit).exact("frequency", limit.frequency, "Hz");
    item.integer("path", static_cast<std::int64_t>(limit.path + 1));
    item.text("beyond", limit.grows ? "grows" : "decays");
  });
  text += list_of("couples", sweep.couplings.size(), 3, [&](Yaml& item, std::size_t k) {
    const Coupling& coupling = sweep.couplings[k];
    item.exact("value", coupling.value, sweep.choice.unit).exact("frequency", coupling.frequency, "Hz");
    item.line("paths", format("[{}, {}]", coupling.paths[0] + 1, coupling.paths[1] + 1), "");
    item.exact("distance", coupling.distance, "relative");
  });
  return text + list_of("paths", sweep.paths.size(), 3, [&](Yaml& item, std::size_t k) {
           item.line("growth_rate", list(parts(sweep.paths[k], false)), "1/s");
           item.line("frequency", list(parts(sweep.paths[k], true)), "Hz");
           item.line("residual", list(sweep.paths[k].residual), "");
         });
}

}  // namespace

double ReportedMode::frequency() const { return frequency_of(mode); }
double ReportedMode::growth_rate() const { return mode.exponent.real(); }
double ReportedMode::damping_ratio() const { return -mode.exponent.real() / std::abs(mode.exponent); }
std::optional<double> ReportedMode::time_to_tenfold() const {
  if (!(growth_rate() > 0)) return std::nullopt;
  return std::numbers::ln10 / growth_rate();
}

std::string describe(const ModesReport& report, const SteadySliding& state) {
  std::string text = format(
      "steady sliding: {} nodes touch the surface, {} are open; normal force {}, friction {} ({} rounds)\n",
      state.in_contact, state.open, engineering(state.normal_force, "N/m"),
      engineering(state.tangential_force, "N/m"), state.rounds);
  text += format("{} unknowns; {} real modes to start from, {} vectors at the end ({} rounds, {} solves)\n",
                 report.unknowns, report.basis_start, report.basis_end, report.search.rounds,
                 report.search.solves);
  std::vector<std::vector<std::string>> rows{{"mode", "frequency [Hz]", "growth [1/s]", "damping ratio",
                                              "tenfold in", "near contact", "friction work", "residual"}};
  if (report.step) rows[0].insert(rows[0].begin() + 3, {"scheme: frequency", "growth"});
  for (std::size_t k = 0; k < report.modes.size(); ++k) {
    const ReportedMode& each = report.modes[k];
    std::string work;
    for (const double part : each.measures.friction_work)
      work += (work.empty() ? "" : " + ") + format("{:.4g}", part);
    rows.push_back({std::to_string(k + 1), format("{:.8g}", each.frequency()),
                    format("{:.6g}", each.growth_rate()), format("{:.4g}", each.damping_ratio()),
                    tenfold_text(each), format("{:.3f}", each.measures.near_contact), work,
                    format("{:.1e}", each.mode.residual)});
    if (!report.step) continue;
    std::vector<std::string> scheme{"-", "-"};
    if (each.scheme)
      scheme = {format("{:.8g}", frequency_of(*each.scheme)), format("{:.6g}", each.scheme->exponent.real())};
    rows.back().insert(rows.back().begin() + 3, scheme.begin(), scheme.end());
  }
  text += table(rows);
  std::string names;
  for (const std::string& region : report.regions) names += (names.empty() ? "" : " + ") + region;
  text += "friction work: J/m over a period of a mode that carries 1 J/m, in " + names + "\n";
  for (const ModesSweep& sweep : report.sweeps) text += "\n" + describe(sweep);
  return text;
}

std::string modes_yaml(const ModesReport& report, const SteadySliding& state, const Mesh& mesh,
                       const std::map<std::string, std::string>& effective) {
  Yaml head;
  head.remark("Modes of steady sliding: u e^(pt), growth rate Re p, frequency Im p/2 pi.");
  head.begin("state");
  head.integer("nodes_in_contact", state.in_contact).integer("nodes_open", state.open);
  head.exact("normal_force", state.normal_force, "N/m")
      .exact("tangential_force", state.tangential_force, "N/m, of friction on the body along +x");
  head.end();
  std::string text = head.str();
  text += "# growth rate descending, one of each conjugate pair\n";
  text += list_of("modes", report.modes.size(), 1,
                  [&](Yaml& item, std::size_t k) { write_mode(item, report, report.modes[k]); });
  if (!report.sweeps.empty()) {
    text += "sweeps:\n";
    for (const ModesSweep& sweep : report.sweeps) text += sweep_yaml(sweep);
  }
  Yaml tail;
  tail.begin("search");
  tail.integer("modes_in_window", static_cast<std::int64_t>(report.search.in_window),
               "up to the highest frequency");
  tail.integer("unknowns", report.unknowns).integer("real_modes", report.basis_start);
  tail.integer("basis", report.basis_end).integer("rounds", report.search.rounds);
  tail.exact("friction_time", report.time, "s, T of the surface's full speed");
  if (report.step) tail.exact("time_step", *report.step, "s, of the scheme");
  tail.number("seconds", report.seconds).number("memory", report.memory, "B, of all ranks");
  for (std::size_t k = 0; k < report.search.notes.size(); ++k)
    tail.text(format("note_{}", k + 1), report.search.notes[k]);
  tail.end();
  tail.begin("run").text("program", "modes").text("version", version).integer("ranks", report.ranks);
  tail.text("mesh_checksum", checksum_text(mesh.checksum), "of the mesh file");
  tail.integer("nodes", mesh.nodes.total).integer("cells", mesh.cells.total).end();
  tail.begin("options", "in effect");
  for (const auto& [option, value] : effective) tail.text(option, value);
  return text + tail.end().str();
}

}  // namespace slipscale
