#pragma once

#include <string>

namespace slipscale {

/// Sorts the pairs of nodes in the $Periodic section of a MSH 4.1 text file: gmsh writes them in the order of
/// their addresses in memory, which differs from run to run.
void sort_periodic_pairs(const std::string& path);

}  // namespace slipscale
