#include "slipscale/base/formula.hpp"

#include <muParser.h>

#include <algorithm>
#include <cctype>

#include "slipscale/base/error.hpp"
#include "slipscale/base/options.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

constexpr std::array variable_names{"x", "y", "t"};

/// muParser takes `x = 3` for an order to change x.
std::size_t assignment(const std::string& text) {
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] != '=') continue;
    const bool compares = (k > 0 && std::string("<>!=").find(text[k - 1]) != std::string::npos) ||
                          (k + 1 < text.size() && text[k + 1] == '=');
    if (!compares) return k;
  }
  return std::string::npos;
}

/// Where a name stands by itself, from 1.
std::size_t character_of(const std::string& name, const std::string& text) {
  const auto in_name = [&](std::size_t k) {
    return k < text.size() && (std::isalnum(static_cast<unsigned char>(text[k])) || text[k] == '_');
  };
  std::size_t found = text.find(name);
  while (found != std::string::npos && ((found > 0 && in_name(found - 1)) || in_name(found + name.size())))
    found = text.find(name, found + 1);
  return found + 1;
}

std::string with_comma(const std::string& list, const std::string& word) {
  return list.empty() ? word : list + ", " + word;
}

std::string known_names(const std::string& variables, const Formula::Names& names) {
  std::string list, parameters;
  for (const char variable : variables) list = with_comma(list, std::string(1, variable));
  for (const auto& [name, value] : names.constants) list = with_comma(list, name);
  for (const std::string& name : names.parameters) parameters = with_comma(parameters, name);
  return "; known are " + list +
         (parameters.empty() ? ", parameters given as -parameters_<name>"
                             : ", the parameters " + parameters) +
         " and functions such as sin, exp, sqrt, min";
}

}  // namespace

struct Formula::Compiled {
  mu::Parser parser;
};

Formula::Formula(const std::string& text, const std::string& variables, const Names& names,
                 const std::string& refusal)
    : text_(text), compiled_(std::make_unique<Compiled>()) {
  mu::Parser& parser = compiled_->parser;
  const auto refuse = [&](const std::string& fault) {
    throw UserError(one_line(refusal + ", and " + fault + known_names(variables, names)));
  };
  if (const std::size_t place = assignment(text); place != std::string::npos)
    refuse(format("the = at character {} changes nothing here, == compares", place + 1));
  try {
    parser.SetExpr(text);
    const auto used = parser.GetUsedVar();  // a copy: defining a name empties it
    for (const auto& [name, unused] : used) {
      const auto variable = std::ranges::find(variable_names, name);
      const auto constant = names.constants.find(name);
      if (variable != variable_names.end() && variables.find(name) != std::string::npos) {
        const auto k = static_cast<std::size_t>(variable - variable_names.begin());
        uses_[k] = true;
        parser.DefineVar(name, &where_[k]);
      } else if (constant != names.constants.end()) {
        parser.DefineConst(name, constant->second);
      } else if (std::ranges::find(names.parameters, name) != names.parameters.end()) {
        parser.DefineConst(name, names.value(name));
      } else {
        const std::string near = nearest(name, names.parameters);
        refuse(format("'{}' at character {} {}", name, character_of(name, text),
                      variable != variable_names.end() ? "has no meaning here" : "is no known name") +
               (near.empty() ? "" : ", did you mean " + near + "?"));
      }
    }
    (void)parser.Eval();
    if (parser.GetNumResults() != 1) refuse("a comma makes more than one number of it");
  } catch (const mu::ParserError& error) {
    std::string fault = error.GetMsg();
    fault.erase(fault.find_last_not_of(". \n") + 1);
    refuse("at character " + std::to_string(error.GetPos() + 1) + ": " + fault);
  }
}

Formula::~Formula() = default;

double Formula::operator()(const Vector2& place, double time) const {
  where_ = {place[0], place[1], time};
  return compiled_->parser.Eval();
}

bool Formula::reserved(const std::string& name, const Names& names) {
  const mu::Parser parser;
  return std::ranges::find(variable_names, name) != variable_names.end() || names.constants.contains(name) ||
         parser.GetFunDef().contains(name);
}

}  // namespace slipscale
