#include "cell_fit.hpp"

#include <optional>

#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

/// Where the outer edges of what should be a torus are, and what to do.
const char* edges_left(const Mesh& mesh) {
  if (mesh.periodic[0] && mesh.periodic[1])
    return " (around a hole, or on sides that are not paired); mesh what is in the holes and make all sides "
           "periodic";
  return mesh.periodic[0] || mesh.periodic[1]
             ? " (it is periodic along one axis only); make all sides periodic, or take -cell_boundary kubc "
               "or subc"
             : "; make all sides periodic, or take -cell_boundary kubc or subc";
}

/// Sides that are not paired, or not well.
void refuse_seam(MPI_Comm comm, const Mesh& mesh, long outer_edges) {
  if (outer_edges > 0)
    throw UserError(
        "-cell_boundary periodic (and all) needs a mesh whose opposite sides are periodic curves of "
        "gmsh, but '" +
        mesh.file + "' has outer edges left" + edges_left(mesh));
  const auto place = unmatched_edge(mesh);
  throw_together(
      comm, place ? format("mesh '{}' pairs sides that do not match: near ({:g}, {:g}) m the edges on the "
                           "two sides differ; draw them as Periodic Curve and mesh again, or take "
                           "-cell_boundary kubc or subc",
                           mesh.file, (*place)[0], (*place)[1])
                  : "");
}

/// Boundary conditions are for the outside alone.
void refuse_holes(MPI_Comm comm, const Mesh& mesh, CellBoundary boundary,
                  const std::vector<OuterEdge>& outer) {
  if (const PetscInt count = holes(comm, mesh, outer); count > 0)
    throw UserError(
        format("mesh '{}' has {} hole{}, whose edges -cell_boundary {} would take for the outer "
               "boundary; mesh what is in a hole as a region of its own, soft if it is empty",
               mesh.file, static_cast<int>(count), count > 1 ? "s" : "", name(boundary)));
}

}  // namespace

void refuse_unfit(MPI_Comm comm, const Mesh& mesh, CellBoundary boundary,
                  const std::vector<OuterEdge>& outer) {
  if (const int parts = connected_parts(comm, mesh); parts > 1)
    throw UserError(
        format("mesh '{}' falls into {} parts that share no node, so that some of them float; keep one "
               "part, or mesh what is between them",
               mesh.file, parts));
  long edges = static_cast<long>(outer.size());
  MPI_Allreduce(MPI_IN_PLACE, &edges, 1, MPI_LONG, MPI_SUM, comm);
  if (boundary == CellBoundary::periodic) return refuse_seam(comm, mesh, edges);
  if (edges == 0)
    throw UserError("-cell_boundary " + std::string(name(boundary)) + " needs an outer boundary, but '" +
                    mesh.file + "' closes on itself; take -cell_boundary periodic");
  refuse_holes(comm, mesh, boundary, outer);
}

}  // namespace slipscale
