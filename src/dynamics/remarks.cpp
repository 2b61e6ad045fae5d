#include "slipscale/dynamics/remarks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "slipscale/base/print.hpp"
#include "slipscale/mesh/outer_boundary.hpp"
#include "slipscale/mesh/shape_functions.hpp"
#include "slipscale/solid/material.hpp"
#include "slipscale/solid/stress.hpp"

namespace slipscale {
namespace {

/// Heights are told apart down to this part of the length of the edge at hand.
constexpr double of_edge = 1e-6;

constexpr double nowhere = std::numeric_limits<double>::infinity();

std::array<int, 2> ascending(const std::array<int, 2>& nodes) {
  return {std::min(nodes[0], nodes[1]), std::max(nodes[0], nodes[1])};
}

/// Outer edges of the body that the contact boundary does not hold.
std::vector<OuterEdge> edges_left_out(const Mesh& mesh, const Boundary& contact) {
  std::vector<std::array<int, 2>> held;
  for (const BoundaryEdge& edge : contact.edges) held.push_back(ascending(edge.nodes));
  std::ranges::sort(held);
  std::vector<OuterEdge> left;
  for (const OuterEdge& edge : outer_edges(mesh)) {
    if (!std::ranges::binary_search(held, ascending(edge.nodes))) left.push_back(edge);
  }
  return left;
}

/// Places that are counted over the ranks.
struct Found {
  double count = 0;
  double reach[3] = {nowhere, nowhere, nowhere};  ///< smallest x, −largest x, lowest height

  void add(const Vector2& x, double height) {
    reach[0] = std::min(reach[0], x[0]);
    reach[1] = std::min(reach[1], -x[0]);
    reach[2] = std::min(reach[2], height);
  }
  void share(MPI_Comm comm) {
    MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPI_DOUBLE, MPI_SUM, comm);
    MPI_Allreduce(MPI_IN_PLACE, reach, 3, MPI_DOUBLE, MPI_MIN, comm);
  }
};

/// " of boundary 'a', 'b'": those that hold one of the edges (ascending local nodes). Collective.
std::string names_of(MPI_Comm comm, const Mesh& mesh, std::vector<std::array<int, 2>> edges) {
  std::ranges::sort(edges);
  std::vector<int> holds;
  for (const Boundary& boundary : mesh.boundaries)
    holds.push_back(std::ranges::any_of(boundary.edges, [&](const BoundaryEdge& edge) {
      return std::ranges::binary_search(edges, ascending(edge.nodes));
    }));
  MPI_Allreduce(MPI_IN_PLACE, holds.data(), static_cast<int>(holds.size()), MPI_INT, MPI_MAX, comm);
  std::string text;
  for (std::size_t b = 0; b < holds.size(); ++b)
    if (holds[b]) text += (text.empty() ? " of boundary '" : ", '") + mesh.boundaries[b].name + "'";
  return text;
}

/// Materials that homogenize itself was not content with.
std::string doubtful(const Model& model) {
  std::string text;
  for (std::size_t r = 0; r < model.materials.size(); ++r)
    if (const std::string& doubt = model.materials[r].doubt; !doubt.empty())
      text += (text.empty() ? "the homogenised material" : "; that") + std::string(" of region '") +
              model.mesh.regions[r].name + "' is doubtful: " + doubt;
  return text;
}

/// Edges at or below the height of the lowest contact node: what is level with it, or will meet the surface
/// before it does.
std::string uncovered(const SlidingBody& body) {
  const Mesh& mesh = body.model().mesh;
  const Boundary& contact = *mesh.find_boundary(body.scene().surface->boundary);
  double lowest = nowhere;
  for (int i : contact.nodes) lowest = std::min(lowest, mesh.nodes.position[i][1]);
  MPI_Allreduce(MPI_IN_PLACE, &lowest, 1, MPI_DOUBLE, MPI_MIN, body.comm());
  Found found;
  std::vector<std::array<int, 2>> low_edges;
  for (const OuterEdge& edge : edges_left_out(mesh, contact)) {
    const int lower = mesh.nodes.number[edge.nodes[0]] < mesh.nodes.number[edge.nodes[1]] ? 0 : 1;
    if (edge.nodes[lower] >= mesh.nodes.owned) continue;  // counted by the rank of that node
    const Vector2 &a = mesh.nodes.position[edge.nodes[0]], &b = mesh.nodes.position[edge.nodes[1]];
    const double tolerance = of_edge * std::hypot(edge.outward[0], edge.outward[1]);
    const double high = std::max(a[1], b[1]) - lowest, low = std::min(a[1], b[1]) - lowest;
    if (high > tolerance && low >= -tolerance) continue;
    found.count += 1;
    found.add(a, low);
    found.add(b, low);
    low_edges.push_back(ascending(edge.nodes));
  }
  found.share(body.comm());
  if (found.count == 0) return "";
  return format(
      "{:g} outer edges{} between x = {:g} and {:g} m lie as low as boundary '{}' or lower but do not belong "
      "to "
      "it, so that nothing keeps them from sinking through the surface; give them its name where they should "
      "touch",
      found.count, names_of(body.comm(), mesh, low_edges), found.reach[0], -found.reach[1], contact.name);
}

std::string sunk(const SlidingBody& body) {
  const Mesh& mesh = body.model().mesh;
  const Boundary& contact = *mesh.find_boundary(body.scene().surface->boundary);
  Found found;
  std::vector<char> counted(static_cast<std::size_t>(mesh.nodes.owned), 0);
  for (int i : body.contact().node) counted[i] = 1;  // these the surface holds
  for (const OuterEdge& edge : edges_left_out(mesh, contact))
    for (int i : edge.nodes) {
      if (i >= mesh.nodes.owned || counted[i]) continue;
      const double height = mesh.nodes.position[i][1] + body.displacement_n()[i][1] -
                            body.scene().surface->height_at(mesh.nodes.position[i][0], body.time());
      if (height >= -of_edge * std::hypot(edge.outward[0], edge.outward[1])) continue;
      counted[i] = 1;
      found.count += 1;
      found.add(mesh.nodes.position[i], height);
    }
  found.share(body.comm());
  if (found.count == 0) return "";
  return format(
      "at the end {:g} outer nodes between x = {:g} and {:g} m that are not in the contact lie below "
      "the "
      "surface, the deepest by {}; name their edges like boundary '{}' where they should touch",
      found.count, found.reach[0], -found.reach[1], engineering(-found.reach[2], "m"), contact.name);
}

std::string memory_below_step(const SlidingBody& body) {
  const Surface& surface = *body.scene().surface;
  const double memory = shortest_memory(body.scene().friction, surface.velocity(surface.ramp));
  if (!(memory > 0 && memory < body.time_step())) return "";
  return "the relaxation time of friction, " + engineering(memory, "s") + ", is shorter than the step, " +
         engineering(body.time_step(), "s") +
         ", so that friction acts as Coulomb's, whose results depend on mesh and step; give a longer "
         "-friction_length (or -friction_time), or a smaller step";
}

constexpr double out_of_equilibrium = 1e-6;  ///< of the scale below; rounding leaves far less

struct LeftForce {
  double size = 0, scale = 0;  ///< N/m
  Vector2 place{};             ///< of the node, m
};

/// The largest force m a at the start, but for what supports hold, and the largest that stress makes on the
/// side of a cell: the largest component times the root of the area. Collective.
LeftForce left_force(const SlidingBody& body) {
  const Model& model = body.model();
  const Mesh& mesh = model.mesh;
  LeftForce left;
  int found = -1;
  for (int i = 0; i < mesh.nodes.owned; ++i) {
    Vector2 force = body.acceleration_n()[i];
    const int slot = body.boundary_nodes().slot_of(i);
    for (int axis = 0; axis < 2; ++axis)
      force[axis] *= slot >= 0 && body.boundary_nodes().support[slot][axis] != 0 ? 0 : model.mass[i];
    if (const double size = std::hypot(force[0], force[1]); size > left.size) left.size = size, found = i;
  }
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const auto stress = stress_of_cell(mesh, model.materials, body.displacement_n(), cell);
    const double most = std::max({std::abs(stress[0]), std::abs(stress[1]), std::abs(stress[2])});
    left.scale = std::max(left.scale, most * std::sqrt(cell_area(mesh.cells.corners_of(cell))));
  }
  const double own = left.size;
  double sizes[2] = {left.size, left.scale};
  MPI_Allreduce(MPI_IN_PLACE, sizes, 2, MPI_DOUBLE, MPI_MAX, body.comm());
  left.size = sizes[0], left.scale = sizes[1];
  PetscInt number = found >= 0 && own == left.size ? mesh.nodes.number[found] : PETSC_MAX_INT;
  const PetscInt mine = number;
  MPI_Allreduce(MPI_IN_PLACE, &number, 1, MPIU_INT, MPI_MIN, body.comm());
  double place[2] = {-nowhere, -nowhere};
  if (found >= 0 && mine == number) std::copy_n(mesh.nodes.position[found].data(), 2, place);
  MPI_Allreduce(MPI_IN_PLACE, place, 2, MPI_DOUBLE, MPI_MAX, body.comm());
  left.place = {place[0], place[1]};
  return left;
}

