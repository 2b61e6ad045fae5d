#include "slipscale/solid/material.hpp"

#include <algorithm>
#include <cmath>

#include "effective_file.hpp"
#include "graded.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/physical_range.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

const Range poissons_ratio{"> -1 and < 0.5", [](double x) { return x > -1 && x < 0.5; }};

void refuse_unless_six(const std::string& where, std::size_t count) {
  if (count != 6)
    throw UserError(where + " needs six numbers c11,c22,c12,c66,c16,c26 in Pa, but " + std::to_string(count) +
                    " are given");
}

Eigen::Matrix3d voigt(const std::string& where, const std::vector<double>& c) {
  refuse_unless_six(where, c.size());
  const Eigen::Matrix3d stiffness = voigt_stiffness(c);
  if (Eigen::LLT<Eigen::Matrix3d>(stiffness).info() != Eigen::Success)
    throw UserError(where +
                    " is not positive definite; check the order c11,c22,c12,c66,c16,c26 and the signs");
  return stiffness;
}

std::string six_numbers(const Eigen::Matrix3d& c) {
  return format("C11 {:.4g}, C22 {:.4g}, C12 {:.4g}, C66 {:.4g}, C16 {:.3g}, C26 {:.3g} GPa", c(0, 0) * 1e-9,
                c(1, 1) * 1e-9, c(0, 1) * 1e-9, c(2, 2) * 1e-9, c(0, 2) * 1e-9, c(1, 2) * 1e-9);
}

Material from_file(const std::string& option, const std::string& path) {
  const EffectiveFile file = read_effective_file(path, option);
  Material material;
  material.stiffness = voigt("'stiffness' in '" + path + "'", file.stiffness);
  material.density = file.density;
  material.description = six_numbers(material.stiffness) + format(", {:.4g} kg/m3 ({})", file.density, path);
  material.doubt = file.doubt;
  if (!file.doubt.empty()) material.description += "; DOUBTFUL: " + file.doubt;
  return material;
}

std::vector<std::string> options_of(const std::string& region) {
  return names_in(material_schema(), "material_<region>_", region);
}

/// For what a reader needs of a body to take formulas; null: it does not.
struct Body {
  const Mesh* mesh = nullptr;
  int region = 0;
};

void refuse_formula(const std::string& name) {
  throw UserError("-" + name +
                  " is a formula, but phases of a cell are uniform; give numbers (slide and modes take "
                  "formulas)");
}

/// The material written under material_<region>_….
Material read_one(const Options& options, const std::string& region, const Body& body) {
  const std::string prefix = "material_" + region + "_";
  for (const std::string& name : options_of(region))
    if (name != prefix + "file") options.refuse_both(name, prefix + "file");
  for (const char* key : {"young", "poisson"}) options.refuse_both(prefix + key, prefix + "stiffness");
  if (const auto path = options.find_text(prefix + "file")) return from_file(prefix + "file", *path);
  std::vector<GradedConstant> constants;
  const auto add = [&](const std::string& key, const Quantity& quantity) {
    if (quantity.formula && !body.mesh) refuse_formula(prefix + key);
    constants.push_back({prefix + key, quantity});
  };
  if (options.given(prefix + "stiffness")) {
    const auto six = options.quantities(prefix + "stiffness");
    refuse_unless_six("-" + prefix + "stiffness", six.size());
    for (const Quantity& each : six) add("stiffness", each);
  } else {
    add("young", options.quantity(prefix + "young"));
    add("poisson", options.quantity(prefix + "poisson"));
  }
  add("density", options.quantity(prefix + "density"));
  if (std::ranges::any_of(constants,
                          [](const GradedConstant& each) { return each.value.formula != nullptr; }))
    return graded_material(options, *body.mesh, body.region, constants);
  std::vector<double> numbers;
  for (const GradedConstant& each : constants) numbers.push_back(each.value.number);
  Material material;
  material.density = numbers.back();
  numbers.pop_back();
  if (numbers.size() == 6) {
    material.stiffness = voigt("-" + prefix + "stiffness", numbers);
    material.description = six_numbers(material.stiffness);
  } else {
    material.stiffness = isotropic_stiffness(numbers[0], numbers[1]);
    material.description = format("E {:.4g} GPa, nu ", numbers[0] * 1e-9) + apart_from(0.5, numbers[1], 4);
  }
  material.description += format(", {:.4g} kg/m3", material.density);
  return material;
}

bool mentioned(const Options& options, const std::string& region) {
  const auto names = options_of(region);
  return std::any_of(names.begin(), names.end(), [&](const auto& name) { return options.given(name); });
}

