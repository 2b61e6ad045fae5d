#include "msh_file.hpp"

#include <fstream>
#include <stdexcept>

namespace slipscale::testing_support {
namespace {

void read_nodes(std::istream& in, MshFile& file) {
  long blocks, total, least, most;
  in >> blocks >> total >> least >> most;
  for (long b = 0; b < blocks; ++b) {
    long dimension, tag, parametric, count;
    in >> dimension >> tag >> parametric >> count;
    std::vector<long> numbers(count);
    for (long& number : numbers) in >> number;
    for (long number : numbers) {
      double z;
      in >> file.nodes[number][0] >> file.nodes[number][1] >> z;
    }
  }
}

void read_elements(std::istream& in, MshFile& file) {
  long blocks, total, least, most;
  in >> blocks >> total >> least >> most;
  for (long b = 0; b < blocks; ++b) {
    int dimension, tag, type;
    long count;
    in >> dimension >> tag >> type >> count;
    const int corners = type == 15 ? 1 : type == 1 ? 2 : type == 2 ? 3 : type == 3 ? 4 : 0;
    if (corners == 0) throw std::runtime_error("element type " + std::to_string(type));
    for (long e = 0; e < count; ++e) {
      long number;
      in >> number;
      std::vector<long> nodes(corners);
      for (long& node : nodes) in >> node;
      if (dimension == 2) file.cells.push_back({tag, nodes});
    }
  }
}

void read_pairs(std::istream& in, MshFile& file) {
  long links;
  in >> links;
  for (long k = 0; k < links; ++k) {
    int dimension, slave, master;
    long values, count;
    in >> dimension >> slave >> master >> values;
    std::vector<double> affine(values);
    for (double& value : affine) in >> value;
    in >> count;
    for (long i = 0; i < count; ++i) {
      MshFile::Pair pair{dimension, {affine.at(3), affine.at(7)}, 0, 0};
      in >> pair.node >> pair.master;
      file.pairs.push_back(pair);
    }
  }
}

}  // namespace

MshFile read_msh(const std::string& path) {
  std::ifstream in(path);
  MshFile file;
  for (std::string word; in >> word;) {
    if (word == "$Nodes") read_nodes(in, file);
    if (word == "$Elements") read_elements(in, file);
    if (word == "$Periodic") read_pairs(in, file);
  }
  if (file.nodes.empty()) throw std::runtime_error("no nodes in " + path);
  return file;
}

}  // namespace slipscale::testing_support
