#include "scene_file.hpp"

#include <mpi.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "names.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/base/yaml_text.hpp"
#include "spelling.hpp"

namespace slipscale {

namespace {

constexpr std::size_t most_bytes = 100000000;

}  // namespace

std::string read_on_all(const std::string& option, const std::string& file) {
  std::string text, fault;
  if (is_root(MPI_COMM_WORLD)) {
    errno = 0;
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream content;
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored))
      fault = "it is a folder";
    else if (!stream)
      fault = errno ? std::strerror(errno) : "it does not open";
    else if (stream.peek() != std::ifstream::traits_type::eof() && !(content << stream.rdbuf()))
      fault = "reading fails";
    text = content.str();
    if (text.size() > most_bytes) fault = "it has more than 100 MB, which is no list of options";
    if (!fault.empty())
      fault = option + ": cannot read '" + file + "' (" + fault + "); give the path of a file";
  }
  throw_together(MPI_COMM_WORLD, fault);
  return text_on_all(std::move(text));
}

std::string text_on_all(std::string text) {
  unsigned long long length = text.size();
  MPI_Bcast(&length, 1, MPI_UNSIGNED_LONG_LONG, 0, MPI_COMM_WORLD);
  text.resize(length);
  MPI_Bcast(text.data(), static_cast<int>(length), MPI_CHAR, 0, MPI_COMM_WORLD);
  return text;
}

std::vector<Written> read_scene_text(const std::string& file, const std::string& text, int order) {
  std::vector<Written> options;
  std::set<std::string> names;
  for (YamlEntry& entry : read_yaml(file, text)) {
    const std::string folded = spelling::fold(entry.name);
    if (!names.insert(folded).second)
      throw UserError(file + ": " + entry.name + " is given twice, the second time in line " +
                      std::to_string(entry.line) + " (keys join with _, capitals do not count); keep one");
    if (names::petsc_system(folded) || folded == "help")
      throw UserError(file + ": " + entry.name +
                      " is read when PETSc starts; give it on the command line, as -" + entry.name);
    options.push_back(
        {std::move(entry.name), std::move(entry.value), {order, file}, true, std::move(entry.doubt)});
  }
  return options;
}

}  // namespace slipscale
