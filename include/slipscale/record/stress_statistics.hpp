#pragma once

#include <array>
#include <string>
#include <vector>

#include "slipscale/dynamics/scene.hpp"
#include "slipscale/files/running_statistics.hpp"
#include "slipscale/record/record_choice.hpp"

namespace slipscale {

/// When samples are taken: at the multiples of `every` among the steps first to last.
struct StatisticsWindow {
  long first = 0, last = 0, every = 1;

  bool due(long n) const { return n >= first && n <= last && n % every == 0; }
  std::size_t samples() const;
};

/// Throws UserError for a window that lies outside the run, is turned round or holds no sample.
StatisticsWindow statistics_window(const StatisticsChoice& choice, const TimeStep& time);

/// Takes the statistics of stress and strain of the cells over a window of the run, and the mean power of
/// bulk damping in them.
class StressStatistics {
 public:
  StressStatistics(MPI_Comm comm, const Mesh& mesh, const StatisticsWindow& window, double quantile,
                   bool damping = false);

  bool due(long n) const { return window_.due(n); }
  /// State at t_n of a step that is due; stress and strain [local cells][xx, yy, xy], Pa and 1; where it was
  /// asked for, what bulk damping took so far [local cells], J/m³.
  void add(double time, const std::vector<std::array<double, 3>>& stress,
           const std::vector<std::array<double, 3>>& strain, const std::vector<double>& damping = {});
  bool damping() const { return damping_; }
  std::size_t samples() const { return stress_.samples(); }

  /// For a checkpoint: what the samples so far left; `resume` after the arrays were filled in.
  std::vector<StateGroup> state();
  void resume();

  /// Writes statistics.h5 and statistics.xdmf over the samples so far, if there are any. Throws UserError on
  /// all ranks when it cannot. Collective.
  void write(const std::string& folder) const;

  /// What it will take, in words. The same on every rank.
  std::string forecast(double time_step) const;
  double bytes() const;  ///< predicted size of statistics.h5

 private:
  MPI_Comm comm_;
  const Mesh& mesh_;
  const StatisticsWindow window_;
  const double quantile_;
  std::vector<int> owned_;  ///< local cells
  RunningStatistics stress_, strain_;
  double from_ = 0, to_ = 0;
  std::array<double, 3> carried_{};  ///< samples, from and to, for a checkpoint
  std::vector<double> rows_;
  const bool damping_;
  std::vector<double> damping_first_,
      damping_last_;  ///< [owned cells] at the first and the last sample, J/m³
};

}  // namespace slipscale
