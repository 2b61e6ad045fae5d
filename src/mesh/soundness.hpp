#pragma once

#include <vector>

#include "plain_mesh.hpp"

namespace slipscale::mesh_stages {

/// The cells around each vertex, or any other lists of numbers, as compressed rows.
struct Rows {
  std::vector<PetscInt> start, entries;
  std::span<const PetscInt> operator[](PetscInt row) const {
    return {entries.data() + start[row], entries.data() + start[row + 1]};
  }
};
Rows cells_around(const std::vector<CellVertices>& cells, PetscInt vertices);

/// The mesh is one body: no cells overlap, all parts hang together, and what touches has common nodes, across
/// the periods too. Throws GmshFault with the reason why not. The cells themselves are sound; `shifts` are
/// the periods, m.
void check_soundness(const PlainMesh& mesh, const Rows& around, const std::vector<Vector2>& shifts);

}  // namespace slipscale::mesh_stages
