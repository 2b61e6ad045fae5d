#include "plex.hpp"

namespace slipscale::mesh_stages {
namespace {

void set_cells(DM dm, const PlainMesh& mesh) {
  const auto cells = static_cast<PetscInt>(mesh.cells.size()),
             vertices = static_cast<PetscInt>(mesh.position.size());
  petsc(DMPlexSetChart(dm, 0, cells + vertices));
  for (PetscInt cell = 0; cell < cells; ++cell)
    petsc(DMPlexSetConeSize(dm, cell, static_cast<PetscInt>(corners_of(mesh.cells[cell]).size())));
  petsc(DMSetUp(dm));
  PetscInt* next = nullptr;
  petsc(DMPlexGetCones(dm, &next));
  for (const CellVertices& cell : mesh.cells)
    for (const PetscInt vertex : corners_of(cell)) *next++ = cells + vertex;
  petsc(DMPlexSymmetrize(dm));
  petsc(DMPlexStratify(dm));
}

/// A section of one field of points in the plane.
OwnedSection section_of(MPI_Comm comm, PetscInt begin, PetscInt end) {
  OwnedSection section;
  petsc(PetscSectionCreate(comm, section.put()));
  petsc(PetscSectionSetNumFields(section, 1));
  petsc(PetscSectionSetFieldComponents(section, 0, 2));
  petsc(PetscSectionSetChart(section, begin, end));
  return section;
}

void give(PetscSection section, PetscInt point, PetscInt points) {
  petsc(PetscSectionSetDof(section, point, 2 * points));
  petsc(PetscSectionSetFieldDof(section, point, 0, 2 * points));
}

OwnedVec coordinates(PetscSection section) {
  PetscInt size = 0;
  petsc(PetscSectionSetUp(section));
  petsc(PetscSectionGetStorageSize(section, &size));
  OwnedVec vec;
  petsc(VecCreateSeq(PETSC_COMM_SELF, size, vec.put()));
  petsc(VecSetBlockSize(vec, 2));
  petsc(PetscObjectSetName(reinterpret_cast<PetscObject>(vec.get()), "coordinates"));
  return vec;
}

void set_positions(MPI_Comm comm, DM dm, const PlainMesh& mesh) {
  const auto cells = static_cast<PetscInt>(mesh.cells.size()),
             vertices = static_cast<PetscInt>(mesh.position.size());
  const OwnedSection section = section_of(comm, cells, cells + vertices);
  for (PetscInt vertex = 0; vertex < vertices; ++vertex) give(section, cells + vertex, 1);
  const OwnedVec vec = coordinates(section);
  PetscScalar* next = nullptr;
  petsc(VecGetArrayWrite(vec, &next));
  PetscScalar* const values = next;
  for (const Vector2& x : mesh.position)
    for (const double component : x) *next++ = component;
  next = values;
  petsc(VecRestoreArrayWrite(vec, &next));
  petsc(DMSetCoordinateSection(dm, 2, section));
  petsc(DMSetCoordinatesLocal(dm, vec));
}

/// Coordinates that cells on a torus have of their own.
void set_own_corners(MPI_Comm comm, DM dm, const PlainMesh& mesh) {
  DM at_vertices = nullptr;
  OwnedDM in_cells;
  petsc(DMGetCoordinateDM(dm, &at_vertices));
  petsc(DMClone(at_vertices, in_cells.put()));
  petsc(DMSetCellCoordinateDM(dm, in_cells));
  const auto cells = static_cast<PetscInt>(mesh.cells.size());
  const OwnedSection section = section_of(comm, 0, cells);
  for (PetscInt cell = 0; cell < cells; ++cell)
    if (mesh.own[cell] >= 0) give(section, cell, static_cast<PetscInt>(corners_of(mesh.cells[cell]).size()));
  const OwnedVec vec = coordinates(section);
  PetscScalar* next = nullptr;
  petsc(VecGetArrayWrite(vec, &next));
  PetscScalar* const values = next;
  for (PetscInt cell = 0; cell < cells; ++cell) {
    if (mesh.own[cell] < 0) continue;
    const CellGeometry geometry = mesh.cell(cell);
    for (std::size_t k = 0; k < geometry.size(); ++k)
      for (const double component : geometry.corners[k]) *next++ = component;
  }
  next = values;
  petsc(VecRestoreArrayWrite(vec, &next));
  petsc(DMSetCellCoordinateSection(dm, 2, section));
  petsc(DMSetCellCoordinatesLocal(dm, vec));
}

}  // namespace

OwnedDM plex_of(MPI_Comm comm, const PlainMesh& mesh) {
  OwnedDM dm;
  petsc(DMCreate(comm, dm.put()));
  petsc(DMSetType(dm, DMPLEX));
  petsc(DMSetDimension(dm, 2));
  set_cells(dm, mesh);
  petsc(DMSetCoordinateDim(dm, 2));
  set_positions(comm, dm, mesh);
  int is_torus = mesh.is_torus();
  MPI_Bcast(&is_torus, 1, MPI_INT, 0, comm);
  if (is_torus) set_own_corners(comm, dm, mesh);
  return dm;
}

}  // namespace slipscale::mesh_stages
