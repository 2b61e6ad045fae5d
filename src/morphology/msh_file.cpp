#include "msh_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <vector>

#include "slipscale/base/error.hpp"

namespace slipscale {
namespace {

/// The rest of the file from where the stream stands, with the pairs of each periodic link sorted.
std::string sorted_links(std::istream& in) {
  std::string text, line;
  std::getline(in, line);
  text += line + "\n";
  const long links = std::stol(line);
  for (long link = 0; link < links; ++link) {
    for (int header = 0; header < 3; ++header) {  // entities, affine map, number of pairs
      std::getline(in, line);
      text += line + "\n";
    }
    std::vector<std::pair<long, long>> pairs(static_cast<std::size_t>(std::stol(line)));
    for (auto& [node, master] : pairs) in >> node >> master;
    in.ignore(1, '\n');
    std::ranges::sort(pairs);
    for (const auto& [node, master] : pairs)
      text += std::to_string(node) + " " + std::to_string(master) + "\n";
  }
  while (std::getline(in, line)) text += line + "\n";
  return text;
}

}  // namespace

void sort_periodic_pairs(const std::string& path) {
  std::ifstream in(path);
  std::string line;
  while (std::getline(in, line) && line != "$Periodic") {
  }
  if (!in) return;
  const auto begin = in.tellg();
  const std::string sorted = sorted_links(in);
  in.close();
  std::filesystem::resize_file(path, static_cast<std::uintmax_t>(begin));
  std::ofstream out(path, std::ios::app);
  if (!(out << sorted << std::flush)) throw LibraryError("cannot write '" + path + "'");
}

}  // namespace slipscale
