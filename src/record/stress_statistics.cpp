#include "slipscale/record/stress_statistics.hpp"

#include <algorithm>
#include <cmath>

#include "slipscale/base/error.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/base/readable.hpp"
#include "slipscale/files/statistics_file.hpp"

namespace slipscale {
namespace {

long step_at(const std::string& option, double t, const TimeStep& time) {
  const double n = std::round(t / time.step);
  if (!(n >= 0 && n <= static_cast<double>(time.count)))
    throw UserError(format("-{}: {:g} s lies outside the run, which goes from 0 to {:g} s; move the window",
                           option, t, static_cast<double>(time.count) * time.step));
  return static_cast<long>(n);
}

std::vector<int> owned_cells(const Cells& cells) {
  std::vector<int> owned;
  for (int cell = 0; cell < cells.size(); ++cell)
    if (cells.owned[cell]) owned.push_back(cell);
  return owned;
}

}  // namespace

std::size_t StatisticsWindow::samples() const {
  const long none = first > 0 ? (first - 1) / every + 1 : 0;  // multiples before the window
  return static_cast<std::size_t>(last / every + 1 - none);
}

StatisticsWindow statistics_window(const StatisticsChoice& choice, const TimeStep& time) {
  constexpr long samples = 1000;
  StatisticsWindow window;
  window.first = step_at("statistics_from", choice.from, time);
  window.last = choice.to ? step_at("statistics_to", *choice.to, time) : time.count;
  if (window.first > window.last)
    throw UserError(
        format("-statistics_to: {:g} s lies before -statistics_from {:g} s; turn the window round",
               choice.to.value_or(0), choice.from));
  window.every = choice.every ? *choice.every : std::max(1L, (window.last - window.first) / samples);
  if (window.samples() == 0)
    throw UserError(
        format("-statistics_every {}: no multiple of it lies among the steps {} to {} of the window; give "
               "a smaller one",
               window.every, window.first, window.last));
  return window;
}

StressStatistics::StressStatistics(MPI_Comm comm, const Mesh& mesh, const StatisticsWindow& window,
                                   double quantile, bool damping)
    : comm_(comm),
      mesh_(mesh),
      window_(window),
      quantile_(quantile),
      owned_(owned_cells(mesh.cells)),
      stress_(owned_.size(), window.samples(), quantile),
      strain_(owned_.size(), window.samples(), quantile),
      damping_(damping),
      damping_first_(damping ? owned_.size() : 0),
      damping_last_(damping_first_.size()) {}

void StressStatistics::add(double time, const std::vector<std::array<double, 3>>& stress,
                           const std::vector<std::array<double, 3>>& strain,
                           const std::vector<double>& damping) {
  const bool first = samples() == 0;
  if (first) from_ = time;
  to_ = time;
  for (std::size_t k = 0; k < damping_last_.size(); ++k) damping_last_[k] = damping[owned_[k]];
  if (first) damping_first_ = damping_last_;
  const auto add_to = [&](RunningStatistics& statistics, const std::vector<std::array<double, 3>>& values) {
    rows_.clear();
    for (const int cell : owned_) rows_.insert(rows_.end(), values[cell].begin(), values[cell].end());
    statistics.add(rows_.data());
  };
  add_to(stress_, stress);
  add_to(strain_, strain);
}

std::vector<StateGroup> StressStatistics::state() {
  StateGroup cells{"cells", {}, mesh_.cells.total, true, stress_.state("stress", "Pa")};
  for (const int cell : owned_) cells.keys.push_back(mesh_.cells.number[cell]);
  for (StateArray& array : strain_.state("strain", "1")) cells.arrays.push_back(std::move(array));
  if (damping_)
    for (auto [name, values] :
         {std::pair("damping_first", &damping_first_), {"damping_last", &damping_last_}})
      cells.arrays.push_back({name, "J/m^3", "what bulk damping had taken", 1, values->data()});
  carried_ = {static_cast<double>(samples()), from_, to_};
  return {std::move(cells),
          {"statistics",
           {0},
           0,
           is_root(comm_),
           {{"window", "1", "samples so far, time of the first and of the last (s)", 3, carried_.data()}}}};
}

void StressStatistics::resume() {
  stress_.resume(static_cast<std::size_t>(carried_[0]));
  strain_.resume(static_cast<std::size_t>(carried_[0]));
  from_ = carried_[1];
  to_ = carried_[2];
}

void StressStatistics::write(const std::string& folder) const {
  if (samples() == 0) return;
  std::vector<double> power;
  for (std::size_t k = 0; k < damping_last_.size(); ++k)
    power.push_back((damping_last_[k] - damping_first_[k]) / (to_ - from_));
  write_statistics(comm_, MeshImage(comm_, mesh_), {from_, to_, samples(), quantile_}, stress_.result(),
                   strain_.result(), folder, "statistics",
                   damping_ ? std::optional(std::move(power)) : std::nullopt);
}

std::string StressStatistics::forecast(double time_step) const {
  const long every = window_.every, first = (window_.first + every - 1) / every * every;
  const auto time = [&](long n) { return engineering(static_cast<double>(n) * time_step, "s"); };
  const double memory = 2 * RunningStatistics::bytes(window_.samples(), quantile_);
  return format("statistics of {} samples from {} to {} take {} of that memory\n", window_.samples(),
                time(first), time(window_.last / every * every),
                readable_bytes(memory * static_cast<double>(mesh_.cells.total)));
}

double StressStatistics::bytes() const {
  return statistics_bytes(mesh_.nodes.total, mesh_.cells.total) +
         (damping_ ? sizeof(double) * static_cast<double>(mesh_.cells.total) : 0);
}

}  // namespace slipscale
