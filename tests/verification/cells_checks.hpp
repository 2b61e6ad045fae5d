#pragma once

#include <petscsys.h>

#include <string>
#include <vector>

#include "report.hpp"
#include "scenes.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/homogenize/cell_problem.hpp"

namespace slipscale::testing_support {

inline double largest(const Eigen::Matrix3d& m) { return m.cwiseAbs().maxCoeff(); }

/// Largest difference of two stiffnesses over the largest component of the second.
inline double relative_difference(const Eigen::Matrix3d& found, const Eigen::Matrix3d& expected) {
  return largest(found - expected) / largest(expected);
}

/// PETSc options that hold while the object lives.
class PetscChoice {
 public:
  using Values = std::vector<std::pair<std::string, std::string>>;
  explicit PetscChoice(Values values) : values_(std::move(values)) {
    for (const auto& [name, value] : values_)
      petsc(PetscOptionsSetValue(nullptr, name.c_str(), value.c_str()));
  }
  ~PetscChoice() {
    for (const auto& [name, value] : values_) (void)PetscOptionsClearValue(nullptr, name.c_str());
  }
  PetscChoice(const PetscChoice&) = delete;
  PetscChoice& operator=(const PetscChoice&) = delete;

 private:
  Values values_;
};

/// Conjugate gradients with multigrid, for a cell of any size.
inline PetscChoice multigrid() { return PetscChoice({{"-cell_ksp_type", "cg"}, {"-cell_pc_type", "gamg"}}); }

/// A factorisation, for a cell of any size.
inline PetscChoice factorisation() {
  return PetscChoice({{"-cell_ksp_type", "preonly"},
                      {"-cell_pc_type", "cholesky"},
                      {"-cell_pc_factor_mat_solver_type", "mumps"}});
}

/// Stiffness of each region of the mesh, by its name: `matrix`, or anything else.
inline std::vector<Material> two_materials(const Mesh& mesh, const Material& matrix,
                                           const Material& inclusion) {
  std::vector<Material> materials;
  for (const Region& region : mesh.regions) materials.push_back(region.name == "matrix" ? matrix : inclusion);
  return materials;
}

/// `solve_cell` on PETSC_COMM_WORLD.
inline CellSolution solve(const Mesh& mesh, const std::vector<Material>& materials,
                          CellBoundary boundary = CellBoundary::periodic) {
  return solve_cell(PETSC_COMM_WORLD, mesh, materials, boundary);
}

}  // namespace slipscale::testing_support
