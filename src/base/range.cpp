#include "slipscale/base/options.hpp"

namespace slipscale::range {
namespace {

bool accept_positive(double x) { return x > 0; }
bool accept_non_negative(double x) { return x >= 0; }
bool accept_at_least_one(double x) { return x >= 1; }
bool accept_unit(double x) { return x > 0 && x <= 1; }

std::string listed(const std::vector<std::string>& words, const std::string& last) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k) {
    if (k > 0) text += k + 1 == words.size() && last.empty() ? " or " : ", ";
    text += words[k];
  }
  return last.empty() ? text : text + " or " + last;
}

}  // namespace

// Initialised by the compiler, so that a schema may be a global of any file.
constinit const Range any{"", nullptr};
constinit const Range positive{"> 0", accept_positive};
constinit const Range non_negative{">= 0", accept_non_negative};
constinit const Range at_least_one{">= 1", accept_at_least_one};
constinit const Range unit{"> 0 and <= 1", accept_unit};

Range one_of(std::vector<std::string> words) {
  Range range;
  range.text = listed(words, "");
  range.words = std::move(words);
  return range;
}

Range one_of_or_number(std::vector<std::string> words, const Range& number) {
  Range range;
  range.text = listed(words, number.text.empty() ? "a number" : "a number " + number.text);
  range.accepts = number.accepts;
  range.words = std::move(words);
  range.words_or_number = true;
  return range;
}

Range or_formula(Range range, std::string variables) {
  range.variables = std::move(variables);
  return range;
}

}  // namespace slipscale::range
