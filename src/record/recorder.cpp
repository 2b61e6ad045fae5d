#include "slipscale/record/recorder.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "slipscale/base/print.hpp"
#include "slipscale/contact/surface.hpp"
#include "slipscale/solid/mass.hpp"
#include "summary.hpp"

namespace slipscale {
namespace {

bool is_root(MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  return rank == 0;
}

/// Above this part of what flowed, energy has appeared from nowhere: rounding stays ten thousand times below
/// it.
constexpr double largest_sound_residual = 1e-6;

long whole_steps(double steps) {
  if (steps != std::floor(steps) || steps > 1e15)
    throw UserError(format("-contact_every is %g, but it must be auto or a whole number of steps", steps));
  return static_cast<long>(steps);
}

/// The steps at which frames are due, ascending.
std::vector<long> steps_of(const std::vector<double>& times, const TimeStep& time) {
  std::vector<long> steps;
  for (const double t : times) {
    const double n = std::round(t / time.step);
    if (!(n >= 0 && n <= static_cast<double>(time.count)))
      throw UserError(
          format("-fields_times: %g s lies outside the run, which goes from 0 to %g s; move the frame", t,
                 static_cast<double>(time.count) * time.step));
    steps.push_back(static_cast<long>(n));
  }
  std::sort(steps.begin(), steps.end());
  return steps;
}

}  // namespace

Schema record_schema() {
  return {
      {"output_folder", Kind::text, "", "out", range::any,
       "folder of the run; an older run in it is replaced"},
      {"history_every", Kind::integer, "1", "10", range::at_least_one,
       "steps between the rows of history.h5"},
      {"history_points", Kind::reals, "m", absent, range::any,
       "points x1,y1,x2,y2,... whose u, v and stress are followed"},
      {"contact_every", Kind::text, "1", "auto", range::one_of_or_number({"auto"}, range::at_least_one),
       "steps between the rows of contact.h5; auto makes about a thousand rows"},
      {"fields_every", Kind::integer, "1", absent, range::at_least_one,
       "steps between the frames of fields.h5"},
      {"fields_times", Kind::reals, "s", absent, range::any, "times of the frames, in place of fields_every"},
      {"fields_quantities", Kind::text, "", "u,v,stress", range::any,
       "what a frame holds: some of u,v,stress"},
      {"progress", Kind::text, "", "auto", range::one_of({"auto", "none"}),
       "auto shows a line of progress when the output is a terminal"},
      {"run_<entry>", Kind::text, "", absent, range::any,
       "facts that run.yaml carries; ignored when it is read again"},
  };
}

RecordChoice read_record(const Options& options) {
  RecordChoice choice;
  choice.folder = options.text("output_folder");
  choice.history_every = static_cast<long>(options.integer("history_every"));
  const auto points = options.reals("history_points");
  if (points.size() % 2 != 0)
    throw UserError("-history_points has an odd count of numbers; give x1,y1,x2,y2,... in m");
  for (std::size_t k = 0; k < points.size(); k += 2) choice.points.push_back({points[k], points[k + 1]});
  if (has_surface(options)) {
    const std::string contact = options.text("contact_every");
    if (contact != "auto") choice.contact_every = whole_steps(std::strtod(contact.c_str(), nullptr));
  } else {
    options.refuse_idle({"contact_every"}, without_surface);
  }
  options.refuse_both("fields_every", "fields_times");
  if (const auto every = options.find_integer("fields_every"))
    choice.fields_every = static_cast<long>(*every);
  choice.fields_times = options.reals("fields_times");
  if (choice.fields_every || !choice.fields_times.empty())
    choice.quantities = field_quantities(options.text("fields_quantities"));
  else
    options.refuse_idle({"fields_quantities"},
                        {"without -fields_every or -fields_times", "give one of them"});
  choice.progress = options.text("progress");
  return choice;
}

Recorder::Recorder(const SlidingBody& body, const RecordChoice& choice, const TimeStep& time)
    : body_(body),
      choice_(choice),
      time_(time),
      last_(time.count),
      history_every_(choice.history_every),
      has_contact_(body.scene().surface.has_value()),
      contact_every_(choice.contact_every ? *choice.contact_every : std::max(1L, time.count / 1000)),
      field_steps_(steps_of(choice.fields_times, time)),
      observer_(body),
      probes_(body.comm(), body.model(), choice.points),
      folder_(body.comm(), choice.folder,
              {"run.yaml", "summary.yaml", "history.h5", "contact.h5", "fields.h5", "fields.xdmf"}),
      progress_(choice.progress, 0, static_cast<double>(time.count) * time.step),
      start_(std::chrono::steady_clock::now()) {
  if (choice.fields_every || !field_steps_.empty())
    fields_ = std::make_unique<FieldsFile>(body.comm(), body.model().mesh, folder_.path(), choice.quantities);
  if (is_root(body.comm())) {
    history_ = std::make_unique<HistoryFile>(folder_.path("history.h5"), body, probes_.positions());
    if (has_contact_) contact_ = std::make_unique<ContactFile>(folder_.path("contact.h5"), observer_);
  }
  share_faults();
}

bool Recorder::fields_due(long n) const {
  if (choice_.fields_every) return n % *choice_.fields_every == 0 || n == last_;
  return std::binary_search(field_steps_.begin(), field_steps_.end(), n);
}

void Recorder::after_step(long n) {
  if (due(n)) observe(n);
  progress_.step(n, static_cast<double>(n) * body_.time_step());
}

void Recorder::observe(long n) {
  Observation seen = observer_.observe();
  check(seen);
  const auto readings = probes_.read(body_);
  if (contact_ && contact_due(n)) contact_->write(seen, body_.surface_velocity());
  if (history_ && (n % history_every_ == 0 || n == last_)) {
    history_->write(seen, readings);
    seen.contact.clear();
    rows_.push_back(seen);
  }
  if (fields_due(n)) write_fields();
  share_faults();
  const double relative = seen.energy.flowed > 0 ? std::abs(seen.energy.residual) / seen.energy.flowed : 0;
  largest_residual_ = std::max(largest_residual_, relative);
  progress_.note(seen.friction, relative);
}

void Recorder::write_fields() {
  const Model& model = body_.model();
  if (choice_.quantities.stress) cell_stress(model.mesh, model.materials, body_.displacement_n(), stress_);
  fields_->write(body_.time(), body_.displacement_n()->data(), body_.velocity()->data(),
                 stress_.empty() ? nullptr : stress_[0].data());
}

void Recorder::check(const Observation& seen) const {
  const Energy& e = seen.energy;
  const bool finite = std::isfinite(e.kinetic) && std::isfinite(e.strain) && std::isfinite(e.flowed);
  if (finite && std::abs(e.residual) <= largest_sound_residual * e.flowed) return;
  throw RunError(format("step %ld (t = %g s): ", seen.step, seen.time) +
                 (finite
                      ? format("the energy balance misses %g J/m of %g J/m that flowed", e.residual, e.flowed)
                      : std::string("the state is no longer finite")) +
                 "; the rows before it are kept in '" + folder_.path() + "'. Try a smaller -time_safety");
}

void Recorder::share_faults() {
  std::string fault;
  if (history_ && !history_->series().fault().empty()) fault = history_->series().fault();
  if (contact_ && !contact_->series().fault().empty()) fault = contact_->series().fault();
  throw_together(body_.comm(), fault);
}

}  // namespace slipscale
