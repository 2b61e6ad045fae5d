#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "slipscale/record/fields_file.hpp"
#include "slipscale/record/history.hpp"
#include "slipscale/record/observation.hpp"
#include "slipscale/record/output_folder.hpp"
#include "slipscale/record/progress.hpp"

namespace slipscale {

/// What the user wants to keep of a run.
struct RecordChoice {
  std::string folder;
  long history_every = 1;             ///< steps
  std::vector<Vector2> points;        ///< m
  std::optional<long> contact_every;  ///< steps; absent: about a thousand rows in the run
  std::optional<long> fields_every;   ///< steps
  std::vector<double> fields_times;   ///< s
  FieldQuantities quantities;
  std::string progress;
};

Schema record_schema();
RecordChoice read_record(const Options& options);

/// Keeps what the user asked for: it says which steps are to be observed, and writes them.
class Recorder {
 public:
  /// Creates the folder's files. Throws UserError for a point outside the body, for a time outside the run,
  /// both before the folder is touched, and for a folder that cannot be written to. Collective.
  Recorder(const SlidingBody& body, const RecordChoice& choice, const TimeStep& time);

  /// Whether step n is to be observed.
  bool due(long n) const { return n % history_every_ == 0 || n == last_ || contact_due(n) || fields_due(n); }
  /// After the step t_n → t_{n+1} was made: writes what is due, shows progress. Throws RunError when the
  /// state is no longer finite, when energy appears from nowhere, or when the disk is full. Collective.
  void after_step(long n);

  /// Predicted steps, time, memory and output, for the user to see before the first step. Collective.
  std::string forecast() const;

  /// run.yaml: every option in effect and the facts of this run. Collective.
  void write_run(const Options& options) const;
  /// Closes the files, writes summary.yaml and returns its text. Collective.
  std::string finish();

 private:
  bool contact_due(long n) const { return has_contact_ && (n % contact_every_ == 0 || n == last_); }
  bool fields_due(long n) const;
  void observe(long n);
  void write_fields();
  void check(const Observation& seen) const;
  void share_faults();

  const SlidingBody& body_;
  const RecordChoice choice_;
  const TimeStep time_;
  const long last_, history_every_;
  const bool has_contact_;
  const long contact_every_;
  const std::vector<long> field_steps_;  ///< ascending
  Observer observer_;
  Probes probes_;
  OutputFolder folder_;                   ///< below all that may refuse the scene: an older run is kept then
  std::unique_ptr<HistoryFile> history_;  ///< on rank 0
  std::unique_ptr<ContactFile> contact_;  ///< on rank 0
  std::unique_ptr<FieldsFile> fields_;
  std::vector<std::array<double, 3>> stress_;
  Progress progress_;
  std::vector<Observation> rows_;  ///< rank 0: what the summary needs, contact nodes left out
  double largest_residual_ = 0;    ///< relative to what flowed
  std::chrono::steady_clock::time_point start_;
};

}  // namespace slipscale
