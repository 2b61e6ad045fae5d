#include "slipscale/dynamics/formulas.hpp"

#include <numbers>

#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {

void know_formula_names(Options& options, const Mesh& mesh) {
  options.know_constants(
      {{"H", mesh.upper[1] - mesh.lower[1]}, {"L", mesh.upper[0] - mesh.lower[0]}, {"pi", std::numbers::pi}});
}

void check_at(const Options& options, const std::string& name, const Quantity& quantity, const Mesh& mesh,
              const std::vector<int>& nodes) {
  if (!quantity.formula) return;
  std::string fault;
  for (const int i : nodes) {
    const Vector2& place = mesh.nodes.position[i];
    fault = options.outside(name, quantity, quantity.formula->operator()(place, 0));
    if (fault.empty()) continue;
    fault += format(", at x = {:g} m, y = {:g} m, t = 0", place[0], place[1]);
    break;
  }
  throw_together(mesh.comm, fault);
}

Quantity quantity_at(const Options& options, const std::string& name, const Mesh& mesh,
                     const std::vector<int>& nodes) {
  Quantity quantity = options.quantity(name);
  check_at(options, name, quantity, mesh, nodes);
  return quantity;
}

std::string describe(const Quantity& quantity, const std::string& unit) {
  if (quantity.formula) return quantity.formula->text() + (unit.empty() ? "" : " " + unit);
  return engineering(quantity.number, unit);
}

}  // namespace slipscale
