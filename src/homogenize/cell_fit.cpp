#include "cell_fit.hpp"

#include "slipscale/base/error.hpp"

namespace slipscale {
namespace {

/// Where the outer edges of what should be a torus are, and what to do.
const char* edges_left(const Mesh& mesh) {
  if (mesh.periodic[0] && mesh.periodic[1])
    return " on sides that are not paired, or in a pore that goes through from side to side; make all sides "
           "periodic, and let holes leave the solid connected along both axes";
  return mesh.periodic[0] || mesh.periodic[1]
             ? " (it is periodic along one axis only); make all sides periodic, or take -cell_boundary kubc "
               "or subc"
             : "; make all sides periodic, or take -cell_boundary kubc or subc";
}

}  // namespace

void refuse_unpaired(const Mesh& mesh) {
  throw UserError(
      "-cell_boundary periodic (and all) needs a mesh whose opposite sides are periodic curves of "
      "gmsh, but '" +
      mesh.file + "' has outer edges left" + edges_left(mesh));
}

void refuse_closed(const Mesh& mesh, CellBoundary boundary) {
  throw UserError("-cell_boundary " + std::string(name(boundary)) + " needs an outer boundary, but '" +
                  mesh.file + "' closes on itself; take -cell_boundary periodic");
}

void refuse_unfit(MPI_Comm comm, const Mesh& mesh, CellBoundary boundary,
                  const std::vector<OuterEdge>& outer) {
  const bool torus = mesh.periodic[0] && mesh.periodic[1];
  if (boundary == CellBoundary::periodic) {
    if (!torus) refuse_unpaired(mesh);
    return;
  }
  long edges = static_cast<long>(outer.size());
  MPI_Allreduce(MPI_IN_PLACE, &edges, 1, MPI_LONG, MPI_SUM, comm);
  if (edges == 0 || mesh.periodic[0] || mesh.periodic[1]) refuse_closed(mesh, boundary);
}

}  // namespace slipscale
