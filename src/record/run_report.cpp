#include <petscsys.h>

#include <algorithm>
#include <cmath>

#include "slipscale/base/log.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/base/readable.hpp"
#include "slipscale/dynamics/remarks.hpp"
#include "slipscale/files/yaml.hpp"
#include "slipscale/record/recorder.hpp"
#include "slipscale/version.hpp"
#include "summary.hpp"

namespace slipscale {
namespace {

/// Seconds of one step on the slowest rank: a step costs about 1.7 products of this mesh's own stiffness,
/// which is timed here (bulk arrays, damping and boundary nodes make up the rest).
double predicted_step_seconds(const SlidingBody& body) {
  const Model& model = body.model();
  NodalVector x(body.comm(), model.mesh.nodes, true);
  std::vector<Vector2> force(model.mesh.nodes.number.size());
  double best = 1e300;
  for (int repeat = 0; repeat < 5; ++repeat) {
    const auto start = std::chrono::steady_clock::now();
    model.multiply(x.data(), force.data());
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  MPI_Allreduce(MPI_IN_PLACE, &best, 1, MPI_DOUBLE, MPI_MAX, body.comm());
  return 1.7 * best;
}

double memory_of_all_ranks(MPI_Comm comm) {
  PetscLogDouble memory = 0;
  petsc(PetscMemoryGetCurrentUsage(&memory));
  MPI_Allreduce(MPI_IN_PLACE, &memory, 1, MPI_DOUBLE, MPI_SUM, comm);
  return memory;
}

}  // namespace

std::string Recorder::forecast() const {
  double frames = static_cast<double>(field_steps_.size());
  if (fields_every_) frames = rows(*fields_every_);
  double bytes = 0;
  if (history_) bytes += history_->series().bytes(rows(history_every_));
  if (contact_) bytes += contact_->series().bytes(rows(contact_every_));
  if (interfaces_file_) bytes += interfaces_file_->series().bytes(rows(interfaces_every_));
  if (fields_) bytes += fields_->bytes(frames);
  if (statistics_) bytes += statistics_->bytes();
  const double seconds = predicted_step_seconds(body_) * static_cast<double>(last_ + 1);
  const std::string kept =
      folder_.kept().empty()
          ? ""
          : format("the interrupted run that was in '{}' is kept: slide -restart {} goes on with it\n",
                   folder_.path(), folder_.kept());
  return kept +
         format("{} steps to {}, about {}, memory {}, output {} in '{}'\n", last_,
                engineering(static_cast<double>(last_) * time_.step, "s"), readable_duration(seconds),
                readable_bytes(memory_of_all_ranks(body_.comm())), readable_bytes(bytes), folder_.path()) +
         cadences() + (statistics_ ? statistics_->forecast(time_.step) : "") +
         (interfaces_ && !interfaces_->doubt().empty() ? "note: " + interfaces_->doubt() + "\n" : "");
}

std::string Recorder::cadences() const {
  const auto cadence = [&](long every) {
    return format("{} ({})", every == 1 ? "every step" : format("every {} steps", every),
                  engineering(static_cast<double>(every) * time_.step, "s"));
  };
  std::string text = "a row of history.h5 " + cadence(history_every_);
  if (has_contact_) text += ", of contact.h5 " + cadence(contact_every_);
  if (fields_every_) text += ", a frame of fields.h5 " + cadence(*fields_every_);
  if (interfaces_)
    text += ", of interfaces.h5 " + cadence(interfaces_every_) + ": " + interfaces_->describe();
  if (body_.keeps_cell_damping()) text += "; what bulk damping takes in each cell is summed at every step";
  return text + "\n";
}

void Recorder::write_run(const Options& options) const {
  const int ranks = ranks_of(body_.comm());
  const Model& model = body_.model();
  const auto facts = [&](Yaml& yaml) {
    const Mesh& mesh = model.mesh;
    yaml.text("program", "slide").text("version", version).integer("ranks", ranks);
    yaml.text("mesh_checksum", checksum_text(mesh.checksum), "of the mesh file");
    if (mesh.periodic[0] || mesh.periodic[1])
      yaml.text("periodic", std::string(mesh.periodic[0] ? "x" : "") + (mesh.periodic[1] ? "y" : ""));
    for (std::size_t k = 0; k < mesh.notes.size(); ++k)
      yaml.text(format("mesh_note_{}", k + 1), mesh.notes[k]);
    yaml.integer("nodes", mesh.nodes.total).integer("cells", mesh.cells.total);
    yaml.number("block_width", mesh.upper[0] - mesh.lower[0], "m")
        .number("block_height", mesh.upper[1] - mesh.lower[1], "m");
    yaml.number("largest_frequency", time_.frequency.sharp, "1/s, Lanczos");
    yaml.number("largest_frequency_bound", time_.frequency.safe, "1/s, largest element");
    yaml.integer("history_every", history_every_, "steps between the rows");
    if (interfaces_) yaml.integer("interfaces_every", interfaces_every_, "the same, of interfaces.h5");
    if (has_contact_) yaml.integer("contact_every", contact_every_, "the same; what `auto` stands for");
    yaml.exact("stable_step", time_.limit, "s").exact("step", time_.step, "s").integer("steps", time_.count);
    for (std::size_t r = 0; r < model.materials.size(); ++r) {
      const WaveSpeeds speeds = wave_speeds(model.materials[r], 0, 1);
      yaml.numbers("wave_speeds_" + mesh.regions[r].name, {speeds.fast, speeds.slow}, "m/s along y");
      if (const std::string& doubt = model.materials[r].doubt; !doubt.empty())
        yaml.text("doubt_" + mesh.regions[r].name, doubt);
    }
  };
  auto effective = options.effective();
  effective.erase("restart");
  folder_.write_text("run.yaml", run_yaml(effective, facts));
}

void Recorder::close_files() {
  progress_.finish();
  if (fields_) fields_->close();
  write_interfaces();
  for (SeriesFile* series : all_series()) series->close();
  share_faults();
}

/// While the series is open, for the times of its rows are read from it.
void Recorder::write_interfaces() {
  if (!interfaces_) return;
  std::string report, shown;
  if (interfaces_file_) {
    report = interfaces_file_->report();
    shown = interfaces_file_->xdmf("interfaces.h5");
    interfaces_headline_ = interfaces_file_->headline();
  }
  folder_.write_text("interfaces.yaml", report);
  folder_.write_text("interfaces.xdmf", shown);
}

std::string Recorder::finish() {
  static const LogEvent event("Summary");
  const LogEvent::Scope scope(event);
  close_files();
  if (statistics_) statistics_->write(folder_.path());
  return summary(last_, "", "");
}

std::string Recorder::interrupt(const std::string& why, const std::string& command) {
  close_files();
  return summary(body_.steps_done() - 1, why, command);
}

std::string Recorder::summary(long steps, const std::string& why, const std::string& command) {
  // Of an interrupted run neither the force at every step is complete, nor the velocity at the last one.
  const std::vector<double> force = why.empty() ? force_.gather() : std::vector<double>{};
  const Momentum momentum = why.empty() ? body_.momentum() : Momentum{};
  std::vector<std::string> remarks = remarks_at_start(body_);
  for (std::string& remark : remarks_at_end(body_)) remarks.push_back(std::move(remark));
  if (interfaces_ && !interfaces_->doubt().empty()) remarks.push_back(interfaces_->doubt());
  if (rounded_residual_ > 0)
    remarks.push_back(format(
        "rows in which the energy balance misses up to {:.2g} of what flowed are left out of the largest "
        "residual: displacements change by little more than their last digit there; take a larger "
        "-time_step, or start nearer to where the body goes",
        rounded_residual_));
  std::string text;
  if (is_root(body_.comm()))
    text = summary_text({body_, time_, rows_, observer_.measured(), history_every_, contact_every_, force,
                         largest_residual_, seconds(), std::move(remarks), momentum, steps, why, command,
                         static_cast<std::size_t>(position_.even_from), interfaces_headline_});
  folder_.write_text("summary.yaml", text);
  return text;
}

}  // namespace slipscale
