// What a homogenisation says of itself.
#include "slipscale/homogenize/homogenised.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "slipscale/base/print.hpp"
#include "slipscale/base/readable.hpp"

namespace slipscale {
namespace {

using Rows = std::vector<std::vector<std::string>>;

constexpr double giga = 1e-9;      ///< GPa in a Pa
constexpr double rounding = 1e-8;  ///< what solver and rounding may add, relative
constexpr std::array<const char*, 3> voigt_names{"xx", "yy", "xy"};

std::string gpa(double pascal) { return format("{:#.6g}", pascal * giga); }
std::string gpa_apart(double limit, double pascal) {
  const std::string shown = gpa(pascal);
  return shown == gpa(limit) ? apart_from(limit * giga, pascal * giga, 6) : shown;
}

/// GPa to so many decimals that the error bar shows two digits, or the largest entry six where there is none.
class GigaPascal {
 public:
  GigaPascal(const Eigen::Matrix3d& c, const std::optional<Richardson>& error) : error_(error) {
    const double size = giga * c.cwiseAbs().maxCoeff();
    const double bar = error ? giga * error->error.cwiseAbs().maxCoeff() : 0;
    const int six = 5 - exponent(size), two = 1 - exponent(bar);
    decimals_ = std::clamp(bar > 0 ? std::min(two, six + 4) : six, 0, 20);
  }
  std::string operator()(const Eigen::Matrix3d& c, int i, int j) const {
    const double scale = std::pow(10.0, decimals_), x = giga * c(i, j);
    const std::string value =
        format("{:.{}f}", std::abs(x) * scale < 0.5 ? 0.0 : x, decimals_);  // never -0.000
    return error_ ? value + format(" ± {:.{}f}", giga * std::abs(error_->error(i, j)), decimals_) : value;
  }

