#include "slipscale/dynamics/friction_notes.hpp"

#include <algorithm>

#include "slipscale/base/print.hpp"
#include "slipscale/contact/law_at_node.hpp"
#include "slipscale/dynamics/contact_places.hpp"
#include "slipscale/mesh/boundary_cells.hpp"

namespace slipscale {
namespace {

/// Names of the regions whose edges meet the surface.
std::vector<std::string> touching(const Mesh& mesh, const Boundary& boundary) {
  std::vector<char> touches(mesh.regions.size(), 0);
  for (const int cell : boundary_cells(mesh, boundary)) touches[mesh.cells.region[cell]] = 1;
  MPI_Allreduce(MPI_IN_PLACE, touches.data(), static_cast<int>(touches.size()), MPI_CHAR, MPI_MAX, mesh.comm);
  std::vector<std::string> names;
  for (std::size_t r = 0; r < touches.size(); ++r)
    if (touches[r]) names.push_back(mesh.regions[r].name);
  return names;
}

/// `keys`: names of one constant, of which a region may give any.
std::string idle(const Options& options, const std::vector<std::string>& regions,
                 const std::vector<std::string>& keys) {
  const auto given = [&](const std::string& prefix) {
    return std::ranges::find_if(keys, [&](const std::string& key) { return options.given(prefix + key); });
  };
  const auto of_all = given("friction_");
  if (of_all == keys.end() || regions.empty()) return "";
  std::string names;
  for (const std::string& region : regions) {
    if (given("friction_" + region + "_") == keys.end()) return "";
    names += (names.empty() ? "'" : ", '") + region + "'";
  }
  return "-friction_" + *of_all + " acts nowhere: every region that touches the surface (" + names +
         ") has one of its own";
}

std::string rising(const Mesh& mesh, const Boundary& boundary, const FrictionChoice& friction) {
  if (friction.law != FrictionChoice::Law::exponential) return "";
  const auto places = contact_places(mesh, boundary);
  long count[2] = {0, 0};
  for (const int node : boundary.nodes) {
    if (node >= mesh.nodes.owned) continue;
    const FrictionChoice own = friction_at(friction, places[node], 0);
    count[0] += own.kinetic.number > own.coefficient ? 1 : 0;
    ++count[1];
  }
  MPI_Allreduce(MPI_IN_PLACE, count, 2, MPI_LONG, MPI_SUM, mesh.comm);
  if (count[0] == 0) return "";
  return format(
      "friction rises with the slip rate, which damps where falling friction feeds vibration: "
      "-friction_kinetic is above -friction_coefficient, the static one, at {} of {} contact nodes",
      count[0], count[1]);
}

}  // namespace

std::vector<std::string> notes_on_friction(const Options& options, const Mesh& mesh, const Scene& scene) {
  if (!scene.surface || scene.friction.law == FrictionChoice::Law::none) return {};
  const Boundary& boundary = *mesh.find_boundary(scene.surface->boundary);
  const auto regions = touching(mesh, boundary);
  std::vector<std::string> found;
  using Keys = std::vector<std::string>;
  for (const Keys& keys : {Keys{"coefficient"}, Keys{"kinetic"}, Keys{"slip_rate"}, Keys{"time", "length"}})
    found.push_back(idle(options, regions, keys));
  found.push_back(rising(mesh, boundary, scene.friction));
  std::erase(found, "");
  return found;
}

}  // namespace slipscale
