#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cells_checks.hpp"
#include "cells_composite.hpp"
#include "report.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

using Local = Eigen::Matrix<double, 1, 6>;  ///< strain, and stress in GPa

struct DiscCell {
  Mesh mesh;
  std::vector<Material> materials;
  CellSolution solution;
  double size;  ///< of an element, m

  /// Strain and stress at `x` under a load case: a polynomial of degree 2 through the means of the
  /// inclusion's cells whose centres lie within `reach`, by least squares.
  Local inside(const Vector2& x, int load_case, double reach) const;
};

DiscCell disc_cell(int elements, CellShape shape) {
  DiscCell cell{drawn_mesh(disc_array(Arrangement::square, 0.4, elements, shape)), {}, {}, 1.0 / elements};
  cell.materials = two_materials(cell.mesh, isotropic(30e9, 0.3, 1), isotropic(80e9, 0.3, 1));
  cell.solution = solve(cell.mesh, cell.materials);
  return cell;
}

Local DiscCell::inside(const Vector2& x, int load_case, double reach) const {
  constexpr int terms = 6;
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(terms, terms), right = Eigen::MatrixXd::Zero(terms, 6);
  for (int c = 0; c < mesh.cells.size(); ++c) {
    const int region = mesh.cells.region[c];
    if (!mesh.cells.owned[c] || mesh.regions[region].name != "inclusion") continue;
    double dx = -x[0] / reach, dy = -x[1] / reach;
    const double share = 1 / (reach * mesh.cells.corner_count(c));
    for (int i = mesh.cells.first[c]; i < mesh.cells.first[c + 1]; ++i) {
      dx += share * mesh.cells.corners[i][0];
      dy += share * mesh.cells.corners[i][1];
    }
    if (std::hypot(dx, dy) > 1) continue;
    const Eigen::Vector<double, terms> basis{1, dx, dy, dx * dx, dx * dy, dy * dy};
    Local values;
    values.head<3>() = solution.localisation[c].col(load_case);
    values.tail<3>() = 1e-9 * materials[region].stiffness * solution.localisation[c].col(load_case);
    normal += basis * basis.transpose();
    right += basis * values;
  }
  for (Eigen::MatrixXd* sum : {&normal, &right})
    MPI_Allreduce(MPI_IN_PLACE, sum->data(), static_cast<int>(sum->size()), MPI_DOUBLE, MPI_SUM,
                  PETSC_COMM_WORLD);
  return normal.ldlt().solve(right).row(0);
}

const std::string topic = "Square array of discs, f .4, 30/80 GPa, local values",
                  source = "complex potentials, disc_arrays.py";

/// Cells of 32, 64 and 128 elements.
using Refinement = std::array<DiscCell, 3>;

double order(const std::array<double, 3>& errors) { return 0.5 * std::log2(errors[0] / errors[2]); }

/// Against the exact fields (disc_arrays.py). The mean of a cell is off by O(h) from the strain at a point of
/// it; a polynomial of degree 2 through the means within 4h of the centre is off by O(h²), as the
/// discretisation is. The bound is the one asked of the moduli: .05 % (of E_xx, of σ_xx) at 64 elements, and
/// a quarter of it at 128.
void check_centre(const Refinement& cells, const std::string& elements) {
  constexpr double bound = 5e-4;
  const Vector2 centre{0.5, 0.5};
  const Local expected{.65887909, -.07473903, 0, 67.506716, 22.360986, 0};
  std::array<double, 3> errors{};
  Local stretch, shear;
  for (int k = 0; k < 3; ++k) {
    stretch = cells[k].inside(centre, 0, 4 * cells[k].size);
    shear = 2 * cells[k].inside(centre, 2, 4 * cells[k].size);  // E_xy = 1 is γ = 2
    errors[k] = std::max({(stretch - expected).head<3>().cwiseAbs().maxCoeff(),
                          (stretch - expected).tail<3>().cwiseAbs().maxCoeff() / expected[3],
                          std::abs(shear[5] / 31.595221 - 1)});
  }
  EXPECT_LE(errors[1], bound) << elements;
  EXPECT_LE(errors[2], bound / 4) << elements;
  EXPECT_GE(order(errors), 2 - 0.25) << elements;  // meshes that are not nested: see cells_arrays.cpp
  const std::string shown = format("{:.2f}", order(errors));
  report({topic, "centre, E_xx = 1: strain xx; yy, " + elements, "0.658879; -0.074739 +- 1.25e-4",
          format("{:.6f}; {:.6f}", stretch[0], stretch[1]), shown, source});
  report({topic, "centre, E_xx = 1: stress xx; yy, GPa, " + elements, "67.5067; 22.3610 +- 0.0084",
          format("{:.4f}; {:.4f}", stretch[3], stretch[4]), shown, source});
  report({topic, "centre, E_xy = 1: stress xy, GPa, " + elements, "31.5952 +- 0.0039",
          format("{:.4f}", shear[5]), shown, source});
}

/// σ_xx at θ = 0 (disc_arrays.py), the same on either side. Extrapolated from the inclusion's cells within
/// R = 6h by a polynomial of degree 2; the field is smooth there, and the mean strain of the cells at the
/// interface is off by O(h) times its gradient, 2.8 GPa per radius: h/r · 2.8 GPa = .06 GPa at 128 elements.
void check_interface(const Refinement& cells, const std::string& elements) {
  const double radius = std::sqrt(0.4 / std::numbers::pi), expected = 70.27563;
  std::array<double, 3> errors{};
  double stress = 0;
  for (int k = 0; k < 3; ++k) {
    stress = cells[k].inside({0.5 + radius, 0.5}, 0, 6 * cells[k].size)[3];
    errors[k] = std::abs(stress - expected);
    EXPECT_LE(errors[k], 2.8 * cells[k].size / radius) << elements;
  }
  EXPECT_GE(order(errors), 1) << elements;
  report({topic, "interface at 0 degrees, E_xx = 1: stress xx, GPa, " + elements,
          format("{:.4f} +- {:.2f}", expected, 2.8 * cells[2].size / radius), format("{:.4f}", stress),
          format("{:.2f}", order(errors)), source});
}

void check_local(CellShape shape, const char* name) {
  const Refinement cells{disc_cell(32, shape), disc_cell(64, shape), disc_cell(128, shape)};
  const std::string elements = format("128 {} elements per cell", name);
  check_centre(cells, elements);
  check_interface(cells, elements);
}

}  // namespace

TEST(Localisation, HasTheReferenceValuesInTriangles) { check_local(CellShape::triangle, "P1"); }

TEST(Localisation, HasTheReferenceValuesInQuadrilaterals) { check_local(CellShape::quadrilateral, "Q1"); }
