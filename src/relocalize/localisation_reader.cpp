#include "slipscale/relocalize/localisation_reader.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <string_view>

#include "slipscale/base/error.hpp"
#include "slipscale/files/grid_file.hpp"

namespace slipscale {
namespace {

constexpr std::array<std::string_view, 3> boundaries{"periodic", "kubc", "subc"};

void require(bool fine, const std::string& fault) {
  if (!fine) throw LibraryError(fault);
}

/// Of a cell of this area that the mesh fills but for its holes; 0 where rounding leaves no other.
double area_of_holes(const PlaneGrid& grid, double cell) {
  const std::vector<double> parts = areas(grid);
  const double solid = std::accumulate(parts.begin(), parts.end(), 0.0);
  return cell > (1 + 1e-9) * solid ? cell - solid : 0;
}

std::vector<Eigen::Matrix3d> matrices(const GridFile& file, const std::string& dataset, std::size_t count) {
  const std::vector<double> rows = file.reals(dataset);
  require(rows.size() == 9 * count, dataset + " does not have the expected shape");
  std::vector<Eigen::Matrix3d> all;
  all.reserve(count);
  for (std::size_t k = 0; k < count; ++k)
    all.push_back(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows.data() + 9 * k));
  return all;
}

double largest(const Eigen::Matrix3d& m) { return m.cwiseAbs().maxCoeff(); }

/// A solid resists every strain, with a stiffness that follows from an energy.
void refuse_no_solid(const Eigen::Matrix3d& c, const std::string& where) {
  constexpr double solver = 1e-3;  // what a user's loose tolerance may leave
  require(largest(c - c.transpose()) <= solver * largest(c), where + " is not symmetric");
  const Eigen::Matrix3d symmetric = 0.5 * (c + c.transpose());
  require(Eigen::LLT<Eigen::Matrix3d>(symmetric).info() == Eigen::Success,
          where + " is not positive definite");
}

/// ⟨A⟩ = I and ⟨C:A⟩ = C_eff hold for every solution, converged or not, but for rounding: other tensors are
/// damaged, or those of another mesh. Where there are holes, ⟨A⟩ is not known from the solid alone.
void refuse_other_means(const LocalisationTensors& tensors) {
  constexpr double rounding = 1e-9;
  Eigen::Matrix3d strain = Eigen::Matrix3d::Zero(), stress = Eigen::Matrix3d::Zero();
  double solid = 0;
  for (int cell = 0; cell < tensors.grid.cells(); ++cell) {
    const double part = area(tensors.grid, cell);
    const Eigen::Matrix3d& a = tensors.localisation[cell];
    solid += part;
    strain += part * a;
    stress += part * (tensors.stiffness[tensors.grid.region[cell]] * a);
  }
  if (tensors.hole_area == 0)
    require(largest(strain / solid - Eigen::Matrix3d::Identity()) <= rounding,
            "the mean of /cell/localisation is not the identity");
  require(largest(stress / (solid + tensors.hole_area) - tensors.effective) <=
              rounding * largest(tensors.effective),
          "the mean of C : A is not /effective/stiffness");
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
    require(file.texts("/region/stiffness", "names") == tensors.grid.regions,
            "/region/stiffness is not of the regions of /mesh/region");
    if (file.has_attribute("/effective/stiffness", "cell_area"))
      tensors.hole_area = area_of_holes(tensors.grid, file.number("/effective/stiffness", "cell_area"));
    if (file.has_attribute("/effective/stiffness", "mesh_checksum"))
      tensors.mesh_checksum = file.texts("/effective/stiffness", "mesh_checksum").front();
    for (std::size_t k = 0; k < tensors.stiffness.size(); ++k)
      refuse_no_solid(tensors.stiffness[k], "/region/stiffness of '" + tensors.grid.regions[k] + "'");
    refuse_no_solid(tensors.effective, "/effective/stiffness");
    require(std::ranges::count(boundaries, tensors.boundary) == 1,
            "boundary '" + tensors.boundary + "' is none of homogenize");
    refuse_other_means(tensors);
  });
  return tensors;
}

}  // namespace slipscale
