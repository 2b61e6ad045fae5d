#pragma once

#include <string>

#include "slipscale/modes/modes_report.hpp"
#include "slipscale/modes/steady_sliding.hpp"

namespace slipscale {

/// Writes modes.h5: the steady state, the spectrum, tractions along the contact in every mode, complex shapes
/// of the first `shapes` modes, and those as frames over one period, which modes.xdmf shows; the time of a
/// frame is the part of the period that has passed. Shapes are scaled as `ModeMeasures` says. Collective.
void write_modes(MPI_Comm comm, const std::string& folder, const Mesh& mesh, const ModesReport& report,
                 const SteadySliding& state, int shapes, int frames);

}  // namespace slipscale
