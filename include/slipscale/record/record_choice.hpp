#pragma once

#include <optional>
#include <string>
#include <vector>

#include "slipscale/base/options.hpp"
#include "slipscale/base/vector2.hpp"
#include "slipscale/record/fields_file.hpp"

namespace slipscale {

/// Of which part of the run statistics are taken.
struct StatisticsChoice {
  double from = 0;            ///< s
  std::optional<double> to;   ///< s; absent: the end of the run
  std::optional<long> every;  ///< steps; absent: about a thousand samples
  double quantile = 0.99;
};

/// What the user wants to keep of a run.
struct RecordChoice {
  std::string folder;
  long history_every = 1;             ///< steps
  std::vector<Vector2> points;        ///< m
  std::optional<long> contact_every;  ///< steps; absent: about a thousand rows in the run
  std::optional<long> fields_every;   ///< steps
  std::vector<double> fields_times;   ///< s
  FieldQuantities quantities;
  std::optional<Box> fields_box;
  std::optional<StatisticsChoice> statistics;
  std::string progress;
};

Schema record_schema();
RecordChoice read_record(const Options& options);

}  // namespace slipscale
