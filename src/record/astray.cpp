#include "astray.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

bool finite(const Vector2& vector) { return std::isfinite(vector[0]) && std::isfinite(vector[1]); }

bool finite(const Energy& energy) {
  return std::isfinite(energy.kinetic) && std::isfinite(energy.strain) && std::isfinite(energy.flowed);
}

/// The index in Mesh::regions of the first local cell around an owned node: all of its cells are local.
int region_of(const Mesh& mesh, int node) {
  for (int cell = 0; cell < mesh.cells.size(); ++cell)
    if (std::ranges::count(mesh.cells.nodes_of(cell), node) > 0) return mesh.cells.region[cell];
  return 0;
}

}  // namespace

Extreme most_displaced(const SlidingBody& body) {
  const Mesh& mesh = body.model().mesh;
  double most = -1;
  int mine = -1;  // owned nodes ascend in their numbers
  for (int i = 0; i < mesh.nodes.owned; ++i) {
    const Vector2 &u = body.displacement_n()[i], &v = body.velocity_n()[i];
    const double size = finite(u) && finite(v) ? std::max(std::abs(u[0]), std::abs(u[1])) : infinite;
    if (size > most) {
      most = size;
      mine = i;
    }
  }
  Extreme found;
  MPI_Allreduce(&most, &found.displacement, 1, MPI_DOUBLE, MPI_MAX, body.comm());
  const bool candidate = mine >= 0 && most == found.displacement;
  const PetscInt number = candidate ? mesh.nodes.number[mine] : mesh.nodes.total;
  MPI_Allreduce(&number, &found.node, 1, MPIU_INT, MPI_MIN, body.comm());
  double told[3] = {0, 0, 0};  // by its owner alone
  if (candidate && number == found.node) {
    const Vector2& place = mesh.nodes.position[mine];
    told[0] = place[0];
    told[1] = place[1];
    told[2] = region_of(mesh, mine);
  }
  MPI_Allreduce(MPI_IN_PLACE, told, 3, MPI_DOUBLE, MPI_SUM, body.comm());
  found.place = {told[0], told[1]};
  found.region = mesh.regions[static_cast<std::size_t>(told[2])].name;
  return found;
}

double rounding_of_balance(const SlidingBody& body) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon(), digits = 8;
  const double steps = static_cast<double>(body.steps_done());
  double sum = 0;
  for (int i = 0; i < body.model().mesh.nodes.owned; ++i)
    for (int axis = 0; axis < 2; ++axis) {
      const Vector2 gravity = body.body_acceleration(i);
      const double mass = body.model().mass[i], moved = std::abs(body.displacement_n()[i][axis]),
                   force = std::abs(body.internal_force_n()[i][axis]) + mass * std::abs(gravity[axis]);
      sum += epsilon * moved * (steps * mass * std::abs(body.acceleration_n()[i][axis]) + digits * force);
    }
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, body.comm());
  return sum;
}

Astray explain(const Energy& energy, const Extreme& extreme, const TimeStep& time, long history_every) {
  const std::string where = format("node {} (x = {:g} m, y = {:g} m, region {})", extreme.node,
                                   extreme.place[0], extreme.place[1], extreme.region);
  const std::string smaller =
      format("a smaller step, which is {:.2g} of the stable one now (-time_safety, or -time_step)",
             time.step / time.limit);
  if (finite(energy))
    return {
        format("the energy balance misses {:g} J/m of {:g} J/m that flowed; {} is displaced most, by {:g} m",
               energy.residual, energy.flowed, where, extreme.displacement),
        "Try " + smaller};
  if (std::isfinite(extreme.displacement))
    return {
        format("the energy is too large for a number; {} is displaced most, by {:g} m", where,
               extreme.displacement),
        "The loads are too large for the stiffness: see that pressures, Young's moduli and lengths are in "
        "Pa and m"};
  // Rows that are far apart let it pass the point at which the balance would have told.
  return {"the state is no longer finite at " + where + ", the first such node",
          (history_every > 1
               ? "Give -history_every 1 to learn whether the energy balance is missed before, and try "
               : "Try ") +
              smaller};
}

}  // namespace slipscale
