#include "slipscale/record/hints.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

/// Vibration that is damped by less than this over the whole run is not damped.
constexpr double nothing = 1e-3;
constexpr double worth_saying = 1.0;  ///< s; shorter outputs matter to nobody
constexpr double large_part = 0.1;    ///< of the run
constexpr double far_below = 0.5;     ///< of the limit
constexpr double least_edges = 2;     ///< that the memory has to span; one is marginal

bool same(const Material& one, const Material& other) {
  return !one.grading && !other.grading && one.stiffness == other.stiffness && one.density == other.density;
}

/// Two regions that could be one.
std::string given_twice(const Model& model) {
  for (std::size_t r = 1; r < model.materials.size(); ++r)
    for (std::size_t s = 0; s < r; ++s)
      if (same(model.materials[r], model.materials[s]))
        return "regions '" + model.mesh.regions[s].name + "' and '" + model.mesh.regions[r].name +
               "' have the same material: nothing happens at their interface, and a block without it, of "
               "equal cells, takes longer steps (-shape none of morphology)";
  return "";
}

/// The fastest wave of the mesh is damped most by the stiffness part; by the mass part all are alike.
std::string idle_damping(const SlidingBody& body, const TimeStep& step) {
  const Damping& damping = body.scene().damping;
  const double end = static_cast<double>(step.count) * step.step;
  const double frequency = step.frequency.sharp;
  std::string names;
  if (damping.stiffness > 0 && 0.5 * damping.stiffness * frequency * frequency * end < nothing)
    names = format("-damping_stiffness {:g} s", damping.stiffness);
  if (damping.mass > 0 && 0.5 * damping.mass * end < nothing)
    names += (names.empty() ? "" : " and ") + format("-damping_mass {:g} 1/s", damping.mass);
  if (names.empty()) return "";
  return names +
         " takes less than a thousandth off any vibration until the end, and each step pays for it; "
         "leave it out, or give more";
}

std::string small_step(const TimeStep& step) {
  if (!(step.step < far_below * step.limit) || step.count < 2) return "";
  return format(
      "the step is {:.3g} of the stable one, so that {:.3g} times the steps are made of what "
      "-time_safety 0.9 takes; slipscale plan tells what a shorter step gains",
      step.step / step.limit, 0.9 * step.limit / step.step);
}

double longest_edge(const SlidingBody& body) {
  double longest = 0;
  for (const BoundaryEdge& edge : body.model().mesh.find_boundary(body.scene().surface->boundary)->edges)
    longest = std::max(longest, std::hypot(edge.outward[0], edge.outward[1]));
  MPI_Allreduce(MPI_IN_PLACE, &longest, 1, MPI_DOUBLE, MPI_MAX, body.comm());
  return longest;
}

struct Memory {
  double time = 0;    ///< T, s; the shortest
  double length = 0;  ///< c_s T with the slowest shear waves along the contact's normal, m
  double edge = 0;    ///< the longest of the contact, m
};

/// All zero without friction that remembers. Collective.
Memory memory_of(const SlidingBody& body) {
  if (!body.scene().surface || !body.scene().friction.remembers()) return {};
  const double time = shortest_memory(body.scene().friction, body.scene().surface->speed);
  if (!(time > 0) || !std::isfinite(time)) return {};
  double slowest = std::numeric_limits<double>::infinity();
  for (const Material& material : body.model().materials)
    slowest = std::min(slowest, wave_speeds(material, 0, 1).slow);
  return {time, slowest * time, longest_edge(body)};
}

std::string short_memory(const SlidingBody& body) {
  const Memory memory = memory_of(body);
  // Shorter than a step it is a remark already.
  if (memory.time < body.time_step() || memory.length >= least_edges * memory.edge) return "";
  return format("friction's memory spans {:.2g} edges of the contact (c_s T = ",
                memory.length / memory.edge) +
         engineering(memory.length, "m") + ", edges of up to " + engineering(memory.edge, "m") +
         "): below two a wave of the mesh grows that a finer mesh does not show; give edges of at most " +
         engineering(memory.length / least_edges, "m") + ", or -friction_time " +
         format("{:.3g}", memory.time * least_edges * memory.edge / memory.length);
}

