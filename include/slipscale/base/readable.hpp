#pragma once

#include <string>

namespace slipscale {

/// "1.25 GB": decimal prefixes, as disks are sold and `df -H` counts.
std::string readable_bytes(double bytes);

/// "0.4 s", "12 s", "3 min 20 s", "2 h 05 min", "4 d 3 h".
std::string readable_duration(double seconds);

}  // namespace slipscale
