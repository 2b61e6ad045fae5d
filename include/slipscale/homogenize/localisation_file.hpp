#pragma once

#include <string>
#include <vector>

#include "slipscale/homogenize/cell_problem.hpp"

namespace slipscale {

/// localization.h5 and localization.xdmf: the mesh, and on each cell its region, area, localisation tensor
/// and the local stress per unit macroscopic strain; opens in ParaView as it is. In whole-mesh order: the
/// same data on any number of ranks.
///
/// /mesh/coordinates, /mesh/cells, /mesh/region as in fields.h5; /cell/region (the same), /cell/area [cells],
/// /cell/localisation [cells, 3, 3] (rows: local strain, columns: load cases), /cell/stress_xx, _yy, _xy
/// [cells, 3] one for each load case; /region/stiffness [regions, 3, 3]; /effective/stiffness [3, 3] with the
/// boundary condition's name, the cell's area (holes included) and the mesh file's checksum. Every dataset
/// has its units and description.
///
/// Both files appear under their names when they are whole. Throws UserError on all ranks when they cannot be
/// written. Collective.
void write_localisation(MPI_Comm comm, const Mesh& mesh, const std::vector<Material>& materials,
                        const CellSolution& solution, const std::string& folder);

}  // namespace slipscale
