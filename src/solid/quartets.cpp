#include "quartets.hpp"

#include <algorithm>
#include <bit>
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

std::uint64_t digest(const std::vector<Link>& links, const std::vector<double>& values) {
  std::uint64_t h = links.size();
  const auto mix = [&](std::uint64_t x) { h = (std::rotl(h, 23) ^ x) * 0x9e3779b97f4a7c15ull; };
  for (const Link& link : links)
    mix(static_cast<std::uint64_t>(2 * static_cast<long>(link.offset) + link.turns));
  for (const double value : values) mix(std::bit_cast<std::uint64_t>(value));
  return h ^ (h >> 32);
}

bool same(const Link& a, const Link& b) { return a.offset == b.offset && a.turns == b.turns; }

}  // namespace

std::optional<Quartet> Quartets::make(int begin, const std::array<std::vector<Term>, 4>& terms) {
  const auto places = merged(terms);
  const auto outside = [&](const Place& place) {
    return begin + place.offset < 0 || begin + 3 + place.offset >= count_;
  };
  if (places.empty() || std::ranges::any_of(places, outside)) return std::nullopt;
  std::vector<Link> own_links;
  std::vector<double> own;
  std::array<std::size_t, 4> next{};
  for (const Place& place : places) {
    own_links.push_back({static_cast<int>(place.offset), place.turns});
    const auto base = own.size();
    own.resize(base + (place.turns ? 4 : 12), 0);
    for (std::size_t node = 0; node < 4; ++node) {
      if (next[node] == terms[node].size() || place_of(terms[node][next[node]]) != place) continue;
      const Term& term = terms[node][next[node]++];
      if (!place.turns) own[base + 2 * node] = term.straight[0], own[base + 2 * node + 1] = term.straight[1];
      own[base + (place.turns ? 0 : 8) + node] = term.crossed[0];
    }
  }
  const auto [found, is_new] = known_.try_emplace(digest(own_links, own));
  Kept& kept = found->second;
  const bool known = !is_new &&
                     std::equal(own_links.begin(), own_links.end(), links.begin() + kept.first,
                                links.begin() + kept.last, same) &&
                     std::equal(own.begin(), own.end(), values.begin() + kept.values);
  if (!known) {
    kept = {static_cast<int>(links.size()), static_cast<int>(links.size() + own_links.size()),
            static_cast<long>(values.size())};
    links.insert(links.end(), own_links.begin(), own_links.end());
    values.insert(values.end(), own.begin(), own.end());
  }
  return Quartet{begin, kept.first, kept.last, kept.values};
}

}  // namespace slipscale
