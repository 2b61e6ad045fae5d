#pragma once

#include <optional>
#include <string>
#include <vector>

#include "slipscale/base/options.hpp"
#include "slipscale/base/vector2.hpp"
#include "slipscale/files/interface_choice.hpp"
#include "slipscale/record/fields_file.hpp"

namespace slipscale {

/// Of which part of the run statistics are taken.
struct StatisticsChoice {
  double from = 0;            ///< s
  std::optional<double> to;   ///< s; absent: the end of the run
  std::optional<long> every;  ///< steps; absent: about a thousand samples
  double quantile = 0.99;
  bool damping = false;  ///< whether the mean power of bulk damping is among them
};

/// How often something is recorded: every so many steps, or as near to every so many seconds as whole steps
/// come. Neither: as often as the recorder finds right, or never.
struct Cadence {
  std::optional<long> every;       ///< steps
  std::optional<double> interval;  ///< s
  std::string option;              ///< that gives the interval

  bool given() const { return every || interval; }
  /// In steps of `step` seconds; `otherwise` when nothing is given. Throws UserError for an interval of less
  /// than a step.
  long steps(double step, long otherwise) const;
};

/// When a run leaves a checkpoint, and when it must end.
struct CheckpointChoice {
  double minutes = 0;          ///< of wall time between two of them; 0: none for the time's sake
  std::optional<long> every;   ///< steps
  std::optional<double> wall;  ///< minutes that the program may take in all

  /// A run that wants none may still leave one when it is told to stop.
  bool wanted() const { return minutes > 0 || every; }
};

/// What the user wants to keep of a run.
struct RecordChoice {
  std::string folder;
  Cadence history, contact;   ///< when nothing is given, contact.h5 has about a thousand rows, in a short run
                              ///< one in 25 steps
  bool contact_sums = false;  ///< whether it has sums over every step
  std::optional<InterfaceChoice> interfaces;
  Cadence interface_rows;       ///< about a thousand when nothing is given
  std::vector<Vector2> points;  ///< m
  bool momentum = false;        ///< whether history.h5 has those of body and plates
  Cadence fields;
  std::vector<double> fields_times;  ///< s
  FieldQuantities quantities;
  std::optional<Box> fields_box;
  std::optional<StatisticsChoice> statistics;
  std::string progress;
  CheckpointChoice checkpoint;
  std::optional<std::string> restart;  ///< folder of the run to go on with

  bool cell_damping() const {  ///< whether the work of bulk damping is to be known cell by cell
    return quantities.damping_work || (statistics && statistics->damping);
  }
};

Schema record_schema();
RecordChoice read_record(const Options& options);

}  // namespace slipscale
