#include <algorithm>
#include <map>

#include "slipscale/morphology/grey_image.hpp"

namespace slipscale {
namespace {

class Islands {
 public:
  Islands(std::vector<int>& regions, int columns, int rows, const std::array<bool, 2>& periodic)
      : regions_(regions), count_{columns, rows}, periodic_(periodic) {}

  /// One round: islands by size, each as it is when its turn comes. Returns the pixels changed.
  long give_away(long smallest) {
    std::vector<std::vector<int>> small;
    std::vector<char> seen(regions_.size());
    for (std::size_t k = 0; k < regions_.size(); ++k)
      if (!seen[k])
        if (auto island = around(static_cast<int>(k), seen); std::ssize(island) < smallest)
          small.push_back(std::move(island));
    std::ranges::stable_sort(small, {}, &std::vector<int>::size);
    long changed = 0;
    for (const std::vector<int>& island : small) changed += give_away(island, smallest);
    return changed;
  }

 private:
  template <class Visit>
  void beside(int pixel, Visit&& visit) const {
    const std::array<int, 2> at{pixel % count_[0], pixel / count_[0]};
    for (int axis = 0; axis < 2; ++axis)
      for (const int way : {-1, 1}) {
        std::array<int, 2> next = at;
        next[axis] += way;
        if (next[axis] < 0 || next[axis] >= count_[axis]) {
          if (!periodic_[axis]) continue;
          next[axis] = (next[axis] + count_[axis]) % count_[axis];
        }
        visit(next[1] * count_[0] + next[0]);
      }
  }

  std::vector<int> around(int pixel, std::vector<char>& seen) const {
    std::vector<int> island{pixel};
    seen[pixel] = 1;
    for (std::size_t k = 0; k < island.size(); ++k)
      beside(island[k], [&](int next) {
        if (seen[next] || regions_[next] != regions_[pixel]) return;
        seen[next] = 1;
        island.push_back(next);
      });
    return island;
  }

  /// Unless a neighbour that was given away has made it larger.
  long give_away(const std::vector<int>& island, long smallest) {
    const int own = regions_[island.front()];
    std::map<int, long> sides;
    long joined = 0;
    for (const int pixel : island)
      beside(pixel, [&](int next) {
        if (regions_[next] != own)
          ++sides[regions_[next]];
        else
          joined += std::ranges::find(island, next) == island.end();
      });
    if (joined > 0 || sides.empty() || std::ssize(island) >= smallest) return 0;
    const int to = std::ranges::max_element(sides, {}, [](const auto& side) { return side.second; })->first;
    for (const int pixel : island) regions_[pixel] = to;
    return std::ssize(island);
  }

  std::vector<int>& regions_;
  std::array<int, 2> count_;
  std::array<bool, 2> periodic_;
};

}  // namespace

long despeckle(std::vector<int>& regions, int columns, int rows, const std::array<bool, 2>& periodic,
               long smallest) {
  const std::vector<int> before = regions;
  Islands islands(regions, columns, rows, periodic);
  constexpr int rounds = 20;
  for (int round = 0; round < rounds && islands.give_away(smallest) > 0; ++round) {
  }
  long changed = 0;
  for (std::size_t k = 0; k < regions.size(); ++k) changed += regions[k] != before[k];
  return changed;
}

}  // namespace slipscale