std::vector<std::string> those_that_speak(std::vector<std::string> texts) {
  std::erase(texts, "");
  return texts;
}

/// Linear triangles and fully integrated quadrilaterals cannot change shape at constant volume.
std::string locking(const Model& model) {
  std::string names;
  for (std::size_t r = 0; r < model.materials.size(); ++r)
    if (nearly_incompressible(model.materials[r]))
      names += (names.empty() ? "'" : ", '") + model.mesh.regions[r].name + "'";
  return names.empty()
             ? ""
             : "region " + names +
                   " is nearly incompressible (Poisson's ratio above .49): its elements lock and are "
                   "too stiff; see how results change with -mesh_refine 1";
}

}  // namespace

std::vector<std::string> remarks_at_start(const SlidingBody& body) {
  const std::string doubt = doubtful(body.model());
  if (!body.scene().surface) return those_that_speak({doubt, locking(body.model())});
  return those_that_speak({doubt, locking(body.model()), memory_below_step(body), uncovered(body)});
}

std::vector<std::string> remarks_on_first_step(const SlidingBody& body) {
  const InitialState& initial = body.scene().initial;
  if (!initial.fields && initial.displacement[0].is_zero() && initial.displacement[1].is_zero()) return {};
  const LeftForce left = left_force(body);
  if (!(left.size > out_of_equilibrium * left.scale)) return {};
  const std::string part =
      left.scale > 0
          ? format("{:.2g} of the largest that stress makes on the side of a cell", left.size / left.scale)
          : "and there is no stress";
  return {format(
      "the initial state is not in equilibrium: a force of {:.3g} N/m is left on the node at x = {:g} m, y = "
      "{:g} m, {}; the body starts to move by it",
      left.size, left.place[0], left.place[1], part)};
}

std::vector<std::string> remarks_at_end(const SlidingBody& body) {
  if (!body.scene().surface) return {};
  return those_that_speak(
      {body.has_touched() ? "" : "the body never touched the surface; nothing here is about contact",
       sunk(body)});
}

}  // namespace slipscale
