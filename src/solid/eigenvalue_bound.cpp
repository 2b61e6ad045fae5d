#include "slipscale/solid/eigenvalue_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "slipscale/solid/element.hpp"

namespace slipscale {

double element_eigenvalue_bound(MPI_Comm comm, const Mesh& mesh, const std::vector<Material>& materials) {
  double largest = 0;
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const Material& material = materials[mesh.cells.region[cell]];
    const double value =
        largest_element_eigenvalue(mesh.cells.corners_of(cell), material.stiffness, material.density);
    // A comparison with what is not a number would lose it.
    largest = std::isfinite(value) ? std::max(largest, value) : std::numeric_limits<double>::infinity();
    if (std::isinf(largest)) break;
  }
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, comm);
  return largest;
}

}  // namespace slipscale
