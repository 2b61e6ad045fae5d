#pragma once

#include <cstdint>
#include <string>

#include "slipscale/record/fields_file.hpp"

namespace slipscale {

/// Predicted sizes in bytes, so that a scene that would fill the disk is known before it runs.

/// A file of growing datasets with `row_bytes` a row (see `SeriesFile::row_bytes`) in `datasets` of them.
double series_bytes(double rows, double row_bytes, int datasets);

/// fields.h5 after `frames` frames.
double fields_bytes(double frames, std::int64_t points, std::int64_t cells,
                    const FieldQuantities& quantities);

/// statistics.h5.
double statistics_bytes(std::int64_t points, std::int64_t cells);

/// "1.25 GB": decimal prefixes, as disks are sold and `df -H` counts.
std::string readable_bytes(double bytes);

/// "0.4 s", "12 s", "3 min 20 s", "2 h 05 min", "4 d 3 h".
std::string readable_duration(double seconds);

}  // namespace slipscale
