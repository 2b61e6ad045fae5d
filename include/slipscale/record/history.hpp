#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "slipscale/files/series_file.hpp"
#include "slipscale/record/observation.hpp"
#include "slipscale/record/probes.hpp"

namespace slipscale {

/// history.h5: one row for each recorded step of what an `Observer` and `Probes` see; the energy terms are
/// those of `Energy` (ledger.hpp). Lives on rank 0.
class HistoryFile {
 public:
  /// `rows` that are expected; `momentum`: whether the observations bring those of body and plates;
  /// `continued`: of a file that another process began.
  HistoryFile(const std::string& path, const SlidingBody& body, const std::vector<Vector2>& points,
              bool momentum, double rows, std::optional<SeriesFile::Continue> continued = {});
  void write(const Observation& seen, const std::vector<ProbeReading>& probes);
  /// What was seen in the rows so far, contact nodes left out; nothing, and a fault or a refusal of the
  /// series, when they cannot be read.
  std::vector<Observation> rows_so_far();
  SeriesFile& series() { return file_; }

 private:
  void add_energy();
  template <class Seen, class Visit>
  void visit_numbers(Seen& seen, Visit visit) const;
  void add_momentum(const SlidingBody& body);
  void write_momentum(const Observation& seen);

  SeriesFile file_;
  int time_, step_, friction_ = -1;
  std::vector<int> boundary_, surface_, energy_, momentum_, plates_, fractions_, points_;
};

/// contact.h5: every contact node, along x, at the saved times, as an `Observer` sees it. Lives on rank 0.
class ContactFile {
 public:
  /// `regions`: their names; `sums`: whether the observations bring what happened over every step.
  ContactFile(const std::string& path, const Observer& observer, const std::vector<std::string>& regions,
              bool sums, double rows, std::optional<SeriesFile::Continue> continued = {});
  void write(const Observation& seen, double surface_velocity);
  SeriesFile& series() { return file_; }

 private:
  SeriesFile file_;
  std::vector<double> length_;
  int time_, u_, v_y_, gap_, slip_rate_, normal_, tangential_, strength_, status_;
  std::vector<double> u_row_, v_y_row_, gap_row_, slip_row_, normal_row_, tangential_row_, strength_row_;
  std::vector<std::uint8_t> status_row_;
  std::vector<int> sums_;  ///< of the members of ContactTotals, or none
  std::vector<double> sums_row_;
};

}  // namespace slipscale
