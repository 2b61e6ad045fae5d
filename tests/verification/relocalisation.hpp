#pragma once

#include <filesystem>

#include "cells_checks.hpp"
#include "grids.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/homogenize/localisation_file.hpp"
#include "slipscale/relocalize/localisation_reader.hpp"
#include "slipscale/relocalize/relocalisation.hpp"

namespace slipscale::testing_support {

using Tensors = std::vector<PlaneTensor>;

const inline Material soft = isotropic(30e9, 0.3, 1), stiff = isotropic(80e9, 0.3, 1);

inline Eigen::Vector3d vector(const PlaneTensor& t) { return {t[0], t[1], t[2]}; }

/// What `homogenize` finds of the mesh, by way of its file.
inline LocalisationTensors homogenised(const Mesh& mesh, const std::vector<Material>& materials) {
  const std::string folder = scratch("cell");
  std::filesystem::create_directories(folder);
  write_localisation(PETSC_COMM_WORLD, mesh, materials, solve(mesh, materials), folder);
  return read_localisation(PETSC_COMM_WORLD, folder);
}

/// A coarse mesh of the homogeneous block, with its corner at the origin.
inline PlaneGrid macro_block(double width, double height) {
  Block block = distorted_blocks(6, 5, 0.2)[2];
  block.width = width;
  block.height = height;
  return block_grid(block);
}

/// Relocalised stress of all targets, on every rank: each computes its share.
inline Tensors relocalised(const LocalisationTensors& tensors, const PlaneGrid& macro, const Targets& targets,
                           const Tensors& macro_strain) {
  const int rank = rank_of(PETSC_COMM_WORLD), ranks = ranks_of(PETSC_COMM_WORLD);
  const RankShare mine = rank_share(targets.sites.size(), rank, ranks);
  Relocalisation relocalize(tensors, macro, Recovery::nodal,
                            std::span(targets.sites).subspan(mine.begin, mine.count()));
  Tensors stress(relocalize.places()), all(targets.sites.size());
  relocalize.macroscopic(macro_strain, stress);
  relocalize.stress(stress, stress);
  std::vector<int> counts(ranks), starts(ranks);
  for (int r = 0; r < ranks; ++r) {
    const RankShare share = rank_share(targets.sites.size(), r, ranks);
    counts[r] = static_cast<int>(3 * share.count());
    starts[r] = static_cast<int>(3 * share.begin);
  }
  MPI_Allgatherv(stress.data(), counts[rank], MPI_DOUBLE, all.data(), counts.data(), starts.data(),
                 MPI_DOUBLE, PETSC_COMM_WORLD);
  return all;
}

inline Tensors uniform(const PlaneGrid& macro, const PlaneTensor& strain) {
  return Tensors(static_cast<std::size_t>(macro.cells()), strain);
}

inline Targets tiles(const LocalisationTensors& tensors, const PlaneGrid& macro, const Vector2& origin) {
  return TwoScales(macro, tensors.grid, tiling(tensors.grid, true, bounding_box(macro), origin)).tiles();
}

}  // namespace slipscale::testing_support
