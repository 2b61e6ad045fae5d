#pragma once

#include "scenes.hpp"
#include "slipscale/morphology/compose.hpp"

namespace slipscale::testing_support {

/// A square or hexagonal array of discs of the given area fraction: the unit cell, 1 m wide, periodic, with
/// `elements` body-fitted edges along its width. The hexagonal cell is √3 m high and holds two discs.
Recipe disc_array(Arrangement arrangement, double fraction, int elements, CellShape shape);

/// Discs at random in a periodic cell of 1 m by 1 m.
Recipe random_discs(double fraction, double diameter, int elements, CellShape shape);

/// Draws and meshes on rank 0 and writes a scratch file, which every rank may read on return. Regions:
/// `matrix` and `inclusion`. Collective on PETSC_COMM_WORLD.
std::string drawn_file(const Recipe& recipe);

/// The composite read back on all ranks of PETSC_COMM_WORLD.
Mesh drawn_mesh(const Recipe& recipe);

}  // namespace slipscale::testing_support
