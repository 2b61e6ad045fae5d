#pragma once

#include <mpi.h>

#include <string>

#include "slipscale/relocalize/relocalisation.hpp"

namespace slipscale {

/// localization.h5 of `homogenize`, whole on every rank. `path`: the file, or the folder it lies in. Throws
/// UserError on all ranks when there is none, or it is damaged or something else: what cannot be (a stiffness
/// that is not symmetric and positive definite) and what does not belong together (⟨A⟩ = I, ⟨C:A⟩ = C_eff) is
/// found. Collective.
LocalisationTensors read_localisation(MPI_Comm comm, const std::string& path,
                                      const std::string& option = "relocalize_tensors");

}  // namespace slipscale
