#pragma once

#include <memory>
#include <string>
#include <vector>

#include "slipscale/files/series_file.hpp"
#include "slipscale/record/observation.hpp"
#include "slipscale/record/probes.hpp"

namespace slipscale {

/// history.h5: one row an observed step. Lives on rank 0.
class HistoryFile {
 public:
  HistoryFile(const std::string& path, const SlidingBody& body, const std::vector<Vector2>& points);
  void write(const Observation& seen, const std::vector<ProbeReading>& probes);
  SeriesFile& series() { return file_; }

 private:
  void add_energy();

  SeriesFile file_;
  int time_, step_, friction_ = -1;
  std::vector<int> boundary_, surface_, energy_, fractions_, points_;
};

/// contact.h5: every contact node at the saved times. Lives on rank 0.
class ContactFile {
 public:
  ContactFile(const std::string& path, const Observer& observer);
  void write(const Observation& seen, double surface_velocity);
  SeriesFile& series() { return file_; }

 private:
  SeriesFile file_;
  std::vector<double> length_;
  int time_, u_, slip_rate_, normal_, tangential_, status_;
  std::vector<double> u_row_, slip_row_, normal_row_, tangential_row_;
  std::vector<std::uint8_t> status_row_;
};

}  // namespace slipscale
