#include "slipscale/base/plain_yaml.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "spelling.hpp"

namespace slipscale {
namespace {

using View = std::string_view;

bool all(View text, View letters) { return text.find_first_not_of(letters) == View::npos; }
bool digits(View text) { return !text.empty() && all(text, "0123456789"); }

bool is_word(const std::string& text, const auto& words) {
  const std::string small = spelling::fold(text);
  if (std::find(words.begin(), words.end(), small) == words.end()) return false;
  const bool rest_small = text.substr(1) == small.substr(1);
  return rest_small || std::none_of(text.begin(), text.end(), [](char c) { return c >= 'a' && c <= 'z'; });
}

View without_sign(View text) {
  if (!text.empty() && (text[0] == '+' || text[0] == '-')) text.remove_prefix(1);
  return text;
}

/// "12.5", ".5", "5.", each with an exponent that has a sign. Without the point an exponent makes a text.
bool is_float(View text) {
  const auto e = text.find_first_of("eE");
  if (e != View::npos) {
    const View power = text.substr(e + 1);
    if (power.size() < 2 || (power[0] != '+' && power[0] != '-') || !digits(power.substr(1))) return false;
  }
  const View mantissa = text.substr(0, e);
  const auto point = mantissa.find('.');
  if (point == View::npos) return false;
  const View before = mantissa.substr(0, point), after = mantissa.substr(point + 1);
  return (before.empty() ? digits(after) : digits(before)) && all(after, "0123456789");
}

/// "1:30", "01:30.5": all parts but the first below 60; without a point no zero in front.
bool is_base_60(View text) {
  const auto point = text.find('.');
  if (point != View::npos && !all(text.substr(point + 1), "0123456789_")) return false;
  if (text.empty() || text[0] < (point == View::npos ? '1' : '0') || text[0] > '9') return false;
  text = text.substr(0, point);
  auto colon = text.find(':');
  if (colon == View::npos || !all(text.substr(0, colon), "0123456789_")) return false;
  while (colon != View::npos) {
    const auto next = text.find(':', colon + 1);
    const View part = text.substr(colon + 1, next == View::npos ? next : next - colon - 1);
    if (part.size() > 2 || !digits(part) || (part.size() == 2 && part[0] > '5')) return false;
    colon = next;
  }
  return true;
}

/// "2026-01-31", with or without a time behind it; as YAML does, by its shape only.
bool is_date(View text) {
  if (text.size() < 8 || !digits(text.substr(0, 4)) || text[4] != '-') return false;
  const auto second = text.find('-', 5);
  if (second == View::npos || !digits(text.substr(5, second - 5)) || second > 7) return false;
  const auto end = text.find_first_not_of("0123456789", second + 1);
  const View day = text.substr(second + 1, end == View::npos ? end : end - second - 1);
  if (day.empty() || day.size() > 2) return false;
  if (end == View::npos) return text.size() == 10;
  return (text[end] == 'T' || text[end] == 't' || text[end] == ' ' || text[end] == '\t') &&
         text.find(':', end) != View::npos;
}

std::string other_words(View text) {
  const View bare = without_sign(text);
  if (text == "=") return "a mark of its own";
  if (is_date(text)) return "a date";
  if (bare == ".inf" || bare == ".Inf" || bare == ".INF") return "infinity";
  if (text == ".nan" || text == ".NaN" || text == ".NAN") return "no number";
  // A point in front stands without a sign in it.
  const bool starts = !bare.empty() && ((bare[0] >= '0' && bare[0] <= '9') || text[0] == '.');
  if (!starts) return "";
  if (bare.starts_with("0b") && bare.size() > 2 && all(bare.substr(2), "01_")) return "a number in base 2";
  if (bare.starts_with("0x") && bare.size() > 2 && all(bare.substr(2), "0123456789abcdefABCDEF_"))
    return "a number in base 16";
  if (bare[0] == '0' && bare.size() > 1 && all(bare.substr(1), "01234567_")) return "a number in base 8";
  if (is_base_60(bare)) return "a number in base 60";
  if (bare.find('_') != View::npos) {
    std::string clean(bare);
    std::erase(clean, '_');
    if (digits(clean) || is_float(clean)) return "a number without its _";
  }
  return "";
}

constexpr std::array<View, 6> flags{"true", "false", "yes", "no", "on", "off"};
constexpr std::array<View, 1> nothings{"null"};

}  // namespace

PlainYaml plain_yaml(const std::string& text) {
  if (text.empty() || text == "~" || is_word(text, nothings)) return PlainYaml::nothing;
  if (is_word(text, flags)) return PlainYaml::flag;
  if (!other_words(text).empty()) return PlainYaml::other;
  const View bare = without_sign(text);
  if (is_float(bare)) return PlainYaml::number;
  return digits(bare) && (bare.size() == 1 || bare[0] != '0') ? PlainYaml::number : PlainYaml::text;
}

std::string plain_yaml_words(const std::string& text) {
  switch (plain_yaml(text)) {
    case PlainYaml::nothing:
      return "nothing at all";
    case PlainYaml::flag:
      return "true or false";
    case PlainYaml::number:
      return "a number";
    case PlainYaml::text:
      return "a text";
    case PlainYaml::other:
      break;
  }
  return other_words(text);
}

}  // namespace slipscale
