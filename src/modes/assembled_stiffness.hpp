#pragma once

#include "slipscale/dynamics/model.hpp"

namespace slipscale {

/// K of the whole body as a matrix, [components of all nodes], numbered node by node in the order of the
/// ranks: for factorisations. Products are quicker by `Model::multiply`. Collective.
OwnedMat assembled_stiffness(MPI_Comm comm, const Model& model);

}  // namespace slipscale