/// A material for all others is idle where there are no others.
void refuse_idle_shares(const Options& options, const std::vector<std::string>& regions) {
  std::vector<std::string> own, shared = options_of("all");
  for (const std::string& region : regions) {
    if (region == "all" || !mentioned(options, region)) return;
    const auto names = options_of(region);
    own.insert(own.end(), names.begin(), names.end());
  }
  shared.push_back("material_file");
  options.refuse_idle(shared,
                      {"since every region has a material of its own", "remove that of a region", own});
}

}  // namespace

Eigen::Matrix3d isotropic_stiffness(double young, double poisson) {
  const double shear = young / (2 * (1 + poisson));
  const double lame = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  Eigen::Matrix3d c = Eigen::Matrix3d::Zero();
  c(0, 0) = c(1, 1) = lame + 2 * shear;
  c(0, 1) = c(1, 0) = lame;
  c(2, 2) = shear;
  return c;
}

Eigen::Matrix3d voigt_stiffness(std::span<const double> c) {
  Eigen::Matrix3d stiffness;
  stiffness << c[0], c[2], c[4], c[2], c[1], c[5], c[4], c[5], c[3];
  return stiffness;
}

WaveSpeeds wave_speeds(const Material& material, double nx, double ny) {
  return wave_speeds(Solid{material.stiffness, material.density}, nx, ny);
}

WaveSpeeds wave_speeds(const Solid& material, double nx, double ny) {
  Eigen::Matrix<double, 3, 2> direction;
  direction << nx, 0, 0, ny, ny, nx;
  const Eigen::Matrix2d acoustic = direction.transpose() * material.stiffness * direction;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(acoustic, Eigen::EigenvaluesOnly);
  return {std::sqrt(solver.eigenvalues()[1] / material.density),
          std::sqrt(solver.eigenvalues()[0] / material.density)};
}

bool nearly_incompressible(const Eigen::Matrix3d& c) {
  constexpr double locking = 0.49, rounding = 1e-9;
  const double bulk = 0.25 * (c(0, 0) + c(1, 1) + c(0, 1) + c(1, 0));
  const double shear = 0.5 * (0.25 * (c(0, 0) + c(1, 1) - c(0, 1) - c(1, 0)) + c(2, 2));
  return (bulk - shear) / (2 * bulk) > locking + rounding;
}

bool nearly_incompressible(const Material& material) {
  return material.grading ? material.grading->locks : nearly_incompressible(material.stiffness);
}

Schema material_schema() {
  return {
      {"material_<region>_young", Kind::real, "Pa", required,
       range::or_formula(range::physical_positive, "xy"),
       "Young's modulus; of a graded body a formula, as the other constants: each cell has their values at "
       "the "
       "mean of its corners (slide and modes)"},
      {"material_<region>_poisson", Kind::real, "1", required, range::or_formula(poissons_ratio, "xy"),
       "Poisson's ratio"},
      {"material_<region>_stiffness", Kind::reals, "Pa", absent, range::or_formula(range::physical, "xy"),
       "c11,c22,c12,c66,c16,c26 in plane strain, in place of young and poisson"},
      {"material_<region>_density", Kind::real, "kg/m3", required,
       range::or_formula(range::physical_positive, "xy"), "mass density"},
      {"material_<region>_file", Kind::text, "", absent, range::any,
       "effective.yaml of a homogenised material: stiffness and density"},
      {"material_file", Kind::text, "", absent, range::any,
       "the same for every region that is not named (short for material_all_file)"},
  };
}

namespace {

std::vector<Material> read_all(const Options& options, const std::vector<std::string>& regions,
                               const Mesh* mesh) {
  std::vector<Material> materials;
  for (const std::string& key : options_of("all")) options.refuse_both("material_file", key);
  refuse_idle_shares(options, regions);
  const bool shared = mentioned(options, "all");
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const std::string own = "material_" + regions[r] + "_";
    const Body body{mesh, static_cast<int>(r)};
    if (mentioned(options, regions[r]))
      materials.push_back(read_one(options, regions[r], body));
    else if (const auto shared_file = options.find_text("material_file"))
      materials.push_back(from_file("material_file", *shared_file));
    else if (shared)
      materials.push_back(read_one(options, "all", body));
    else
      throw UserError("region '" + regions[r] + "' has no material; give -" + own + "young, -" + own +
                      "poisson and -" + own + "density, or one for every region under material_all_");
  }
  return materials;
}

}  // namespace

std::vector<Material> read_materials(const Options& options, const std::vector<std::string>& regions) {
  return read_all(options, regions, nullptr);
}

std::vector<Material> read_materials(const Options& options, const Mesh& mesh) {
  return read_all(options, mesh.region_names(), &mesh);
}

}  // namespace slipscale
