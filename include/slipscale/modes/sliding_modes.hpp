#pragma once

#include "slipscale/modes/modes_report.hpp"
#include "slipscale/modes/steady_sliding.hpp"

namespace slipscale {

/// The real modes that the search starts from. Throws UserError for more modes than there are unknowns.
/// Collective.
ModesBasis basis_of_real_modes(const SteadySliding& state, const ModesChoice& choice);

/// Finds the modes and what they do; `step`: also those of the time scheme at this step. Collective.
ModesReport find_sliding_modes(ModesBasis& basis, const SteadySliding& state, const Scene& scene,
                               const ModesChoice& choice, const std::optional<SchemeStep>& step);

/// What is outside the model or unlikely to be meant: Coulomb's law and a memory that is short beside the
/// mesh leave the fastest growth to waves of the mesh's own length. Collective.
std::vector<std::string> remarks_on_modes(MPI_Comm comm, const Model& model, const Scene& scene);

}  // namespace slipscale
