#include "slipscale/files/yaml.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "slipscale/base/plain_yaml.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

/// What YAML takes for the end of a line besides \n: next line, line and paragraph separator, in UTF-8.
constexpr std::array<std::pair<const char*, const char*>, 3> line_breaks{
    {{"\xC2\x85", "\\N"}, {"\xE2\x80\xA8", "\\L"}, {"\xE2\x80\xA9", "\\P"}}};

/// Whether YAML reads the bare text as that text. Numbers and true/false may stand bare: that is what they
/// are. Not so yes, no, on and off, which may be names, nor what YAML takes for a number or a date of its
/// own.
bool bare(const std::string& text) {
  if (text.empty() || text.front() == ' ' || text.back() == ' ') return false;
  switch (plain_yaml(text)) {
    case PlainYaml::flag:
      if (text != "true" && text != "false") return false;
      break;
    case PlainYaml::nothing:
    case PlainYaml::other:
      return false;
    default:
      break;
  }
  if (text == "-" || text == "---" || text == "..." || text == "<<") return false;
  if (std::string("?:,[]{}#&*!|>'\"%@`").find(text.front()) != std::string::npos) return false;
  if (text.compare(0, 2, "- ") == 0 || text.back() == ':') return false;
  if (text.find(": ") != std::string::npos || text.find(" #") != std::string::npos) return false;
  for (const auto& [letter, escape] : line_breaks)
    if (text.find(letter) != std::string::npos) return false;
  return std::none_of(text.begin(), text.end(),
                      [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; });
}

std::string scalar(const std::string& text) {
  if (bare(text)) return text;
  std::string quoted = "\"";
  for (char c : text) {
    if (c == '"' || c == '\\')
      quoted += std::string("\\") + c;
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)
      quoted += format("\\x{:02x}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    else
      quoted += c;
  }
  for (const auto& [letter, escape] : line_breaks)
    for (auto at = quoted.find(letter); at != std::string::npos; at = quoted.find(letter))
      quoted.replace(at, std::string(letter).size(), escape);
  return quoted + "\"";
}

/// YAML 1.1 takes 1e-05 and 30e9 for texts: a number with an exponent needs a point and the exponent a sign.
std::string yaml_number(const std::string& digits) {
  const auto exponent = digits.find_first_of("eE");
  if (exponent == std::string::npos) return digits;
  std::string mantissa = digits.substr(0, exponent), power = digits.substr(exponent + 1);
  if (mantissa.find('.') == std::string::npos) mantissa += ".0";
  if (power.find_first_of("+-") != 0) power = "+" + power;
  return mantissa + "e" + power;
}

std::string yaml_number(double value, const std::string& digits) {
  if (std::isnan(value)) return ".nan";
  if (std::isinf(value)) return value > 0 ? ".inf" : "-.inf";
  return yaml_number(digits);
}

/// An option's value as the user typed it, numbers in YAML's spelling.
std::string option_value(const std::string& typed) {
  double value = 0;
  const char* const end = typed.data() + typed.size();
  const auto parsed = std::from_chars(typed.data(), end, value);
  return !typed.empty() && parsed.ec == std::errc() && parsed.ptr == end && std::isfinite(value)
             ? yaml_number(typed)
             : typed;
}

/// The fewest digits that are read back as the same double.
std::string shortest(double value) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  return yaml_number(value, std::string(digits.data(), end));
}

}  // namespace

Yaml& Yaml::line(const std::string& key, const std::string& value, const std::string& comment) {
  text_ += std::string(static_cast<std::size_t>(2 * depth_), ' ') + scalar(key) + ":";
  if (!value.empty()) text_ += " " + value;
  if (!comment.empty()) text_ += "  # " + comment;
  text_ += "\n";
  return *this;
}

Yaml& Yaml::remark(const std::string& text) {
  text_ += std::string(static_cast<std::size_t>(2 * depth_), ' ') + "# " + text + "\n";
  return *this;
}

Yaml& Yaml::text(const std::string& key, const std::string& value, const std::string& comment) {
  return line(key, scalar(value), comment);
}

Yaml& Yaml::number(const std::string& key, double value, const std::string& comment) {
  return line(key, yaml_number(value, format("{:.6g}", value)), comment);
}

Yaml& Yaml::exact(const std::string& key, double value, const std::string& comment) {
  return line(key, shortest(value), comment);
}

Yaml& Yaml::integer(const std::string& key, std::int64_t value, const std::string& comment) {
  return line(key, std::to_string(value), comment);
}

Yaml& Yaml::numbers(const std::string& key, const std::vector<double>& values, const std::string& comment) {
  std::string list;
  for (double value : values) {
    if (!list.empty()) list += ", ";
    list += yaml_number(value, format("{:.6g}", value));
  }
  return line(key, "[" + list + "]", comment);
}

Yaml& Yaml::begin(const std::string& key, const std::string& comment) {
  line(key, "", comment);
  ++depth_;
  return *this;
}

Yaml& Yaml::end() {
  --depth_;
  return *this;
}

std::string run_yaml(const std::map<std::string, std::string>& effective,
                     const std::function<void(Yaml& yaml)>& facts) {
  Yaml yaml;
  yaml.remark("every option in effect; run it again with -options_file_yaml <this file>");
  for (const auto& [name, value] : effective) yaml.text(name, option_value(value));
  yaml.remark("what the run found; not options");
  yaml.begin("run");
  facts(yaml);
  return yaml.end().str();
}

}  // namespace slipscale
