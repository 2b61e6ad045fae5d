#pragma once

#include <string>

#include "slipscale/relocalize/fields_reader.hpp"
#include "slipscale/relocalize/local_stress.hpp"

namespace slipscale {

/// What is about to be relocalised, for the user to see before the first frame: both meshes with their sizes,
/// how one tiles the other, frames, output.
std::string describe(const FieldsReader& run, const LocalisationTensors& tensors, const Targets& targets,
                     const LocalStress& local);

}  // namespace slipscale
