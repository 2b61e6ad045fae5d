#include "value.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "slipscale/base/error.hpp"
#include "spelling.hpp"

namespace slipscale::value {
namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// `from_chars` because it knows no locale: a decimal point is a point wherever the program runs.
template <class Number>
std::optional<Number> parsed(const std::string& text) {
  std::string digits = trimmed(text);
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.erase(0, 1);
  Number number{};
  const char* end = digits.data() + digits.size();
  const auto [stop, fault] = std::from_chars(digits.data(), end, number);
  if (fault != std::errc() || stop != end) return std::nullopt;
  return number;
}

std::string unit_note(const Option& option) {
  const bool counts = option.kind == Kind::integer && option.unit == "1";
  if (option.unit.empty() || counts) return "";
  return option.unit == "1" ? " (ratio)" : " (" + option.unit + ")";
}

/// " or a formula of x, y, t", "s" where there are several.
std::string formula_text(const Option& option, const std::string& plural = "") {
  std::string list;
  for (const char variable : option.range.variables)
    list += (list.empty() ? "" : ", ") + std::string(1, variable);
  return list.empty() ? "" : " or " + std::string(plural.empty() ? "a formula" : "formulas") + " of " + list;
}

std::string kind_text(const Option& option) {
  const std::string range = option.range.text.empty() ? "" : " " + option.range.text;
  switch (option.kind) {
    case Kind::real:
      return "a number" + range + formula_text(option);
    case Kind::integer:
      return "a whole number" + range;
    case Kind::reals:
      return "numbers" + range + formula_text(option, "s") + " separated by commas";
    case Kind::flag:
      return "true or false";
    case Kind::text:
      break;
  }
  return option.range.words.empty() ? "a text" : option.range.text + formula_text(option);
}

/// Its names and its grammar are looked at when it is compiled.
bool may_be_formula(const Option& option, const std::string& text) {
  if (option.range.variables.empty() || text.empty() || items(text).size() != 1) return false;
  const std::string& known = option.range.words.empty() ? "" : nearest(text, option.range.words);
  return known.empty();
}

[[noreturn]] void refuse(const Option& option, const std::string& name, const std::string& text,
                         const std::string& demand, const std::string& hint = "") {
  throw UserError("-" + name + " is " + text + ", but it must be " + demand + unit_note(option) + hint);
}

void check_number(const Option& option, const std::string& name, const std::string& text) {
  std::optional<double> x;
  if (option.kind == Kind::real) x = number(text);
  if (option.kind == Kind::integer) {
    if (const auto n = integer(text)) x = static_cast<double>(*n);
    const std::string digits = trimmed(text);
    const bool is_whole = digits.size() > 1 && digits.find_first_not_of("0123456789", 1) == std::string::npos;
    if (!x && is_whole && digits[0] != '-' && number(digits))
      refuse(option, name, text, "at most " + std::to_string(std::numeric_limits<PetscInt>::max()));
    if (!x && is_whole && digits[0] == '-' && number(digits) && option.range.accepts)
      refuse(option, name, text, option.range.text);
  }
  if (!x && option.kind == Kind::real && may_be_formula(option, text)) return;
  if (!x) {
    const bool comma = option.kind == Kind::real && text.find(',') != std::string::npos;
    refuse(option, name, "'" + text + "'", kind_text(option),
           comma ? "; write one number with a decimal point" : "");
  }
  if (option.range.accepts && !option.range.accepts(*x)) refuse(option, name, text, option.range.text);
}

void check_list(const Option& option, const std::string& name, const std::string& text) {
  for (const std::string& item : items(text)) {
    const auto x = number(item);
    if (!x && may_be_formula(option, item)) continue;
    if (!x) refuse(option, name, "'" + text + "'", kind_text(option), ", and '" + item + "' is no number");
    if (option.range.accepts && !option.range.accepts(*x))
      refuse(option, name, text, kind_text(option), ", and " + item + " is not");
  }
}

void check_text(const Option& option, const std::string& name, const std::string& text) {
  const Range& range = option.range;
  if (range.words.empty()) return;
  if (std::find(range.words.begin(), range.words.end(), text) != range.words.end()) return;
  if (range.words_or_number) {
    const auto x = number(text);
    if (x && (!range.accepts || range.accepts(*x))) return;
    if (!x && may_be_formula(option, text)) return;
  }
  const std::string near = nearest(text, range.words);
  refuse(option, name, "'" + text + "'", kind_text(option),
         near.empty() ? "" : "; did you mean " + near + "?");
}

}  // namespace

std::optional<double> number(const std::string& text) {
  const auto x = parsed<double>(text);
  return x && std::isfinite(*x) ? x : std::nullopt;
}

std::optional<PetscInt> integer(const std::string& text) { return parsed<PetscInt>(text); }

bool printed_alike(const std::string& text) {
  const std::string digits = text.substr(text.starts_with('-') ? 1 : 0);
  const auto point = digits.find('.');
  const std::string whole = digits.substr(0, point);
  if (whole.empty() || whole.size() > 15 || (whole.size() > 1 && whole[0] == '0') ||
      digits.find_first_not_of("0123456789.") != std::string::npos)
    return false;
  if (point == std::string::npos) return true;
  const std::string part = digits.substr(point + 1);
  return part == "0" || (!part.empty() && part.back() != '0' && whole.size() + part.size() <= 15 &&
                         (whole != "0" || part.find_first_not_of('0') < 4));
}

std::optional<bool> truth(const std::string& text) {
  const std::string word = spelling::fold(trimmed(text));
  if (word == "true" || word == "yes" || word == "on" || word == "1") return true;
  if (word == "false" || word == "no" || word == "off" || word == "0") return false;
  return std::nullopt;
}

/// The first comma from there on that stands in no parentheses: those of formulas hold arguments.
static std::size_t comma_after(const std::string& text, std::size_t begin) {
  int depth = 0;
  for (std::size_t k = begin; k < text.size(); ++k) {
    depth += (text[k] == '(') - (text[k] == ')');
    if (text[k] == ',' && depth <= 0) return k;
  }
  return std::string::npos;
}

std::vector<std::string> items(const std::string& text) {
  std::vector<std::string> list;
  if (text.empty()) return list;
  for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 1) {
    end = comma_after(text, begin);
    list.push_back(trimmed(text.substr(begin, end - begin)));
  }
  return list;
}

std::string wanted(const Option& option) { return kind_text(option) + unit_note(option); }

void check(const Option& option, const std::string& name, const std::string& text) {
  switch (option.kind) {
    case Kind::real:
    case Kind::integer:
      return check_number(option, name, text);
    case Kind::reals:
      return check_list(option, name, text);
    case Kind::text:
      return check_text(option, name, text);
    case Kind::flag:
      if (!truth(text)) refuse(option, name, "'" + text + "'", kind_text(option));
  }
}

}  // namespace slipscale::value
