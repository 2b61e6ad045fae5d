#include <chrono>
#include <cstdio>
#include <thread>

#include "slipscale/files/series_file.hpp"

using slipscale::SeriesFile;

/// Writes rows until it is killed, or for half a minute. Row n holds n, its double, pairs of it and a byte of
/// it.
int main(int, char** argv) {
  SeriesFile file(argv[1], 0.02);
  const int time = file.add("/time", {}, "s", "time");
  const int energy = file.add("/energy/kinetic", {}, "J/m", "twice the time");
  const int u = file.add("/u", {500, 2}, "m", "displacement");
  const int status = file.add("/status", {500}, "1", "state", SeriesFile::Storage::byte);
  std::vector<double> pairs(1000);
  std::vector<std::uint8_t> states(500);
  for (int n = 0; n < 30000 && file.fault().empty(); ++n) {
    pairs.assign(pairs.size(), n);
    states.assign(states.size(), static_cast<std::uint8_t>(n % 251));
    file.append(time, n);
    file.append(energy, 2.0 * n);
    file.append(u, pairs.data());
    file.append(status, states.data());
    file.end_row();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  if (!file.fault().empty()) std::fprintf(stderr, "%s\n", file.fault().c_str());
  return file.fault().empty() ? 0 : 1;
}
