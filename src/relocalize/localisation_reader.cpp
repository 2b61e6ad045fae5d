#include "slipscale/relocalize/localisation_reader.hpp"

#include "slipscale/base/error.hpp"
#include "slipscale/files/grid_file.hpp"

namespace slipscale {
namespace {

std::vector<Eigen::Matrix3d> matrices(const GridFile& file, const std::string& dataset, std::size_t count) {
  const std::vector<double> rows = file.reals(dataset);
  if (rows.size() != 9 * count) throw LibraryError(dataset + " does not have the expected shape");
  std::vector<Eigen::Matrix3d> all;
  all.reserve(count);
  for (std::size_t k = 0; k < count; ++k)
    all.push_back(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows.data() + 9 * k));
  return all;
}

}  // namespace

LocalisationTensors read_localisation(MPI_Comm comm, const std::string& path, const std::string& option) {
  const GridFile file(comm, {path, "localization.h5", option, "run homogenize for that folder"});
  for (const char* dataset : {"/cell/localisation", "/region/stiffness", "/effective/stiffness"})
    file.refuse_unless(file.has(dataset),
                       "has no " + std::string(dataset) + ", so it is not a localization.h5");
  LocalisationTensors tensors;
  tensors.grid = file.grid();
  file.together([&] {
    tensors.localisation = matrices(file, "/cell/localisation", tensors.grid.region.size());
    tensors.stiffness = matrices(file, "/region/stiffness", tensors.grid.regions.size());
    tensors.effective = matrices(file, "/effective/stiffness", 1).front();
    tensors.boundary = file.texts("/effective/stiffness", "boundary").front();
    if (file.texts("/region/stiffness", "names") != tensors.grid.regions)
      throw LibraryError("/region/stiffness is not of the regions of /mesh/region");
  });
  return tensors;
}

}  // namespace slipscale
