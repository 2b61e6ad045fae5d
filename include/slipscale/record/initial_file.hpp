#pragma once

#include <string>

#include "slipscale/dynamics/conditions.hpp"

namespace slipscale {

/// What the file of the initial state was.
struct InitialFile {
  std::string description;  ///< for the terminal; empty: there is none
  std::string checksum;     ///< of its content, for checkpoints; likewise
};

/// Reads the file that the initial state names, where it names one, into its `fields`. `folder`: where the
/// run writes. Throws UserError as `read_nodal_fields` does, and for a file that the run would write over.
/// Collective.
InitialFile read_initial_file(const Mesh& mesh, const std::string& folder, InitialState& initial);

}  // namespace slipscale
