#include "spelling.hpp"

#include <algorithm>
#include <cctype>

#include "slipscale/base/options.hpp"

namespace slipscale {
namespace spelling {

std::string fold(const std::string& word) {
  std::string folded = word;
  for (char& c : folded) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return folded;
}

std::vector<std::size_t> distances(const std::string& from, const std::string& to) {
  std::vector<std::size_t> before, last(to.size() + 1), now(to.size() + 1), result;
  for (std::size_t j = 0; j <= to.size(); ++j) last[j] = j;
  result.push_back(last.back());
  for (std::size_t i = 1; i <= from.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= to.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (from[i - 1] == to[j - 1] ? 0 : 1);
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1])
        now[j] = std::min(now[j], before[j - 2] + 1);
    }
    result.push_back(now.back());
    before = last;
    std::swap(last, now);
  }
  return result;
}

std::size_t tolerance(std::size_t length) { return 1 + length / 5; }

}  // namespace spelling

std::string nearest(const std::string& word, const std::vector<std::string>& known) {
  const std::string folded = spelling::fold(word);
  std::string best;
  std::size_t least = spelling::tolerance(word.size()) + 1;
  for (const std::string& candidate : known) {
    const std::size_t distance = spelling::distances(spelling::fold(candidate), folded).back();
    // A word of one or two letters is within reach of everything: it must share a letter at least.
    if (distance < least && distance < std::max(word.size(), candidate.size())) {
      least = distance;
      best = candidate;
    }
  }
  return best;
}

}  // namespace slipscale
