#include "soundness.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "side_tree.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale::mesh_stages {
namespace {

std::string at(const Vector2& x) { return format("({:g}, {:g}) m", x[0], x[1]); }

/// A side of a cell that begins at the vertex looked at, or ends there.
struct Spoke {
  PetscInt other;  ///< vertex
  CellSide side;
};

[[noreturn]] void overlapping(const PlainMesh& mesh, const CellSide& side) {
  const CellGeometry cell = mesh.cell(side.cell);
  const Vector2& place = cell.corners[side.corner];
  const bool on_seam = mesh.is_torus() && mesh.own[side.cell] >= 0;
  throw GmshFault(": two cells lie on the same side of their common edge at " + at(place) +
                  (on_seam ? "; leave Periodic Curve to opposite sides of the outer boundary"
                           : ", so that they overlap; mesh the surface again"));
}

/// The sides without a cell beyond them. A cell beyond runs through the side the other way.
std::vector<OuterSide> outer_sides(const PlainMesh& mesh, const Rows& around) {
  std::vector<OuterSide> outer;
  std::vector<Spoke> out;
  std::vector<PetscInt> in;
  for (PetscInt vertex = 0; vertex < static_cast<PetscInt>(mesh.position.size()); ++vertex) {
    out.clear(), in.clear();
    for (const PetscInt cell : around[vertex]) {
      const auto corners = corners_of(mesh.cells[cell]);
      const std::size_t n = corners.size();
      for (std::size_t c = 0; c < n; ++c) {
        if (corners[c] != vertex) continue;
        out.push_back({corners[(c + 1) % n], {cell, static_cast<int>(c)}});
        in.push_back(corners[(c + n - 1) % n]);
      }
    }
    std::ranges::sort(out, {}, &Spoke::other);
    std::ranges::sort(in);
    auto arriving = in.begin();
    for (std::size_t k = 0; k < out.size(); ++k) {
      if (k > 0 && out[k].other == out[k - 1].other) overlapping(mesh, out[k].side);
      while (arriving != in.end() && *arriving < out[k].other) ++arriving;
      if (arriving != in.end() && *arriving == out[k].other) continue;
      const auto [cell, corner] = out[k].side;
      const CellGeometry shape = mesh.cell(cell);
      outer.push_back({vertex, out[k].other, shape.corners[corner],
                       shape.corners[(static_cast<std::size_t>(corner) + 1) % shape.size()]});
    }
  }
  return outer;
}

double cross(const Vector2& o, const Vector2& a, const Vector2& b) {
  return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

double distance(const Vector2& a, const Vector2& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

double distance_to_side(const Vector2& x, const OuterSide& side) {
  const Vector2 way{side.b[0] - side.a[0], side.b[1] - side.a[1]};
  const double along =
      ((x[0] - side.a[0]) * way[0] + (x[1] - side.a[1]) * way[1]) / (way[0] * way[0] + way[1] * way[1]);
  const double s = std::clamp(along, 0.0, 1.0);
  return distance(x, {side.a[0] + s * way[0], side.a[1] + s * way[1]});
}

/// The later ones tell more plainly what is wrong.
enum class Contact { none, node_on_side, crossing, node_on_node };

struct Finding {
  Contact contact = Contact::none;
  Vector2 place{};  ///< m
};

/// How two sides touch though they should not: nodes that are the same are meant to.
Finding contact_of(const OuterSide& one, const OuterSide& two) {
  const double little = 1e-6 * std::min(distance(one.a, one.b), distance(two.a, two.b));
  Finding found;
  const auto look = [&](const Vector2& x, PetscInt vertex, const OuterSide& side) {
    if (vertex == side.from || vertex == side.to || distance_to_side(x, side) > little) return;
    const bool on_node = std::min(distance(x, side.a), distance(x, side.b)) <= little;
    const Contact contact = on_node ? Contact::node_on_node : Contact::node_on_side;
    if (contact > found.contact) found = {contact, x};
  };
  look(one.a, one.from, two);
  look(one.b, one.to, two);
  look(two.a, two.from, one);
  look(two.b, two.to, one);
  if (found.contact != Contact::none || one.from == two.from || one.from == two.to || one.to == two.from ||
      one.to == two.to)
    return found;
  const auto apart = [](double x, double y) { return (x > 0 && y < 0) || (x < 0 && y > 0); };
  if (apart(cross(one.a, one.b, two.a), cross(one.a, one.b, two.b)) &&
      apart(cross(two.a, two.b, one.a), cross(two.a, two.b, one.b)))
    return {Contact::crossing, one.a};
  return found;
}

/// The plainest contact of the outer sides with themselves, moved by `shift`.
Finding contact_within(const SideTree& tree, const Vector2& shift) {
  Finding plainest;
  int looked_at = 0;
  constexpr int enough = 1000;  // damaged files have contacts everywhere
  tree.near(shift, [&](std::size_t i, std::size_t j) {
    if (i >= j && shift == Vector2{}) return true;
    OuterSide moved = tree.sides()[j];
    for (int d = 0; d < 2; ++d) moved.a[d] += shift[d], moved.b[d] += shift[d];
    const Finding found = contact_of(tree.sides()[i], moved);
    if (found.contact > plainest.contact) plainest = found;
    return found.contact == Contact::none || (found.contact != Contact::node_on_node && ++looked_at < enough);
  });
  return plainest;
}

/// `parts` of the mesh that share no vertex. A gap cures what touches only where one part touches itself:
/// two would float.
void check_contacts(const SideTree& tree, const std::vector<Vector2>& shifts, int parts) {
  const Finding here = contact_within(tree, {});
  const bool one = parts == 1;
  const std::string glue =
      "; give the bodies common points and lines (Coherence or BooleanFragments of gmsh)";
  if (here.contact == Contact::node_on_node)
    throw GmshFault(": two nodes at " + at(here.place) +
                    " coincide but are not one, so that nothing holds the cells together there" + glue +
                    (one ? ", or leave a gap" : ""));
  if (here.contact == Contact::node_on_side)
    throw GmshFault(": the node at " + at(here.place) +
                    " lies on the edge of a cell that it is no corner of" + glue +
                    (one ? ", or leave a gap" : ""));
  if (here.contact == Contact::crossing)
    throw GmshFault(": bodies overlap near " + at(here.place) + "; cut them with BooleanFragments of gmsh" +
                    (one ? ", or move them apart" : ""));
  for (const Vector2& shift : shifts)
    for (const double sign : {1.0, -1.0}) {
      const Finding found = contact_within(tree, {sign * shift[0], sign * shift[1]});
      if (found.contact != Contact::none)
        throw GmshFault(
            ": at " + at(found.place) +
            " two sides meet across a period that are not paired; make the whole of them Periodic "
            "Curve and mesh again");
    }
}

/// Number of parts that share no vertex.
int connected_parts(const PlainMesh& mesh) {
  std::vector<PetscInt> root(mesh.position.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](PetscInt vertex) {
    while (root[vertex] != vertex) vertex = root[vertex] = root[root[vertex]];
    return vertex;
  };
  auto parts = static_cast<int>(root.size());
  for (const CellVertices& cell : mesh.cells) {
    const auto corners = corners_of(cell);
    for (std::size_t c = 1; c < corners.size(); ++c) {
      const PetscInt a = find(corners[0]), b = find(corners[c]);
      if (a == b) continue;
      root[std::max(a, b)] = std::min(a, b);
      --parts;
    }
  }
  return parts;
}

}  // namespace

void check_soundness(const PlainMesh& mesh, const Rows& around, const std::vector<Vector2>& shifts) {
  const int parts = connected_parts(mesh);
  check_contacts(SideTree(outer_sides(mesh, around)), shifts, parts);
  if (parts > 1)
    throw GmshFault(
        format("falls into {} parts that share no node, so that some of them float; keep one part, "
               "or mesh what is between them",
               parts));
}

}  // namespace slipscale::mesh_stages
