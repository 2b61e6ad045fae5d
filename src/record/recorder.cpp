#include "slipscale/record/recorder.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "slipscale/base/log.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/base/provenance.hpp"
#include "slipscale/base/yaml_text.hpp"
#include "summary.hpp"

namespace slipscale {
namespace {

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

/// Of each local cell, for frames that need it.
std::vector<double> transverse_of(const SlidingBody& body, const FieldQuantities& quantities) {
  if (!quantities.stress && !quantities.von_mises) return {};
  return transverse_of_cells(body.model(), quantities.von_mises);
}

/// Steps between rows that nobody chose: about a thousand rows, and in a short run no more than one in 25
/// steps, so that they cost little of it; or what the run before a restart made of that, whatever its end is
/// now.
long by_itself(double before_by_itself, double before, const TimeStep& time) {
  constexpr long rows = 1000, least = 25;
  return before_by_itself != 0 ? static_cast<long>(before) : std::max(least, time.count / rows);
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
      contact_every_(
          choice.contact.steps(time.step, by_itself(position_.contact_auto, position_.contact_every, time))),
      interfaces_every_(choice.interface_rows.steps(
          time.step, by_itself(position_.interfaces_auto, position_.interfaces_every, time))),
      fields_every_(choice.fields.given() ? std::optional(choice.fields.steps(time.step, 1)) : std::nullopt),
      field_steps_(steps_of(choice.fields_times, time)),
      transverse_(transverse_of(body, choice.quantities)),
      window_(window_of(choice, time, restart)),
      observer_(body, choice.momentum),
      probes_(body.comm(), body.model(), choice.points),
      interfaces_(choice.interfaces ? std::make_unique<InterfaceRecord>(body, *choice.interfaces) : nullptr),
      keeps_force_(keeps_force(position_, history_every_, restart != nullptr)),
      force_(body, keeps_force_ ? observer_.measured() : -1, time.count),
      folder_(body.comm(), choice.folder, restart ? std::vector<std::string>{} : files_of_a_run(), can_go_on),
      cells_(body),
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
  progress_.note(seen.friction, note_residual(seen.energy));
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
  const FieldQuantities& quantities = choice_.quantities;
  cells_.make(sample || quantities.of_stress(), sample || quantities.strain,
              (frame && quantities.damping_work) || (sample && statistics_->damping()));
  const auto rows = [](const auto& values) { return values.empty() ? nullptr : values[0].data(); };
  if (frame) {
    fields_->write(body_.time(), body_.displacement_n()->data(), body_.velocity_n()->data(),
                   rows(cells_.stress()), rows(cells_.strain()), cells_.damping().data());
    last_frame_ = n;
  }
  if (sample) statistics_->add(body_.time(), cells_.stress(), cells_.strain(), cells_.damping());
}

}  // namespace slipscale
