#include <petscsys.h>

#include <algorithm>
#include <cmath>

#include "slipscale/base/print.hpp"
#include "slipscale/base/readable.hpp"
#include "slipscale/dynamics/remarks.hpp"
#include "slipscale/files/yaml.hpp"
#include "slipscale/record/recorder.hpp"
#include "slipscale/version.hpp"
#include "summary.hpp"

namespace slipscale {
namespace {

int rank_of(MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  return rank;
}

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

std::string hexadecimal(std::uint64_t value) {
  return format("{:016x}", static_cast<unsigned long long>(value));
}

}  // namespace

std::string Recorder::forecast() const {
  const auto rows = [&](long every) { return static_cast<double>(last_ / every + 1); };
  double frames = static_cast<double>(field_steps_.size());
  if (choice_.fields_every) frames = rows(*choice_.fields_every);
  double bytes = 0;
  if (history_) bytes += rows(history_every_) * static_cast<double>(history_->series().row_bytes());
  if (contact_) bytes += rows(contact_every_) * static_cast<double>(contact_->series().row_bytes());
  if (fields_) bytes += fields_->bytes(frames);
  if (statistics_) bytes += statistics_->bytes();
  const double seconds = predicted_step_seconds(body_) * static_cast<double>(last_ + 1);
  return format("{} steps to {}, about {}, memory {}, output {} in '{}'\n", last_,
                engineering(static_cast<double>(last_) * time_.step, "s"), readable_duration(seconds),
                readable_bytes(memory_of_all_ranks(body_.comm())), readable_bytes(bytes), folder_.path()) +
         (statistics_ ? statistics_->forecast(time_.step) : "");
}

void Recorder::write_run(const Options& options) const {
  int ranks = 1;
  MPI_Comm_size(body_.comm(), &ranks);
  const Model& model = body_.model();
  const auto facts = [&](Yaml& yaml) {
    const Mesh& mesh = model.mesh;
    yaml.text("program", "slide").text("version", version).integer("ranks", ranks);
    yaml.text("mesh_checksum", "fnv1a:" + hexadecimal(mesh.checksum), "of the mesh file");
    yaml.integer("nodes", mesh.nodes.total).integer("cells", mesh.cells.total);
    yaml.number("block_width", mesh.upper[0] - mesh.lower[0], "m")
        .number("block_height", mesh.upper[1] - mesh.lower[1], "m");
    yaml.number("largest_frequency", time_.frequency.sharp, "1/s, Lanczos");
    yaml.number("largest_frequency_bound", time_.frequency.safe, "1/s, largest element");
    yaml.exact("stable_step", time_.limit, "s").exact("step", time_.step, "s").integer("steps", time_.count);
    for (std::size_t r = 0; r < model.materials.size(); ++r) {
      const WaveSpeeds speeds = wave_speeds(model.materials[r], 0, 1);
      yaml.numbers("wave_speeds_" + mesh.regions[r].name, {speeds.fast, speeds.slow}, "m/s along y");
    }
  };
  folder_.write_text("run.yaml", run_yaml(options.effective(), facts));
}

std::string Recorder::finish() {
  progress_.finish();
  if (fields_) fields_->close();
  if (history_) history_->series().close();
  if (contact_) contact_->series().close();
  share_faults();
  if (statistics_) statistics_->write(folder_.path());
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  std::vector<std::string> remarks = remarks_at_start(body_);
  for (std::string& remark : remarks_at_end(body_)) remarks.push_back(std::move(remark));
  const Momentum momentum = body_.momentum();
  std::string text;
  if (rank_of(body_.comm()) == 0)
    text = summary_text({body_, time_, rows_, observer_.measured(), history_every_, largest_residual_,
                         seconds, std::move(remarks), momentum});
  folder_.write_text("summary.yaml", text);
  return text;
}

}  // namespace slipscale
