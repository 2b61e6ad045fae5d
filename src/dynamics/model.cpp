#include "slipscale/dynamics/model.hpp"

#include "slipscale/solid/mass.hpp"

namespace slipscale {
namespace {

std::variant<PairStiffness<double>, PairStiffness<float>> assemble(const Mesh& mesh,
                                                                   const std::vector<Material>& materials,
                                                                   Model::Storage storage,
                                                                   const StiffnessKernel& kernel) {
  if (storage == Model::Storage::single) return PairStiffness<float>(mesh, materials, kernel);
  return PairStiffness<double>(mesh, materials, kernel);
}

}  // namespace

Model::Model(const Mesh& body, std::vector<Material> regions, Storage storage, const StiffnessKernel& how)
    : mesh(body),
      kernel(how),
      materials(std::move(regions)),
      mass(lumped_mass(body, materials)),
      stiffness(assemble(body, materials, storage, how)) {
  give_back_freed();
}

double Model::repeating(MPI_Comm comm) const {
  auto nodes = static_cast<double>(std::visit([](const auto& each) { return each.repeating(); }, stiffness));
  MPI_Allreduce(MPI_IN_PLACE, &nodes, 1, MPI_DOUBLE, MPI_SUM, comm);
  return nodes / static_cast<double>(mesh.nodes.total);
}

NodalVector::NodalVector(MPI_Comm comm, const Nodes& nodes, bool with_ghosts)
    : array_(static_cast<std::size_t>(with_ghosts ? nodes.size() : nodes.owned), Vector2{0, 0}) {
  const auto ghosts = static_cast<PetscInt>(with_ghosts ? nodes.ghosts.size() : 0);
  petsc(VecCreateGhostBlockWithArray(comm, 2, 2 * nodes.owned, PETSC_DETERMINE, ghosts, nodes.ghosts.data(),
                                     reinterpret_cast<PetscScalar*>(array_.data()), vec_.put()));
  petsc(VecGhostGetLocalForm(vec_, &local_));
}

NodalVector::~NodalVector() {
  if (updating_)
    (void)VecGhostUpdateEnd(vec_, INSERT_VALUES, SCATTER_FORWARD);  // PETSc refuses to free it before
  (void)VecGhostRestoreLocalForm(vec_, &local_);
}

void NodalVector::begin_update() {
  petsc(VecGhostUpdateBegin(vec_, INSERT_VALUES, SCATTER_FORWARD));
  updating_ = true;
}

void NodalVector::end_update() {
  if (!updating_) return;
  petsc(VecGhostUpdateEnd(vec_, INSERT_VALUES, SCATTER_FORWARD));
  updating_ = false;
}

}  // namespace slipscale
