#include "cell_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "slipscale/base/error.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

/// A stretch of an open side of the torus's box: which side, and where along it, m.
struct OpenStretch {
  double side, begin, end;  ///< 0: left or lower, 1: right or upper; then the other axis
};

/// Outer edges on the two sides across `axis`, of all ranks. Edges of a hole may lie there too, on one side.
std::vector<OpenStretch> open_stretches(MPI_Comm comm, const Mesh& mesh, const std::vector<OuterEdge>& outer,
                                        int axis) {
  const int along = 1 - axis;
  const double little = 1e-9 * (mesh.upper[axis] - mesh.lower[axis]);
  std::vector<OpenStretch> mine;
  for (const OuterEdge& edge : outer) {
    const double length = std::hypot(edge.outward[0], edge.outward[1]);
    const double x = mesh.nodes.position[edge.nodes[0]][axis];
    if (std::abs(edge.outward[along]) > 1e-9 * length ||
        std::min(std::abs(x - mesh.lower[axis]), std::abs(x - mesh.upper[axis])) > little)
      continue;
    // Lower ends count, as far as the seam in the corner lets them be told.
    const double a = mesh.nodes.position[edge.nodes[0]][along], b = mesh.nodes.position[edge.nodes[1]][along];
    mine.push_back({edge.outward[axis] > 0 ? 1.0 : 0.0, std::min(a, b), std::min(a, b) + length});
  }
  const int ranks = ranks_of(comm), count = static_cast<int>(3 * mine.size());
  std::vector<int> counts(ranks), starts(ranks + 1, 0);
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
  for (int rank = 0; rank < ranks; ++rank) starts[rank + 1] = starts[rank] + counts[rank];
  std::vector<OpenStretch> all(static_cast<std::size_t>(starts.back()) / 3);
  MPI_Allgatherv(mine.data(), count, MPI_DOUBLE, all.data(), counts.data(), starts.data(), MPI_DOUBLE, comm);
  return all;
}

/// Whether both sides are open in one place.
bool open_on_both_sides(std::vector<OpenStretch> stretches) {
  std::ranges::sort(stretches, {}, &OpenStretch::begin);
  std::array<double, 2> reached{-HUGE_VAL, -HUGE_VAL};
  for (const OpenStretch& each : stretches) {
    const auto side = static_cast<std::size_t>(each.side);
    if (reached[1 - side] > each.begin + 1e-6 * (each.end - each.begin)) return true;
    reached[side] = std::max(reached[side], each.end);
  }
  return false;
}

/// Where the outer edges of what should be a torus are, and what to do.
const char* edges_left(const Mesh& mesh) {
  if (mesh.periodic[0] && mesh.periodic[1])
    return " on sides that are not paired, or in a pore that cuts it in two; make all sides periodic, and "
           "let "
           "holes leave the solid connected along both axes";
  return mesh.periodic[0] || mesh.periodic[1]
             ? " (it is periodic along one axis only); make all sides periodic, or take -cell_boundary kubc "
               "or subc"
             : "; make all sides periodic, or take -cell_boundary kubc or subc";
}

/// Sides that are not paired, or not well.
void refuse_seam(MPI_Comm comm, const Mesh& mesh, const std::vector<OuterEdge>& outer) {
  bool open = !mesh.periodic[0] || !mesh.periodic[1];
  for (int axis = 0; axis < 2 && !open; ++axis)
    open = open_on_both_sides(open_stretches(comm, mesh, outer, axis));
  if (open) refuse_unpaired(mesh);
  const auto place = unmatched_edge(mesh);
  throw_together(
      comm, place ? format("mesh '{}' pairs sides that do not match: near ({:g}, {:g}) m the edges on the "
                           "two sides differ; draw them as Periodic Curve and mesh again, or take "
                           "-cell_boundary kubc or subc",
                           mesh.file, (*place)[0], (*place)[1])
                  : "");
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
  if (const int parts = connected_parts(comm, mesh); parts > 1)
    throw UserError(
        format("mesh '{}' falls into {} parts that share no node, so that some of them float; keep one "
               "part, or mesh what is between them",
               mesh.file, parts));
  if (boundary == CellBoundary::periodic) return refuse_seam(comm, mesh, outer);
  long edges = static_cast<long>(outer.size());
  MPI_Allreduce(MPI_IN_PLACE, &edges, 1, MPI_LONG, MPI_SUM, comm);
  if (edges == 0 || mesh.periodic[0] || mesh.periodic[1]) refuse_closed(mesh, boundary);
}

}  // namespace slipscale