/// Of all that is recorded again and again: "fields.h5", and how often.
struct Output {
  std::string file;
  const Cadence& cadence;
};
std::vector<Output> outputs_of(const RecordChoice& record) {
  return {{"history.h5", record.history},
          {"contact.h5", record.contact},
          {"interfaces.h5", record.interface_rows},
          {"fields.h5", record.fields}};
}

/// What is recorded more seldom than once in a run has two rows that look like findings.
std::string rows_apart(const TimeStep& step, const RecordChoice& record) {
  std::string files;
  for (const auto& [file, cadence] : outputs_of(record))
    if (cadence.given() && cadence.steps(step.step, 1) > step.count)
      files += (files.empty() ? "" : ", ") + file + " (-" +
               (cadence.interval ? cadence.option + format(" {:g} s)", *cadence.interval)
                                 : cadence.option.substr(0, cadence.option.rfind('_')) +
                                       format("_every {} steps)", *cadence.every));
  if (files.empty()) return "";
  return "nothing between start and end is recorded in " + files + ", as the run has " +
         format("{} steps to {:g} s; give less, or a later -time_end", step.count,
                static_cast<double>(step.count) * step.step);
}

long contact_nodes(const SlidingBody& body) {
  auto count = static_cast<long>(body.contact().node.size());
  MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPI_LONG, MPI_SUM, body.comm());
  return count;
}

std::string dear_outputs(const SlidingBody& body, const TimeStep& step, const RecordChoice& record) {
  long nodes = body.model().mesh.nodes.owned;
  MPI_Allreduce(MPI_IN_PLACE, &nodes, 1, MPI_LONG, MPI_SUM, body.comm());
  int ranks = 1;
  MPI_Comm_size(body.comm(), &ranks);
  const OutputCosts cost =
      output_costs(static_cast<double>(nodes) / ranks, static_cast<double>(contact_nodes(body)));
  const auto steps = static_cast<double>(step.count);
  const auto rows = [&](const Cadence& cadence, double otherwise) {
    return cadence.given() ? steps / static_cast<double>(cadence.steps(step.step, 1)) : otherwise;
  };
  const double frames =
      record.fields.given() ? rows(record.fields, 0) : static_cast<double>(record.fields_times.size());
  const double history = rows(record.history, 0) * cost.history;
  const double contact = rows(record.contact, std::min(steps, 1000.0)) * cost.contact;
  const double interfaces =
      record.interfaces ? rows(record.interface_rows, std::min(steps, 1000.0)) * cost.interfaces : 0;
  const double fields = frames * cost.fields, all = history + contact + fields + interfaces;
  const double part = all / (all + steps * cost.step);
  if (all < worth_saying || part <= large_part) return "";
  const double most = std::max({history, contact, fields, interfaces});
  const std::string which = most == history   ? "history.h5, fewer rows with -history_every"
                            : most == contact ? "contact.h5, fewer rows with -contact_every"
                            : most == fields  ? "fields.h5, fewer frames with -fields_every"
                                              : "interfaces.h5, fewer rows with -interfaces_every";
  return format("outputs take about {:.0f} % of the run, most of it {}", 100 * part, which);
}

}  // namespace

OutputCosts output_costs(double nodes, double contact_nodes) {
  return {5e-9 * nodes, 12e-6 + 7e-9 * nodes, 5e-6 + 0.25e-6 * contact_nodes, 0.7e-3 + 3e-7 * nodes,
          30e-6 + 30e-9 * nodes};
}

std::vector<std::string> hints_at_start(const SlidingBody& body, const TimeStep& step,
                                        const RecordChoice& record) {
  std::vector<std::string> found{
      given_twice(body.model()), idle_damping(body, step),         small_step(step),
      short_memory(body),        dear_outputs(body, step, record), rows_apart(step, record)};
  std::erase(found, "");
  return found;
}

std::string describe_memory(const SlidingBody& body) {
  const Memory memory = memory_of(body);
  if (!(memory.length > 0)) return "";
  return "friction's memory: c_s T = " + engineering(memory.length, "m") +
         format(", {:.3g} of the contact's longest edge\n", memory.length / memory.edge);
}

}  // namespace slipscale
