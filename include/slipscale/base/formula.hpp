#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "slipscale/base/vector2.hpp"

namespace slipscale {

/// A formula that the user writes in place of a number: of the place x, y [m] and the time t [s], of
/// constants and of parameters with names of their own. Compiled once, by muParser; evaluating it allocates
/// nothing.
class Formula {
 public:
  /// Names that stand for numbers, and how a parameter is looked up (null: there is none of that name).
  struct Names {
    std::map<std::string, double> constants;
    std::vector<std::string> parameters;
    std::function<double(const std::string& parameter)> value;
  };

  /// `variables`: those of x, y and t that mean something here, "xt". Throws UserError, whose sentence ends
  /// what stands in `refusal` ("-surface_speed is '2*z', but it must be a number or a formula of t (m/s)"),
  /// with the fault, its place in the text and the known names.
  Formula(const std::string& text, const std::string& variables, const Names& names,
          const std::string& refusal);
  ~Formula();
  Formula(const Formula&) = delete;
  Formula& operator=(const Formula&) = delete;

  double operator()(const Vector2& place, double time) const;
  double operator()(double time) const { return (*this)({0, 0}, time); }

  const std::string& text() const { return text_; }
  bool of_place() const { return uses_[0] || uses_[1]; }
  bool of_time() const { return uses_[2]; }
  bool is_constant() const { return !of_place() && !of_time(); }

  /// Names that no parameter may have: those of the variables, of the constants and of functions.
  static bool reserved(const std::string& name, const Names& names);

 private:
  std::string text_;
  std::array<bool, 3> uses_{};             ///< x, y, t
  mutable std::array<double, 3> where_{};  ///< what the compiled formula reads
  struct Compiled;
  std::unique_ptr<Compiled> compiled_;
};

using SharedFormula = std::shared_ptr<const Formula>;  ///< null: a plain number stands alone

/// What an option says: a number, or a formula that varies.
struct Quantity {
  double number = 0;  ///< 1 where a formula stands, so that number · formula is the value
  SharedFormula formula = {};

  bool is_zero() const { return !formula && number == 0; }
  bool of_time() const { return formula && formula->of_time(); }
  double at(const Vector2& place, double time) const {
    return formula ? number * (*formula)(place, time) : number;
  }
};

}  // namespace slipscale
