#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "stages.hpp"

namespace slipscale::mesh_stages {
namespace {

/// A shorter one is no line but three or four cells that happen to lie in a row.
constexpr std::size_t shortest_line = 16;

/// The edge from each vertex that runs most nearly along an axis, forward and backward; at least within 45°.
struct Steps {
  struct Step {
    PetscInt to = -1;
    double slope = 1;  ///< of the edge against the axis
  };
  std::vector<Step> forward, backward;

  Steps(const PlainMesh& mesh, PetscInt vertices, int axis)
      : forward(static_cast<std::size_t>(vertices)), backward(static_cast<std::size_t>(vertices)) {
    for (PetscInt cell = 0; cell < static_cast<PetscInt>(mesh.cells.size()); ++cell) {
      const CellGeometry shape = mesh.cell(cell);
      const std::size_t n = shape.size();
      for (std::size_t k = 0; k < n; ++k) {
        const std::size_t next = (k + 1) % n;
        const double along = shape.corners[next][axis] - shape.corners[k][axis],
                     across = shape.corners[next][1 - axis] - shape.corners[k][1 - axis];
        const PetscInt a = shape.vertices[k], b = shape.vertices[next];
        const double slope = std::abs(across / along);
        take(along > 0 ? forward : backward, a, {b, slope});
        take(along > 0 ? backward : forward, b, {a, slope});
      }
    }
  }

  bool linked(PetscInt from, PetscInt to) const { return to >= 0 && backward[to].to == from; }

 private:
  static void take(std::vector<Step>& steps, PetscInt at, const Step& step) {
    if (step.slope < steps[at].slope) steps[at] = step;
  }
};

/// Every vertex in one line, alone where it lies in none; each from its lower end, a closed one from where it
/// lies lowest along the axis.
Rows trace(const PlainMesh& mesh, PetscInt vertices, int axis) {
  const Steps steps(mesh, vertices, axis);
  Rows lines;
  lines.start.push_back(0);
  std::vector<char> taken(static_cast<std::size_t>(vertices), 0);
  const auto follow = [&](PetscInt vertex) {
    const auto begin = lines.entries.size();
    while (true) {
      taken[vertex] = 1;
      lines.entries.push_back(vertex);
      const PetscInt next = steps.forward[vertex].to;
      if (!steps.linked(vertex, next) || taken[next]) break;
      vertex = next;
    }
    const auto end = lines.entries.size();
    for (auto k = end - begin < shortest_line ? begin + 1 : end; k <= end; ++k)
      lines.start.push_back(static_cast<PetscInt>(k));
  };
  for (PetscInt vertex = 0; vertex < vertices; ++vertex) {
    const PetscInt before = steps.backward[vertex].to;
    if (before < 0 || steps.forward[before].to != vertex) follow(vertex);
  }
  for (PetscInt vertex = 0; vertex < vertices; ++vertex) {
    if (taken[vertex]) continue;
    PetscInt lowest = vertex;
    for (PetscInt k = steps.forward[vertex].to; k != vertex; k = steps.forward[k].to)
      if (mesh.position[k][axis] < mesh.position[lowest][axis]) lowest = k;
    follow(lowest);
  }
  return lines;
}

struct Worth {
  PetscInt covered = 0;  ///< vertices on lines
  PetscInt lines = 0;
  /// Where a line begins and ends little repeats.
  PetscInt inner() const { return covered - 2 * lines; }
};

Worth worth_of(const Rows& lines) {
  Worth worth;
  for (std::size_t k = 0; k + 1 < lines.start.size(); ++k) {
    const PetscInt length = lines.start[k + 1] - lines.start[k];
    if (length < static_cast<PetscInt>(shortest_line)) continue;
    worth.covered += length;
    ++worth.lines;
  }
  return worth;
}

}  // namespace

Rows grid_lines(const PlainMesh& mesh, PetscInt vertices, const std::array<bool, 2>& periodic) {
  Rows best;
  PetscInt most = 0;
  for (const int axis : {0, 1}) {
    if (periodic[1 - axis]) continue;
    Rows lines = trace(mesh, vertices, axis);
    const Worth worth = worth_of(lines);
    if (2 * worth.covered < vertices || worth.inner() <= most) continue;
    most = worth.inner();
    best = std::move(lines);
  }
  return best;
}

}  // namespace slipscale::mesh_stages
