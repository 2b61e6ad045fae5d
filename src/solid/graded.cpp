#include "graded.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

constexpr double nowhere = std::numeric_limits<double>::infinity();

Vector2 middle_of(std::span<const Vector2> corners) {
  Vector2 sum{};
  for (const Vector2& x : corners) sum = {sum[0] + x[0], sum[1] + x[1]};
  const auto count = static_cast<double>(corners.size());
  return {sum[0] / count, sum[1] / count};
}

/// The constants of one cell; what is wrong with them, or nothing.
std::string evaluate(const Options& options, const std::vector<GradedConstant>& constants, const Vector2& at,
                     Solid& solid) {
  std::array<double, 7> numbers{};
  for (std::size_t k = 0; k < constants.size(); ++k) {
    const Quantity& value = constants[k].value;
    numbers[k] = value.at(at, 0);
    if (!value.formula) continue;
    if (const std::string fault = options.outside(constants[k].option, value, numbers[k]); !fault.empty())
      return fault;
  }
  const bool isotropic = constants.size() == 3;
  solid.density = numbers[constants.size() - 1];
  solid.stiffness =
      isotropic ? isotropic_stiffness(numbers[0], numbers[1]) : voigt_stiffness(std::span(numbers).first(6));
  if (!isotropic && Eigen::LLT<Eigen::Matrix3d>(solid.stiffness).info() != Eigen::Success)
    return "-" + constants.front().option +
           " is not positive definite; check the order c11,c22,c12,c66,c16,c26 and the signs";
  return "";
}

/// The solid for which `size` is least over all cells of the region, of several the one of the cell with the
/// lowest number. Collective.
template <class Size>
Solid least(const Mesh& mesh, int region, const std::vector<Solid>& of_cell, const Size& size) {
  double lowest = nowhere;
  PetscInt number = PETSC_MAX_INT;
  int found = -1;
  for (int cell = 0; cell < mesh.cells.size(); ++cell)  // ascending numbers
    if (mesh.cells.region[cell] == region && size(of_cell[cell]) < lowest)
      lowest = size(of_cell[cell]), found = cell;
  const double own = lowest;
  MPI_Allreduce(MPI_IN_PLACE, &lowest, 1, MPI_DOUBLE, MPI_MIN, mesh.comm);
  if (found >= 0 && own == lowest) number = mesh.cells.number[found];
  const PetscInt mine = number;
  MPI_Allreduce(MPI_IN_PLACE, &number, 1, MPIU_INT, MPI_MIN, mesh.comm);
  std::array<double, 10> facts;
  facts.fill(-nowhere);
  if (found >= 0 && own == lowest && mine == number) {
    std::copy_n(of_cell[found].stiffness.data(), 9, facts.data());
    facts[9] = of_cell[found].density;
  }
  MPI_Allreduce(MPI_IN_PLACE, facts.data(), 10, MPI_DOUBLE, MPI_MAX, mesh.comm);
  return {Eigen::Matrix3d::Map(facts.data()), facts[9]};
}

std::string text_of(const Quantity& value, double unit, const std::string& name) {
  return value.formula ? value.formula->text() : format("{:.4g}{}", value.number / unit, name);
}

std::string description_of(const std::vector<GradedConstant>& constants) {
  std::string text;
  if (constants.size() == 3) {
    text = "E " + text_of(constants[0].value, 1e9, " GPa") + ", nu " + text_of(constants[1].value, 1, "");
  } else {
    const char* names[] = {"C11", "C22", "C12", "C66", "C16", "C26"};
    for (int k = 0; k < 6; ++k)
      text += (k ? ", " : "") + std::string(names[k]) + " " + text_of(constants[k].value, 1e9, " GPa");
  }
  return text + ", density " + text_of(constants.back().value, 1, " kg/m3") + ", graded";
}

}  // namespace

Material graded_material(const Options& options, const Mesh& mesh, int region,
                         const std::vector<GradedConstant>& constants) {
  auto grading = std::make_shared<Grading>();
  grading->of_cell.resize(static_cast<std::size_t>(mesh.cells.size()));
  std::string fault;
  int locks = 0;
  for (int cell = 0; cell < mesh.cells.size() && fault.empty(); ++cell) {
    if (mesh.cells.region[cell] != region) continue;
    const Vector2 at = middle_of(mesh.cells.corners_of(cell));
    Solid& solid = grading->of_cell[cell];
    fault = evaluate(options, constants, at, solid);
    if (!fault.empty())
      fault += format(", in cell {} of region '{}' at x = {:g} m, y = {:g} m", mesh.cells.number[cell],
                      mesh.regions[region].name, at[0], at[1]);
    grading->modulus = std::max(grading->modulus, solid.stiffness.cwiseAbs().maxCoeff());
    locks = locks || nearly_incompressible(solid.stiffness);
  }
  throw_together(mesh.comm, fault);
  MPI_Allreduce(MPI_IN_PLACE, &grading->modulus, 1, MPI_DOUBLE, MPI_MAX, mesh.comm);
  MPI_Allreduce(MPI_IN_PLACE, &locks, 1, MPI_INT, MPI_MAX, mesh.comm);
  grading->locks = locks != 0;
  grading->fastest = least(mesh, region, grading->of_cell,
                           [](const Solid& solid) { return -wave_speeds(solid, 0, 1).fast; });
  const Solid slowest =
      least(mesh, region, grading->of_cell, [](const Solid& solid) { return wave_speeds(solid, 0, 1).slow; });
  return {slowest.stiffness, slowest.density, description_of(constants), "", std::move(grading)};
}

}  // namespace slipscale
