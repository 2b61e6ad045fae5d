#include "slipscale/record/recorder.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "astray.hpp"
#include "slipscale/base/log.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/base/provenance.hpp"
#include "slipscale/base/yaml_text.hpp"
#include "slipscale/record/stress_measures.hpp"
#include "slipscale/solid/stress.hpp"
#include "summary.hpp"

namespace slipscale {
namespace {

/// Above this part of what flowed, energy has appeared from nowhere: rounding stays ten thousand times below
/// it, but where next to nothing flows in a body that is displaced far (see rounding_of_balance).
constexpr double largest_sound_residual = 1e-6;

/// The steps at which frames are due, ascending.
std::vector<long> steps_of(const std::vector<double>& times, const TimeStep& time) {
  std::vector<long> steps;
  for (const double t : times) {
    const double n = std::round(t / time.step);
    if (!(n >= 0 && n <= static_cast<double>(time.count)))
      throw UserError(
          format("-fields_times: {:g} s lies outside the run, which goes from 0 to {:g} s; move the frame", t,
                 static_cast<double>(time.count) * time.step));
    steps.push_back(static_cast<long>(n));
  }
  std::sort(steps.begin(), steps.end());
  return steps;
}

/// A restart keeps the window that the run began with, for its samples are counted beforehand.
std::optional<StatisticsWindow> window_of(const RecordChoice& choice, const TimeStep& time,
                                          const Restart* restart) {
  if (!choice.statistics) return std::nullopt;
  if (restart) {
    const RunPosition& at = restart->position();
    return StatisticsWindow{static_cast<long>(at.window_first), static_cast<long>(at.window_last),
                            static_cast<long>(at.window_every)};
  }
  return statistics_window(*choice.statistics, time);
}

/// The choice, once it is sure that the box it may have holds a part of the body, and that there is damping
/// where it asks for its work. Collective.
const RecordChoice& checked(const SlidingBody& body, const RecordChoice& choice) {
  if (choice.cell_damping() && !body.keeps_cell_damping())
    throw UserError(
        std::string(choice.quantities.damping_work ? "-fields_quantities has damping_work"
                                                   : "-statistics_damping is true") +
        ", but nothing damps the body; give -damping_stiffness or -damping_mass, or leave it out");
  if (!choice.fields_box) return choice;
  const Mesh& mesh = body.model().mesh;
  const auto inside = cells_in(mesh.cells, *choice.fields_box);
  int found = std::find(inside.begin(), inside.end(), 1) != inside.end();
  MPI_Allreduce(MPI_IN_PLACE, &found, 1, MPI_INT, MPI_MAX, body.comm());
  if (!found)
    throw UserError(
        format("-fields_box holds the centre of no cell of the body, which spans x {:g} to {:g} m and y {:g} "
               "to {:g} "
               "m; move or widen it",
               mesh.lower[0], mesh.upper[0], mesh.lower[1], mesh.upper[1]));
  return choice;
}

/// σ_zz/(σ_xx + σ_yy) of each local cell, for frames that need it.
std::vector<double> transverse_of_cells(const Model& model, const RecordChoice& choice) {
  if (!choice.quantities.stress && !choice.quantities.von_mises) return {};
  std::vector<double> of_region;
  for (const Material& material : model.materials) of_region.push_back(transverse_ratio(material));
  std::vector<double> of_cell;
  std::string fault;
  for (int cell = 0; cell < model.mesh.cells.size(); ++cell) {
    const int region = model.mesh.cells.region[cell];
    const Solid solid = model.materials[region].at(cell);
    const bool graded = model.materials[region].grading != nullptr;
    of_cell.push_back(graded ? transverse_ratio({solid.stiffness, solid.density, ""}) : of_region[region]);
    if (fault.empty() && choice.quantities.von_mises && std::isnan(of_cell.back()))
      fault = "-fields_quantities has von_mises, but the stiffness of region '" +
              model.mesh.regions[region].name +
              "' is not isotropic and does not tell the stress across the plane; leave von_mises out";
  }
  throw_together(model.mesh.comm, fault);
  return of_cell;
}

/// About a thousand rows, or what the run before a restart made of that, whatever its end is now.
long thousand_rows(double by_itself, double before, const TimeStep& time) {
  return by_itself != 0 ? static_cast<long>(before) : std::max(1L, time.count / 1000);
}

/// Whether the force of every step is kept beside rows that are sparser: from the start on, or not at all.
bool keeps_force(const RunPosition& before, long history_every, bool goes_on) {
  if (history_every <= 1) return false;
  return !goes_on || (before.force_kept != 0 && before.history_every == static_cast<double>(history_every));
}

/// Start, process and a clock's last digits. Collective.
std::string new_run() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return text_on_all(format("{} {} {}", provenance().date, getpid(), now.count() % 1000000000));
}

std::vector<std::string> files_of_a_run() {
  return {"run.yaml",        "summary.yaml",      "history.h5",        "contact.h5",
          "fields.h5",       "fields.xdmf",       "statistics.h5",     "statistics.xdmf",
          "fault.h5",        "fault.xdmf",        "interfaces.h5",     "interfaces.xdmf",
          "interfaces.yaml", checkpoint_names[0], checkpoint_names[1], checkpoint_next};
}

Eigen::Matrix3d compliance(const Eigen::Matrix3d& stiffness) {
  return stiffness.llt().solve(Eigen::Matrix3d::Identity());
}

/// Of each region, 1/Pa.
std::vector<Eigen::Matrix3d> compliances(const std::vector<Material>& materials) {
  std::vector<Eigen::Matrix3d> found;
  for (const Material& material : materials) found.push_back(compliance(material.stiffness));
  return found;
}

}  // namespace

