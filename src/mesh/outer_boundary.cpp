#include "slipscale/mesh/outer_boundary.hpp"

#include <algorithm>
#include <cmath>

#include "slipscale/base/petsc.hpp"

namespace slipscale {

std::vector<OuterEdge> outer_edges(const Mesh& mesh) {
  struct Seen {
    std::array<int, 2> nodes;  // ascending
    int cell, corner;
  };
  std::vector<Seen> seen;
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const int first = mesh.cells.first[cell], count = mesh.cells.corner_count(cell);
    for (int i = 0; i < count; ++i) {
      const int a = mesh.cells.corner_nodes[first + i], b = mesh.cells.corner_nodes[first + (i + 1) % count];
      if (a < mesh.nodes.owned || b < mesh.nodes.owned)
        seen.push_back({{std::min(a, b), std::max(a, b)}, cell, i});
    }
  }
  std::ranges::sort(seen, {}, &Seen::nodes);
  std::vector<OuterEdge> outer;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const bool shared = (k > 0 && seen[k - 1].nodes == seen[k].nodes) ||
                        (k + 1 < seen.size() && seen[k + 1].nodes == seen[k].nodes);
    if (shared) continue;
    const int first = mesh.cells.first[seen[k].cell], count = mesh.cells.corner_count(seen[k].cell);
    const int i = first + seen[k].corner, j = first + (seen[k].corner + 1) % count;
    const Vector2 &x = mesh.cells.corners[i], &y = mesh.cells.corners[j];
    outer.push_back({{mesh.cells.corner_nodes[i], mesh.cells.corner_nodes[j]}, {y[1] - x[1], x[0] - y[0]}});
  }
  return outer;
}

namespace {

/// An edge as one of its cells sees it.
struct SeenEdge {
  std::array<int, 2> nodes;  ///< ascending
  Vector2 way, end;          ///< from the first to the second; where the second is
};

/// By local node, whether a cell sees it elsewhere than at its position.
std::vector<char> nodes_of_seam(const Mesh& mesh) {
  std::vector<char> found(static_cast<std::size_t>(mesh.nodes.size()), 0);
  for (std::size_t c = 0; c < mesh.cells.corners.size(); ++c)
    if (const int node = mesh.cells.corner_nodes[c]; mesh.cells.corners[c] != mesh.nodes.position[node])
      found[node] = 1;
  return found;
}

std::vector<SeenEdge> edges_of_seam(const Mesh& mesh) {
  const std::vector<char> on_seam = nodes_of_seam(mesh);
  std::vector<SeenEdge> seen;
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const int first = mesh.cells.first[cell], count = mesh.cells.corner_count(cell);
    for (int k = 0; k < count; ++k) {
      int i = first + k, j = first + (k + 1) % count;
      if (mesh.cells.corner_nodes[j] < mesh.cells.corner_nodes[i]) std::swap(i, j);
      const int a = mesh.cells.corner_nodes[i], b = mesh.cells.corner_nodes[j];
      if (!on_seam[a] || !on_seam[b]) continue;
      const Vector2 &x = mesh.cells.corners[i], &y = mesh.cells.corners[j];
      seen.push_back({{a, b}, {y[0] - x[0], y[1] - x[1]}, y});
    }
  }
  return seen;
}

}  // namespace

std::optional<Vector2> unmatched_edge(const Mesh& mesh) {
  constexpr double tolerance = 1e-6;  // of the edge: what a file of few digits may lose
  std::vector<SeenEdge> seen = edges_of_seam(mesh);
  std::ranges::sort(seen, {}, &SeenEdge::nodes);
  for (std::size_t k = 1; k < seen.size(); ++k) {
    const Vector2 &one = seen[k - 1].way, &two = seen[k].way;
    if (seen[k - 1].nodes == seen[k].nodes &&
        std::hypot(one[0] - two[0], one[1] - two[1]) > tolerance * std::hypot(one[0], one[1]))
      return seen[k].end;
  }
  return std::nullopt;
}

namespace {

/// Gives every corner of the cell the lowest number among them. Returns whether one changed.
bool spread(const Mesh& mesh, int cell, PetscScalar* lowest) {
  const int *begin = mesh.cells.corner_nodes.data() + mesh.cells.first[cell],
            *end = mesh.cells.corner_nodes.data() + mesh.cells.first[cell + 1];
  PetscScalar least = lowest[*begin];
  for (const int* node = begin; node != end; ++node) least = std::min(least, lowest[*node]);
  bool changed = false;
  for (const int* node = begin; node != end; ++node) {
    changed |= lowest[*node] > least;
    lowest[*node] = least;
  }
  return changed;
}

bool spread_within_rank(const Mesh& mesh, PetscScalar* lowest) {
  bool ever = false;
  for (bool again = true; again; ever |= again) {
    again = false;
    for (int cell = 0; cell < mesh.cells.size(); ++cell) again |= spread(mesh, cell, lowest);
    for (int cell = mesh.cells.size(); cell-- > 0;) again |= spread(mesh, cell, lowest);  // and back
  }
  return ever;
}

}  // namespace

int connected_parts(MPI_Comm comm, const Mesh& mesh) {
  // Every node takes the lowest number in its part, first within the rank, then from rank to rank.
  OwnedVec vec;
  Vec local = nullptr;
  PetscScalar* lowest = nullptr;
  petsc(VecCreateGhost(comm, mesh.nodes.owned, PETSC_DECIDE, static_cast<PetscInt>(mesh.nodes.ghosts.size()),
                       mesh.nodes.ghosts.data(), vec.put()));
  petsc(VecGhostGetLocalForm(vec, &local));
  petsc(VecGetArray(local, &lowest));
  for (int i = 0; i < mesh.nodes.size(); ++i) lowest[i] = static_cast<PetscScalar>(mesh.nodes.number[i]);
  for (int changed = 1; changed;) {
    changed = spread_within_rank(mesh, lowest);
    petsc(VecRestoreArray(local, &lowest));
    petsc(VecGhostUpdateBegin(vec, INSERT_VALUES, SCATTER_FORWARD));
    petsc(VecGhostUpdateEnd(vec, INSERT_VALUES, SCATTER_FORWARD));
    petsc(VecGetArray(local, &lowest));
    MPI_Allreduce(MPI_IN_PLACE, &changed, 1, MPI_INT, MPI_MAX, comm);
  }
  int parts = 0;
  for (int i = 0; i < mesh.nodes.owned; ++i)
    parts += lowest[i] == static_cast<PetscScalar>(mesh.nodes.number[i]);
  petsc(VecRestoreArray(local, &lowest));
  petsc(VecGhostRestoreLocalForm(vec, &local));
  MPI_Allreduce(MPI_IN_PLACE, &parts, 1, MPI_INT, MPI_SUM, comm);
  return parts;
}

}  // namespace slipscale