 private:
  static int exponent(double x) { return x > 0 ? static_cast<int>(std::floor(std::log10(x))) : 0; }
  const std::optional<Richardson>& error_;
  int decimals_ = 0;
};

std::string cell_text(const Homogenised& found) {
  std::string text = format("cell: {} cells, {} nodes\n", static_cast<long long>(found.cells),
                            static_cast<long long>(found.nodes));
  Rows rows{{"phase", "fraction", "k [GPa]", "G [GPa]", "material"}};
  for (const Phase& phase : found.phases) {
    if (phase.is_empty()) {
      rows.push_back({phase.region, format("{:.6f}", phase.fraction), "-", "-", "empty, with free edges"});
      continue;
    }
    const EngineeringConstants e = engineering_constants(phase.material.stiffness);
    const bool isotropic = is_isotropic(phase.material.stiffness);
    rows.push_back({phase.region, format("{:.6f}", phase.fraction), isotropic ? gpa(e.bulk) : "-",
                    isotropic ? gpa(e.shear_mean()) : "-", phase.material.description});
  }
  return text + table(rows);
}

std::string stiffness_text(const Homogenised& found, std::size_t k) {
  const CellSolution& solution = found.solutions[k];
  const auto error = discretisation_error(found, k);
  const GigaPascal value(solution.stiffness, error);
  Rows rows{{std::string("C [GPa], ") + name(solution.boundary), "xx", "yy", "xy"}};
  for (int i = 0; i < 3; ++i)
    rows.push_back({voigt_names[i], value(solution.stiffness, i, 0), value(solution.stiffness, i, 1),
                    value(solution.stiffness, i, 2)});
  return table(rows) + format("symmetry defect {:.1e}\n", symmetry_defect(solution.stiffness));
}

std::string error_text(const Homogenised& found) {
  if (found.refined.empty()) return "no error estimate (-cell_estimate_error)\n";
  return "± is Richardson's estimate from one uniform refinement, for order 2; the geometry error is not "
         "included:\n"
         "refinement keeps the drawn polygons\n";
}

/// Solutions from the softest to the stiffest condition.
std::vector<std::size_t> by_stiffness(const Homogenised& found) {
  std::vector<std::size_t> order;
  for (const auto boundary : {CellBoundary::subc, CellBoundary::periodic, CellBoundary::kubc})
    for (std::size_t k = 0; k < found.solutions.size(); ++k)
      if (found.solutions[k].boundary == boundary) order.push_back(k);
  return order;
}

bool holds(double excess_found) { return excess_found >= -rounding; }

std::string check(double excess_found) {
  return format("{} ({:.1e})", holds(excess_found) ? "ok" : "VIOLATED", excess_found);
}

/// SUBC <= periodic <= KUBC: each condition admits fewer displacements than the one before.
std::string comparison_text(const Homogenised& found) {
  const std::vector<std::size_t> order = by_stiffness(found);
  if (order.size() < 2) return "";
  Rows rows{{"C [GPa]"}, {"C11"}, {"C22"}, {"C12"}, {"C66"}, {"C16"}, {"C26"}};
  for (const std::size_t k : order) {
    const Eigen::Matrix3d& c = found.solutions[k].stiffness;
    const auto error = discretisation_error(found, k);
    const GigaPascal value(c, error);
    rows[0].push_back(name(found.solutions[k].boundary));
    const int places[][2] = {{0, 0}, {1, 1}, {0, 1}, {2, 2}, {0, 2}, {1, 2}};
    for (std::size_t row = 0; row < 6; ++row)
      rows[row + 1].push_back(value(c, places[row][0], places[row][1]));
  }
  std::string text = table(rows);
  for (std::size_t n = 1; n < order.size(); ++n) {
    const CellSolution &soft = found.solutions[order[n - 1]], &stiff = found.solutions[order[n]];
    text += format("{} <= {}  {}\n", name(soft.boundary), name(stiff.boundary),
                   check(excess(stiff.stiffness, soft.stiffness)));
  }
  return text;
}

std::string constants_text(const EngineeringConstants& e) {
  return format(
             "engineering constants in plane strain: E_x {}, E_y {}, G_xy {}, k {} GPa, nu_xy {:.4f}, nu_yx "
             "{:.4f}\n",
             gpa(e.young_x), gpa(e.young_y), gpa(e.shear), gpa(e.bulk), e.poisson_xy, e.poisson_yx) +
         format("nearest isotropic solid: E {} GPa, nu {:.4f}; C is {:.2g} % of its size away\n",
                gpa(e.young), e.poisson, 100 * e.anisotropy);
}

std::string voigt_reuss_text(const Homogenised& found) {
  Rows rows{{"bound (margin)"}, {"Reuss <= C"}, {"C <= Voigt"}};
  const Eigen::Matrix3d voigt = voigt_bound(found.phases), reuss = reuss_bound(found.phases);
  for (const CellSolution& solution : found.solutions) {
    rows[0].push_back(name(solution.boundary));
    rows[1].push_back(check(excess(solution.stiffness, reuss)));
    rows[2].push_back(check(excess(voigt, solution.stiffness)));
  }
  return table(rows);
}

/// Whether a modulus of the first solution lies between its Hashin-Shtrikman bounds, which hold for periodic
/// cells without discretisation error.
std::string verdict(const Homogenised& found, double value, double low, double high, double bar) {
  const double outside = std::max(low - value, value - high);
  if (outside <= rounding * value) return "ok";
  if (outside <= bar) return "ok within the error bar";
  const std::string by = format(" by {:.1e}", outside / value);
  if (outside <= 2 * bar) return "outside" + by + ", twice the error bar at most";  // it is an estimate
  if (found.solutions.front().boundary != CellBoundary::periodic)
    return "outside" + by + ", as " + name(found.solutions.front().boundary) + " may be";
  if (found.refined.empty() && outside < 0.01 * value)
    return "outside" + by + ", no error bar to judge it by";
  return "VIOLATED" + by;
}

struct CheckedModulus {
  const char* name;
  double value, low, high;  ///< Pa
  std::string verdict;
};

/// Hashin and Shtrikman's; none unless the phases are two and isotropic.
std::vector<CheckedModulus> checked_moduli(const Homogenised& found, const EngineeringConstants& e) {
  const auto bounds = hashin_shtrikman(found.phases);
  if (!bounds) return {};
  double bulk_bar = 0, shear_bar = 0;
  if (const auto error = discretisation_error(found, 0)) {
    const EngineeringConstants best = engineering_constants(error->extrapolated);
    bulk_bar = std::abs(e.bulk - best.bulk);
    shear_bar = std::abs(e.shear_mean() - best.shear_mean());
  }
  const double shear = e.shear_mean();
  return {{"plane bulk modulus k", e.bulk, bounds->bulk_low, bounds->bulk_high,
           verdict(found, e.bulk, bounds->bulk_low, bounds->bulk_high, bulk_bar)},
          {"shear modulus, mean", shear, bounds->shear_low, bounds->shear_high,
           verdict(found, shear, bounds->shear_low, bounds->shear_high, shear_bar)}};
}

std::string hashin_shtrikman_text(const Homogenised& found, const EngineeringConstants& e) {
  const auto moduli = checked_moduli(found, e);
  if (moduli.empty()) return "Hashin-Shtrikman bounds: for two isotropic phases only\n";
  Rows rows{{"Hashin-Shtrikman [GPa]", "lower", "found", "upper", "check"}};
  for (const CheckedModulus& each : moduli)
    rows.push_back({each.name, gpa(each.low), gpa(each.value), gpa(each.high), each.verdict});
  return table(rows) + format(
                           "shear modulus from {} to {} GPa over the directions; these bounds are those of "
                           "isotropic mixtures,\n"
                           "others obey them in k and in the mean of their two shear moduli\n",
                           gpa(e.shear_least), gpa(e.shear_most));
}

std::string residuals_text(const Homogenised& found) {
  Rows rows{{"residual"}, {"Hill-Mandel"}, {"mean of A less I"}};
  for (const CellSolution& solution : found.solutions) {
    rows[0].push_back(name(solution.boundary));
    rows[1].push_back(format("{:.1e}", hill_mandel_residual(solution)));
    rows[2].push_back(format("{:.1e}", mean_localisation_defect(solution)));
  }
  if (const auto identity = two_phase_residual(found))
    rows.push_back({"two-phase identity", format("{:.1e}", *identity)});
  return table(rows);
}

std::string waves_text(const Material& material) {
  const WaveSpeeds x = wave_speeds(material, 1, 0), y = wave_speeds(material, 0, 1);
  return format("density {:.6g} kg/m3; waves along x {:.6g} and {:.6g} m/s, along y {:.6g} and {:.6g} m/s\n",
                material.density, x.fast, x.slow, y.fast, y.slow);
}

std::string cost_text(const Homogenised& found) {
  Rows rows{{"cost", "solver", "unknowns", "iterations", "set-up [s]", "solve [s]"}};
  for (const CellSolution& solution : found.solutions) {
    std::string iterations;
    double seconds = 0;
    for (const CaseCost& cost : solution.cost) {
      iterations += (iterations.empty() ? "" : " ") + std::to_string(cost.iterations);
      seconds += cost.seconds;
    }
    rows.push_back({name(solution.boundary), solution.solver, std::to_string(solution.unknowns), iterations,
                    format("{:.2f}", solution.set_up_seconds), format("{:.2f}", seconds)});
  }
  return table(rows) + format("in all {} on {} rank{}, memory {}\n", readable_duration(found.seconds),
                              found.ranks, found.ranks == 1 ? "" : "s", readable_bytes(found.memory));
}

}  // namespace

std::vector<std::string> doubts(const Homogenised& found) {
  std::vector<std::string> all;
  const CellSolution& first = found.solutions.front();
  for (const std::string& region : first.locking)
    all.push_back("region '" + region +
                  "' is nearly incompressible and meshed in triangles, which lock: too stiff; mesh it in "
                  "quadrilaterals");
  if (!holds(excess(voigt_bound(found.phases), first.stiffness))) all.push_back("C violates Voigt's bound");
  if (!holds(excess(first.stiffness, reuss_bound(found.phases)))) all.push_back("C violates Reuss's bound");
  for (const CheckedModulus& each :
       checked_moduli(found, engineering_constants(effective_material(found).stiffness)))
    if (each.verdict.starts_with("VIOLATED"))
      all.push_back(format("the {} of {} GPa violates its Hashin-Shtrikman bounds, {} to {} GPa", each.name,
                           gpa_apart(each.value < each.low ? each.low : each.high, each.value), gpa(each.low),
                           gpa(each.high)));
  return all;
}

std::string describe(const Homogenised& found) {
  const Material material = effective_material(found);
  const EngineeringConstants constants = engineering_constants(material.stiffness);
  std::string text = cell_text(found) + "\n";
  for (std::size_t k = 0; k < found.solutions.size(); ++k) text += stiffness_text(found, k) + "\n";
  text += error_text(found) + "\n";
  if (const std::string comparison = comparison_text(found); !comparison.empty()) text += comparison + "\n";
  text += constants_text(constants) + "\n";
  text += voigt_reuss_text(found) + "\n" + hashin_shtrikman_text(found, constants) + "\n";
  text += residuals_text(found) + "\n" + waves_text(material) + "\n";
  if (const auto friction = friction_of_phases(found))
    text += format(
        "friction of the face in slow sliding: {:.4g}, from tan<arctan(beta mu)>/beta; the mean of the "
        "phases' coefficients is {:.4g}\n",
        friction->effective, friction->mean);
  text += cost_text(found);
  for (const std::string& doubt : doubts(found)) text += "warning: " + doubt + "\n";
  return text;
}

}  // namespace slipscale
