#include "slab_run.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes.hpp"

namespace slipscale::testing_support {
namespace {

constexpr double period = 2 * std::numbers::pi;
/// The slab must neither open nor stick: the seed is small against pressure/ρc and against the speed, for a
/// growth by e^10 and more. In full slip the motion is linear, so that no other number matters.
constexpr double pressure = 1, seed = 1e-8, speed = 10;

Block block_of(const SlidingSlab& slab, const SlabMesh& mesh) {
  Block block;
  block.width = period;
  block.height = slab.height;
  block.nx = mesh.elements;
  block.ny = static_cast<int>(std::lround(slab.height / period * mesh.elements));
  block.shape = Shape::quadrilaterals;
  block.periodic_x = true;
  return block;
}

/// The exact uniform sliding state, top held where that puts it, and the seed.
Scene scene_of(const SlidingSlab& slab, const SlabMesh& mesh) {
  Scene scene;
  scene.conditions = {{"top", {0.0, 0.0}, 0, 0, 0}};
  scene.initial.pressure = pressure;
  scene.initial.shear = slab.friction * pressure;
  scene.initial.amplitude = seed;
  scene.initial.wavelength = mesh.seed_wavelength > 0 ? mesh.seed_wavelength : period;
  scene.damping.stiffness = slab.damping;
  scene.surface = Surface{"bottom", 0, speed, 0};
  scene.friction.law = FrictionChoice::Law::regularized;
  scene.friction.coefficient = slab.friction;
  scene.friction.time = slab.relaxation_time;
  return scene;
}

/// u_x of the contact nodes by their place along x; nodes of other ranks come by a sum with zeros.
std::vector<double> bottom(const SlidingBody& body, int elements) {
  std::vector<double> along_x(static_cast<std::size_t>(elements), 0);
  for (const int node : body.contact().node) {
    const double x = body.model().mesh.nodes.position[node][0];
    along_x[static_cast<std::size_t>(std::lround(x / period * elements) % elements)] =
        body.next_displacement()[node][0];
  }
  MPI_Allreduce(MPI_IN_PLACE, along_x.data(), elements, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  return along_x;
}

}  // namespace

std::vector<Complex> SlabMotion::component(int wave_number, double start) const {
  std::vector<Complex> series;
  for (auto n = static_cast<std::size_t>(start / interval); n < displacement.size(); ++n) {
    const std::vector<double>& u = displacement[n];
    const double part = 1 / static_cast<double>(u.size());
    Complex sum = 0;
    for (std::size_t j = 0; j < u.size(); ++j)
      sum += u[j] * std::polar(2 * part, -period * wave_number * part * static_cast<double>(j));
    series.push_back(sum);
  }
  return series;
}

SlabMotion run_slab(const SlidingSlab& slab, const SlabMesh& choice) {
  const Mesh mesh = block_mesh(block_of(slab, choice));
  const Model model(mesh, {{slab.stiffness, slab.density, "slab"}}, Model::Storage::full);
  const double wanted = 0.4 * 2 / largest_frequency(PETSC_COMM_WORLD, model).sharp;
  const long between = std::lround(std::ceil(choice.sample_interval / wanted));
  const double step = choice.sample_interval / static_cast<double>(between);
  SlidingBody body(PETSC_COMM_WORLD, model, scene_of(slab, choice), step);
  SlabMotion motion{choice.sample_interval, step, {}, true};
  const long samples = std::lround(choice.end / choice.sample_interval);
  for (long sample = 0; sample < samples; ++sample) {
    for (long n = 0; n < between; ++n) {
      body.advance(false);
      for (const ContactStatus status : body.contact().status)
        motion.always_slipping = motion.always_slipping && status == ContactStatus::slip;
    }
    motion.displacement.push_back(bottom(body, choice.elements));
  }
  MPI_Allreduce(MPI_IN_PLACE, &motion.always_slipping, 1, MPI_CXX_BOOL, MPI_LAND, PETSC_COMM_WORLD);
  return motion;
}

std::vector<Complex> exponents(const std::vector<Complex>& series, double interval, double noise) {
  const auto total = static_cast<Eigen::Index>(series.size()), pencil = total / 3;
  Eigen::MatrixXcd hankel(total - pencil, pencil + 1);
  for (Eigen::Index row = 0; row < hankel.rows(); ++row)
    for (Eigen::Index column = 0; column <= pencil; ++column)
      hankel(row, column) = series[static_cast<std::size_t>(row + column)];
  const Eigen::BDCSVD<Eigen::MatrixXcd> svd(hankel, Eigen::ComputeThinV);
  const auto& size = svd.singularValues();
  const Eigen::Index rank = (size.array() > noise * size(0)).count();
  // Rows of conj(V) span the samples; leaving out the last or the first shifts them by one interval.
  const Eigen::MatrixXcd span = svd.matrixV().leftCols(rank).conjugate();
  const Eigen::VectorXcd factors = span.topRows(pencil)
                                       .completeOrthogonalDecomposition()
                                       .solve(span.bottomRows(pencil))
                                       .eval()
                                       .eigenvalues();
  std::vector<Complex> found;
  for (const Complex& factor : factors) found.push_back(std::log(factor) / interval);
  return found;
}

Complex nearest(const std::vector<Complex>& found, Complex expected) {
  return *std::min_element(found.begin(), found.end(), [&](const Complex& a, const Complex& b) {
    return std::abs(a - expected) < std::abs(b - expected);
  });
}

}  // namespace slipscale::testing_support
