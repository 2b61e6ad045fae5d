#include "quartets.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <tuple>

namespace slipscale {
namespace {

/// Where a term stands among those of its node, as far as its distance tells: symmetric and skew part of each
/// lower neighbour, symmetric parts of the higher ones, their skew parts.
struct Place {
  int part;
  long offset;
  int turns;
  auto operator<=>(const Place&) const = default;
};

Place place_of(const Term& term) {
  const int turns = term.crossed[0] != term.crossed[1];
  return {term.offset < 0 ? 0 : 1 + turns, term.offset, turns};
}

/// The places of all terms, ascending; nothing where a node's terms do not ascend.
std::vector<Place> merged(const std::array<std::vector<Term>, 4>& terms) {
  std::vector<Place> places;
  for (const auto& list : terms) {
    const auto begin = places.size();
    for (const Term& term : list) places.push_back(place_of(term));
    if (!std::is_sorted(places.begin() + static_cast<std::ptrdiff_t>(begin), places.end())) return {};
  }
  std::ranges::sort(places);
  const auto [first, last] = std::ranges::unique(places);
  places.erase(first, last);
  return places;
}

class Digest {
 public:
  void add(std::uint64_t x) { h_ = (std::rotl(h_, 23) ^ x) * 0x9e3779b97f4a7c15ull; }
  std::uint64_t value() const { return h_ ^ (h_ >> 32); }

 private:
  std::uint64_t h_ = 1;
};

bool same(const Link& a, const Link& b) { return a.offset == b.offset && a.place == b.place; }

}  // namespace

/// Where these blocks stand in `values`, in fours; they are added where they do not.
int Quartets::place(const std::vector<double>& blocks) {
  Digest digest;
  for (const double value : blocks) digest.add(std::bit_cast<std::uint64_t>(value));
  const auto [found, is_new] = known_blocks_.try_emplace(digest.value());
  int& place = found->second;
  const auto stands = [&](std::size_t begin) {
    return begin + blocks.size() <= values.size() &&
           std::memcmp(&values[begin], blocks.data(), blocks.size() * sizeof(double)) == 0;
  };
  if (!is_new && stands(4 * static_cast<std::size_t>(place))) return place;
  place = static_cast<int>(values.size() / 4);
  values.insert(values.end(), blocks.begin(), blocks.end());
  return place;
}

std::optional<Quartet> Quartets::make(int begin, const std::array<std::vector<Term>, 4>& terms) {
  const auto places = merged(terms);
  const auto outside = [&](const Place& place) {
    return begin + place.offset < 0 || begin + 3 + place.offset >= count_;
  };
  if (places.empty() || std::ranges::any_of(places, outside)) return std::nullopt;
  std::vector<Link> own;
  std::vector<double> blocks;
  std::array<std::size_t, 4> next{};
  Digest digest;
  for (const Place& place : places) {
    blocks.assign(place.turns ? 4 : 12, 0);
    for (std::size_t node = 0; node < 4; ++node) {
      if (next[node] == terms[node].size() || place_of(terms[node][next[node]]) != place) continue;
      const Term& term = terms[node][next[node]++];
      if (!place.turns) blocks[2 * node] = term.straight[0], blocks[2 * node + 1] = term.straight[1];
      blocks[(place.turns ? 0 : 8) + node] = term.crossed[0];
    }
    const int stands = this->place(blocks);
    own.push_back({static_cast<int>(place.offset), place.turns ? -1 - stands : stands});
    digest.add(static_cast<std::uint64_t>(own.back().offset));
    digest.add(static_cast<std::uint64_t>(own.back().place));
  }
  const auto [found, is_new] = known_.try_emplace(digest.value());
  Kept& kept = found->second;
  if (is_new ||
      !std::equal(own.begin(), own.end(), links.begin() + kept.first, links.begin() + kept.last, same)) {
    kept = {static_cast<int>(links.size()), static_cast<int>(links.size() + own.size())};
    links.insert(links.end(), own.begin(), own.end());
  }
  return Quartet{begin, kept.first, kept.last};
}

}  // namespace slipscale
