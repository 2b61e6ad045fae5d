#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "slipscale/files/output_folder.hpp"
#include "slipscale/files/progress.hpp"
#include "slipscale/record/cell_values.hpp"
#include "slipscale/record/checkpoint.hpp"
#include "slipscale/record/content_marks.hpp"
#include "slipscale/record/fields_file.hpp"
#include "slipscale/record/force_record.hpp"
#include "slipscale/record/history.hpp"
#include "slipscale/record/interface_record.hpp"
#include "slipscale/record/observation.hpp"
#include "slipscale/record/record_choice.hpp"
#include "slipscale/record/stress_statistics.hpp"

namespace slipscale {

/// Keeps what the user asked for: it says which steps are to be observed, and writes them.
class Recorder {
 public:
  /// Creates the folder's files, or goes on with those of the run that `restart` is of. Throws UserError for
  /// a point outside the body, for a time outside the run and a box without cells, all before the folder is
  /// touched, and for a folder that cannot be written to. Collective.
  Recorder(const SlidingBody& body, const RecordChoice& choice, const TimeStep& time,
           const Restart* restart = nullptr);

  /// What of step n is to be observed: rows of contact ask for no more than the boundary.
  Observed observes(long n) const {
    if (bulk_due(n)) return Observed::everything;
    return contact_due(n) ? Observed::boundary : Observed::nothing;
  }
  /// After the step t_n → t_{n+1} was made: writes what is due, shows progress. Throws RunError when the
  /// state is no longer finite, when energy appears from nowhere, or when the disk is full or the folder
  /// gone. Collective.
  void after_step(long n);

  /// Predicted steps, time, memory and output, for the user to see before the first step. Collective.
  std::string forecast() const;

  /// run.yaml: every option in effect and the facts of this run. Collective.
  void write_run(const Options& options) const;
  /// Closes the files, writes summary.yaml and returns its text. Collective.
  std::string finish();
  /// The same for a run that ends before its time; `why` and how to go on stand in the summary. Collective.
  std::string interrupt(const std::string& why, const std::string& command);

  /// For a checkpoint after step n: where the run stands, and what statistics and averages have gathered.
  /// Collective.
  std::vector<StateGroup> state(long n);
  /// Before it is written: all rows and frames so far are on the disk. Collective.
  void sync();
  const std::string& folder() const { return folder_.path(); }
  /// What tells this run's files from those of any other; an attribute of all of them.
  const std::string& run() const { return run_; }
  const TimeStep& time() const { return time_; }

 private:
  bool row_due(long n) const { return n % history_every_ == 0 || n == last_; }
  bool bulk_due(long n) const {
    return row_due(n) || fields_due(n) || statistics_due(n) || interfaces_due(n) || precedes_interfaces(n);
  }
  bool interfaces_due(long n) const { return interfaces_ && (n % interfaces_every_ == 0 || n == last_); }
  bool precedes_interfaces(long n) const {
    return interfaces_ && interfaces_->needs_step_before() && interfaces_due(n + 1);
  }
  bool contact_due(long n) const { return has_contact_ && (n % contact_every_ == 0 || n == last_); }
  bool fields_due(long n) const;
  bool statistics_due(long n) const { return window_ && window_->due(n); }
  double rows(long every) const { return static_cast<double>((last_ + every - 1) / every + 1); }
  void open_files(const Restart* restart);
  void go_on(const Restart& restart);
  void check_contents(const Restart& restart);
  void close_files();
  std::string summary(long steps, const std::string& why, const std::string& command);
  double seconds() const;  ///< of the steps and their output so far
  void observe(long n);
  void record_cells(long n);
  void record_interfaces(long n);
  void write_interfaces();                      ///< interfaces.yaml and .xdmf, and the headline
  std::vector<SeriesFile*> all_series() const;  ///< on rank 0
  std::string cadences() const;                 ///< for the forecast
  void check(const Observation& seen) const;
  double note_residual(const Energy& energy);
  [[noreturn]] void stop(const std::string& fault, const std::string& cure) const;
  void share_faults();

  const SlidingBody& body_;
  const RecordChoice choice_;
  const std::string run_;
  RunPosition position_;  ///< at the restart; of a new run all zero
  RunPosition written_;   ///< as the last checkpoint has it
  ContentMarks history_marks_{"history_contents"}, contact_marks_{"contact_contents"},
      fields_marks_{"fields_contents"}, interfaces_marks_{"interfaces_contents"};
  const TimeStep time_;
  const long last_, history_every_;
  const bool has_contact_;
  const long contact_every_;
  const long interfaces_every_;
  const std::optional<long> fields_every_;
  const std::vector<long> field_steps_;   ///< ascending
  const std::vector<double> transverse_;  ///< [local cells] or none
  const std::optional<StatisticsWindow> window_;
  Observer observer_;
  Probes probes_;
  std::unique_ptr<InterfaceRecord> interfaces_;
  const bool keeps_force_;  ///< whether `force_` records
  ForceRecord force_;
  OutputFolder folder_;                   ///< below all that may refuse the scene: an older run is kept then
  std::unique_ptr<HistoryFile> history_;  ///< on rank 0
  std::unique_ptr<ContactFile> contact_;  ///< on rank 0
  std::unique_ptr<InterfacesFile> interfaces_file_;  ///< on rank 0
  std::string interfaces_headline_;                  ///< at the end
  std::unique_ptr<FieldsFile> fields_;
  std::unique_ptr<StressStatistics> statistics_;
  CellValues cells_;
  Progress progress_;
  std::vector<Observation> rows_;           ///< rank 0: what the summary needs, contact nodes left out
  long last_sound_ = -1, last_frame_ = -1;  ///< steps whose record, and whose frame, were written
  double largest_residual_ = 0;             ///< relative to what flowed
  double rounded_residual_ = 0;             ///< of rows of which rounding makes more than counts as sound
  std::chrono::steady_clock::time_point start_;
};

}  // namespace slipscale
