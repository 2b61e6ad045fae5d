#pragma once

#include <array>
#include <string>

#include "slipscale/cell/cell_problem.hpp"
#include "slipscale/record/hdf5.hpp"
#include "slipscale/record/mesh_image.hpp"

namespace slipscale {

/// The datasets of the local stress, one for each load case, and the macroscopic strain of that case.
inline constexpr std::array<const char*, load_cases> stress_names{"stress_xx", "stress_yy", "stress_xy"};
inline constexpr std::array<const char*, load_cases> strain_names{"xx", "yy", "xy"};

struct LocalizationLayout {
  std::string data_file;
  MeshImage::Topology topology = MeshImage::Topology::triangles;
  PetscInt points = 0, cells = 0;
  hsize_t stream_length = 0;  ///< mixed: entries of /mesh/cells
};

/// The whole of localization.xdmf.
std::string localization_xdmf(const LocalizationLayout& layout);

}  // namespace slipscale
