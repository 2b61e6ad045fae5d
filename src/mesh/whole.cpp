#include "plex.hpp"
#include "slipscale/base/parallel.hpp"
#include "stages.hpp"

namespace slipscale::mesh_stages {
namespace {

void tell_all(MPI_Comm comm, Whole& whole) {
  std::vector<double> numbers;
  std::size_t next = 0;
  // The same list is walked twice: rank 0 writes it, the others read it.
  const auto exchange = [&](auto&& visit) {
    for (auto& r : whole.regions) visit(r.cells), visit(r.area);
    for (auto& b : whole.boundaries)
      visit(b.edge_count), visit(b.length), visit(b.interior), visit(b.normal[0]), visit(b.normal[1]);
    for (int k = 0; k < 2; ++k) visit(whole.periodic[k]), visit(whole.lower[k]), visit(whole.upper[k]);
    visit(whole.shortest_edge), visit(whole.node_count), visit(whole.cell_count);
  };
  exchange([&](auto& value) { numbers.push_back(static_cast<double>(value)); });
  MPI_Bcast(numbers.data(), static_cast<int>(numbers.size()), MPI_DOUBLE, 0, comm);
  exchange(
      [&](auto& value) { value = static_cast<std::remove_reference_t<decltype(value)>>(numbers[next++]); });
}

}  // namespace

Whole load_whole(MPI_Comm comm, const MeshSource& source, GmshFile&& file) {
  const int rank = rank_of(comm);
  Whole whole;
  for (const auto& entry : file.names) {
    if (entry.dimension == 2) whole.regions.push_back({entry.name, entry.tag});
    if (entry.dimension == 1) whole.boundaries.push_back({.name = entry.name, .tag = entry.tag});
  }
  if (!file.is_read)
    whole.plain = read_by_petsc(comm, source, whole.regions, whole.boundaries);
  else if (rank == 0)
    whole.plain = plain_mesh(*file.mesh, whole.regions, whole.boundaries, source.cut);
  file.mesh.reset();
  throw_together(comm, rank == 0 ? fault_in_torus(whole.plain, source) : "");
  if (source.refine > 0)  // PETSc's refinement asks for edges
    whole.plain = refine(comm, whole.plain, source.refine, whole.regions, whole.boundaries);
  throw_together(comm, rank == 0 ? survey(source, whole) : "");
  tell_all(comm, whole);
  if (rank == 0) number_whole(whole);
  return whole;
}

}  // namespace slipscale::mesh_stages
