// Reads the mesh files that it is given, one after the other, and prints a line for each: its name, what came
// of it, the seconds, and the most memory that reading took above what there was before, in kB.
#include <chrono>
#include <cstdio>
#include <fstream>
#include <string>

#include "slipscale/base/error.hpp"
#include "slipscale/mesh/read.hpp"

using namespace slipscale;

namespace {

/// A line of /proc/self/status, kB.
long memory(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == name + ":") {
      long size = 0;
      status >> size;
      return size;
    }
  return 0;
}

std::string read(const char* path) {
  try {
    const Mesh mesh = read_mesh(PETSC_COMM_WORLD, {path});
    for (int cell = 0; cell < mesh.cells.size(); ++cell)
      for (int k = mesh.cells.first[cell]; k < mesh.cells.first[cell + 1]; ++k)
        if (mesh.cells.corner_nodes[k] < 0 || mesh.cells.corner_nodes[k] >= mesh.nodes.size())
          return "broken: a cell names a node that is not there";
    return "read";
  } catch (const UserError& error) {
    const std::string text = error.what();
    return text.find('\n') == text.npos ? "refused: " + text : "broken: a message of two lines";
  } catch (const std::exception& error) {
    return "broken: " + std::string(error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (PetscInitializeNoArguments()) return 1;
  keep_petsc_messages();
  for (int k = 1; k < argc; ++k) {
    std::ofstream("/proc/self/clear_refs") << 5;  // sets the peak to what there is
    const long before = memory("VmRSS");
    std::printf("%s\t", argv[k]);
    std::fflush(stdout);
    const auto start = std::chrono::steady_clock::now();
    const std::string outcome = read(argv[k]);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::printf("%.2f\t%ld\t%s\n", seconds, memory("VmHWM") - before, outcome.c_str());
    std::fflush(stdout);
  }
  return PetscFinalize() ? 1 : 0;
}
