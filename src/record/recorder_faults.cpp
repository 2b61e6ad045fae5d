// The part of Recorder that tells a sound run from one that has gone astray, and ends that.
#include <algorithm>
#include <cmath>

#include "astray.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/record/recorder.hpp"

namespace slipscale {
namespace {

/// Above this part of what flowed, energy has appeared from nowhere: rounding stays ten thousand times below
/// it, but where next to nothing flows in a body that is displaced far (see rounding_of_balance).
constexpr double largest_sound_residual = 1e-6;

}  // namespace

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

/// Of what flowed.
double Recorder::note_residual(const Energy& energy) {
  const double relative = energy.flowed > 0 ? std::abs(energy.residual) / energy.flowed : 0;
  double& largest = relative > largest_sound_residual ? rounded_residual_ : largest_residual_;
  largest = std::max(largest, relative);
  return relative;
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