Recorder::Recorder(const SlidingBody& body, const RecordChoice& choice, const TimeStep& time,
                   const Restart* restart)
    : body_(body),
      choice_(checked(body, choice)),
      run_(restart ? restart->run() : new_run()),
      position_(restart ? restart->position() : RunPosition{}),
      time_(time),
      last_(time.count),
      history_every_(choice.history.steps(time.step, 1)),
      has_contact_(body.scene().surface.has_value()),
      contact_every_(choice.contact.steps(
          time.step, thousand_rows(position_.contact_auto, position_.contact_every, time))),
      interfaces_every_(choice.interface_rows.steps(
          time.step, thousand_rows(position_.interfaces_auto, position_.interfaces_every, time))),
      fields_every_(choice.fields.given() ? std::optional(choice.fields.steps(time.step, 1)) : std::nullopt),
      field_steps_(steps_of(choice.fields_times, time)),
      transverse_(transverse_of_cells(body.model(), choice)),
      window_(window_of(choice, time, restart)),
      observer_(body, choice.momentum),
      probes_(body.comm(), body.model(), choice.points),
      interfaces_(choice.interfaces ? std::make_unique<InterfaceRecord>(body, *choice.interfaces) : nullptr),
      keeps_force_(keeps_force(position_, history_every_, restart != nullptr)),
      force_(body, keeps_force_ ? observer_.measured() : -1, time.count),
      folder_(body.comm(), choice.folder, restart ? std::vector<std::string>{} : files_of_a_run(), can_go_on),
      compliance_(compliances(body.model().materials)),
      progress_(choice.progress, restart ? static_cast<double>(restart->steps_done()) * time.step : 0,
                static_cast<double>(time.count) * time.step),
      start_(std::chrono::steady_clock::now()) {
  open_files(restart);
  if (restart) go_on(*restart);
  share_faults();
}

void Recorder::open_files(const Restart* restart) {
  const MPI_Comm comm = body_.comm();
  const Mesh& mesh = body_.model().mesh;
  const auto continued = [&](double rows) {
    return restart ? std::optional(SeriesFile::Continue{static_cast<hsize_t>(rows)}) : std::nullopt;
  };
  if (fields_every_ || !field_steps_.empty()) {
    std::optional<std::size_t> frames;
    if (position_.frames > 0) frames = static_cast<std::size_t>(position_.frames);
    fields_ = std::make_unique<FieldsFile>(comm, MeshImage(comm, mesh, choice_.fields_box), folder_.path(),
                                           choice_.quantities, "fields", transverse_, frames);
  }
  if (window_)
    statistics_ = std::make_unique<StressStatistics>(comm, mesh, *window_, choice_.statistics->quantile,
                                                     choice_.statistics->damping);
  if (is_root(comm)) {
    history_ = std::make_unique<HistoryFile>(folder_.path("history.h5"), body_, probes_.positions(),
                                             choice_.momentum, rows(history_every_),
                                             continued(position_.history_rows));
    if (has_contact_)
      contact_ = std::make_unique<ContactFile>(folder_.path("contact.h5"), observer_, mesh.region_names(),
                                               choice_.contact_sums, rows(contact_every_),
                                               continued(position_.contact_rows));
    if (interfaces_)
      interfaces_file_ = std::make_unique<InterfacesFile>(
          folder_.path("interfaces.h5"), interfaces_->inclusions(), *choice_.interfaces,
          std::vector<std::string>{""}, rows(interfaces_every_), continued(position_.interface_rows));
  }
  const std::string checksum = checksum_text(mesh.checksum);
  if (fields_) fields_->about("run", run_);
  for (SeriesFile* series : all_series()) {
    series->about("mesh_checksum", checksum);
    series->about("run", run_);
  }
}

std::vector<SeriesFile*> Recorder::all_series() const {
  std::vector<SeriesFile*> found;
  if (history_) found.push_back(&history_->series());
  if (contact_) found.push_back(&contact_->series());
  if (interfaces_file_) found.push_back(&interfaces_file_->series());
  return found;
}

bool Recorder::fields_due(long n) const {
  if (fields_every_) return n % *fields_every_ == 0 || n == last_;
  return std::binary_search(field_steps_.begin(), field_steps_.end(), n);
}

void Recorder::after_step(long n) {
  {
    static const LogEvent event("ForceRecord");
    const LogEvent::Scope scope(event);
    force_.add(n);
  }
  if (observes(n) != Observed::nothing) observe(n);
  static const LogEvent event("Progress");
  const LogEvent::Scope scope(event);
  progress_.step(n, static_cast<double>(n) * body_.time_step());
}

