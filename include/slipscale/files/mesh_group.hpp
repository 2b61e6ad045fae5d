#pragma once

#include <functional>
#include <vector>

#include "slipscale/files/mesh_image.hpp"
#include "slipscale/files/shared_file.hpp"

namespace slipscale {

/// What readers of a file must know of its /mesh.
struct MeshLayout {
  MeshImage::Topology topology = MeshImage::Topology::triangles;
  PetscInt points = 0, cells = 0;
  hsize_t stream_length = 0;  ///< mixed: entries of /mesh/cells
};

/// Writes /mesh/coordinates [points, 2], /mesh/cells ([cells, 3], [cells, 4] or XDMF's mixed stream) and
/// /mesh/region [cells] with the regions' names; /mesh/block [2, 2], the box of the whole. The
/// root group gets the attribute mesh_checksum where there is a mesh file. Collective.
MeshLayout write_mesh(MPI_Comm comm, SharedFile& file, const MeshImage& image);

/// Refuses a file to be continued whose /mesh is not that of the image: checksum, box, numbers of points and
/// cells (`SharedFile::examine`). Collective.
MeshLayout check_mesh(MPI_Comm comm, const SharedFile& file, const MeshImage& image);

/// What a group with its headers and attributes takes of a file, bytes, for predictions.
constexpr double group_overhead = 8000;

/// What /mesh takes of a file at most, bytes.
double mesh_bytes(double points, double cells);

/// Writes a row of a shape for each cell of the image: `fill(local cell, row)`. Collective.
void write_on_cells(SharedFile& file, const MeshImage& image, const DatasetDescription& about,
                    const std::vector<hsize_t>& shape_of_row,
                    const std::function<void(int cell, double* row)>& fill);

}  // namespace slipscale
