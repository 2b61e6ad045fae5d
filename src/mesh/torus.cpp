#include <algorithm>
#include <cmath>
#include <map>

#include "slipscale/base/print.hpp"
#include "stages.hpp"

namespace slipscale::mesh_stages {
namespace {

std::string too_narrow(const MeshSource& source, const Vector2& place) {
  return "mesh '" + source.file + "' has fewer than three cells across a period near " +
         format("(%g, %g) m", place[0], place[1]) + "; mesh it finer";
}

}  // namespace

void settle_seam(DM dm) {
  PetscBool is_torus = PETSC_FALSE;
  petsc(DMGetCoordinatesLocalized(dm, &is_torus));
  if (!is_torus) return;
  PetscInt begin = 0, end = 0;
  petsc(DMPlexGetHeightStratum(dm, 0, &begin, &end));
  std::map<PetscInt, Vector2> lowest;
  for (PetscInt cell = begin; cell < end; ++cell) {
    const auto geometry = cell_geometry(dm, cell);
    for (std::size_t k = 0; k < geometry.vertices.size() && k < geometry.corners.size(); ++k) {
      const auto [known, is_new] = lowest.try_emplace(geometry.vertices[k], geometry.corners[k]);
      if (!is_new) known->second = std::min(known->second, geometry.corners[k]);
    }
  }
  Vec old = nullptr;
  OwnedVec moved;
  PetscSection section = nullptr;
  petsc(DMGetCoordinatesLocal(dm, &old));
  petsc(DMGetCoordinateSection(dm, &section));
  petsc(VecDuplicate(old, moved.put()));
  petsc(VecCopy(old, moved));
  PetscScalar* values = nullptr;
  petsc(VecGetArray(moved, &values));
  for (const auto& [vertex, position] : lowest) {
    PetscInt offset = 0;
    petsc(PetscSectionGetOffset(section, vertex, &offset));
    std::copy(position.begin(), position.end(), values + offset);
  }
  petsc(VecRestoreArray(moved, &values));
  petsc(DMSetCoordinatesLocal(dm, moved));
}

std::string fault_in_torus(DM dm, const MeshSource& source) {
  PetscBool is_torus = PETSC_FALSE;
  petsc(DMGetCoordinatesLocalizedLocal(dm, &is_torus));
  if (!is_torus) return "";
  PetscInt begin = 0, end = 0;
  petsc(DMPlexGetHeightStratum(dm, 0, &begin, &end));
  std::map<std::pair<PetscInt, PetscInt>, Vector2> link;
  for (PetscInt cell = begin; cell < end; ++cell) {
    const auto geometry = cell_geometry(dm, cell);
    const std::size_t corners = geometry.corners.size(), vertices = geometry.vertices.size();
    if (vertices < corners && corners <= 4) return too_narrow(source, geometry.corners[0]);
    if (vertices != corners) continue;
    const double size = std::sqrt(std::abs(geometry.area()));
    for (std::size_t a = 0; a < geometry.vertices.size(); ++a)
      for (std::size_t b = a + 1; b < geometry.vertices.size(); ++b) {
        auto va = geometry.vertices[a], vb = geometry.vertices[b];
        Vector2 d{geometry.corners[b][0] - geometry.corners[a][0],
                  geometry.corners[b][1] - geometry.corners[a][1]};
        if (va > vb) {
          std::swap(va, vb);
          d = {-d[0], -d[1]};
        }
        const auto [known, is_new] = link.try_emplace({va, vb}, d);
        if (va == vb ||
            (!is_new && std::hypot(known->second[0] - d[0], known->second[1] - d[1]) > 0.5 * size))
          return too_narrow(source, geometry.corners[a]);
      }
  }
  return "";
}

}  // namespace slipscale::mesh_stages