void Recorder::observe(long n) {
  const bool row = row_due(n), bulk = bulk_due(n);
  static const LogEvent observation("Observation"), writing("Writing");
  std::optional<LogEvent::Scope> scope(observation);
  Observation seen = observer_.observe(bulk);
  if (bulk) check(seen);
  const auto readings = row ? probes_.read(body_) : std::vector<ProbeReading>{};
  scope.emplace(writing);
  if (contact_ && contact_due(n)) contact_->write(seen, body_.surface_velocity());
  if (history_ && row) {
    history_->write(seen, readings);
    seen.contact.clear();
    rows_.push_back(seen);
  }
  record_interfaces(n);
  record_cells(n);
  share_faults();
  if (!bulk) return;
  last_sound_ = n;
  const double relative = seen.energy.flowed > 0 ? std::abs(seen.energy.residual) / seen.energy.flowed : 0;
  double& largest = relative > largest_sound_residual ? rounded_residual_ : largest_residual_;
  largest = std::max(largest, relative);
  progress_.note(seen.friction, relative);
}

void Recorder::record_interfaces(long n) {
  if (interfaces_due(n)) {
    const auto forces = interfaces_->forces();
    if (interfaces_file_) interfaces_file_->write(body_.time(), {forces});
  }
  if (precedes_interfaces(n)) interfaces_->keep_past();
}

void Recorder::record_cells(long n) {
  const bool frame = fields_due(n), sample = statistics_due(n);
  if (!frame && !sample) return;
  const Model& model = body_.model();
  const Cells& cells = model.mesh.cells;
  const bool strain = sample || choice_.quantities.strain;
  if (strain || choice_.quantities.of_stress())
    cell_stress(model.mesh, model.materials, body_.displacement_n(), stress_);
  if (strain) strain_.resize(stress_.size());
  for (int cell = 0; strain && cell < cells.size(); ++cell) {
    const int region = cells.region[cell];
    const auto stress = Eigen::Vector3d::Map(stress_[cell].data());
    auto found = Eigen::Vector3d::Map(strain_[cell].data());
    if (model.materials[region].grading)
      found = compliance(model.materials[region].at(cell).stiffness) * stress;
    else
      found = compliance_[region] * stress;
  }
  if ((frame && choice_.quantities.damping_work) || (sample && statistics_->damping()))
    body_.cell_damping(damping_);
  const auto rows = [](const auto& values) { return values.empty() ? nullptr : values[0].data(); };
  if (frame) {
    fields_->write(body_.time(), body_.displacement_n()->data(), body_.velocity_n()->data(), rows(stress_),
                   rows(strain_), damping_.data());
    last_frame_ = n;
  }
  if (sample) statistics_->add(body_.time(), stress_, strain_, damping_);
}

void Recorder::check(const Observation& seen) const {
  const Energy& e = seen.energy;
  if (!body_.formulas_sound()) {
    std::string names;
    for (const std::string& name : unsteady_formulas(body_.scene()))
      names += (names.empty() ? "-" : ", -") + name;
    stop(format(
             "step {} (t = {:g} s): a formula has made what is no number, or none that its option may have: "
             "one of {}",
             seen.step, seen.time, names),
         "See what it makes at all times up to that one");
  }
  const bool finite = std::isfinite(e.kinetic) && std::isfinite(e.strain) && std::isfinite(e.flowed);
  if (finite && std::abs(e.residual) <= largest_sound_residual * e.flowed) return;
  if (finite && std::abs(e.residual) <= rounding_of_balance(body_)) return;
  const Astray why = explain(e, most_displaced(body_), time_, history_every_);
  stop(format("step {} (t = {:g} s): ", seen.step, seen.time) + why.fault, why.cure);
}

void Recorder::stop(const std::string& fault, const std::string& cure) const {
  std::string kept = last_sound_ < 0 ? "nothing was recorded before it"
                                     : format("what was recorded up to step {}", last_sound_);
  if (last_frame_ >= 0) kept += format(", with a last frame of step {},", last_frame_);
  if (last_sound_ >= 0) kept += " is kept in '" + folder_.path() + "'";
  if (statistics_ && statistics_->samples() > 0) {
    kept += format(", and the statistics of {} samples", statistics_->samples());
    try {
      statistics_->write(folder_.path());
    } catch (const RunError& error) {
      kept = error.what();
    }
  }
  try {
    const MPI_Comm comm = body_.comm();
    FieldsFile state(comm, MeshImage(comm, body_.model().mesh), folder_.path(), {true, true, false}, "fault");
    state.write(body_.time(), body_.displacement_n()->data(), body_.velocity_n()->data(), nullptr);
    state.close();
    kept += ", and the state of this step is in '" + folder_.path("fault.xdmf") + "'";
  } catch (const RunError& error) {
    kept = error.what();
  }
  throw RunError(fault + "; " + kept + ". " + cure);
}

void Recorder::share_faults() {
  std::string fault;
  for (const SeriesFile* series : all_series())
    if (!series->fault().empty()) fault = series->fault();
  stop_together(body_.comm(), fault);
}

}  // namespace slipscale
