#pragma once

#include <string>

namespace slipscale {

/// Sorts the pairs of nodes in the $Periodic section of a MSH 4.1 text file: gmsh writes them in the order of
/// their addresses in memory, which differs from run to run. Throws UserError when there is no room to.
void sort_periodic_pairs(const std::string& path);

/// gmsh does not look at the outcome of what it writes: on a full disk parts of a file are missing, and not
/// only at its end. Throws UserError unless every section of the MSH 4.1 text file has its lines.
void refuse_cut_short(const std::string& path);

/// "cannot be written", with the system's word for the last failure. Throws UserError.
[[noreturn]] void refuse_unwritten(const std::string& path);

}  // namespace slipscale
