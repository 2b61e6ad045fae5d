#include "slipscale/files/output_folder.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "slipscale/base/error.hpp"
#include "slipscale/base/parallel.hpp"

namespace slipscale {
namespace {

/// What is wrong with the folder, once made ready; empty when nothing is.
std::string prepare(const std::string& folder, const std::vector<std::string>& replaced) {
  const auto complain = [&](const std::string& fault) {
    return "-output_folder '" + folder + "' " + fault + "; give a folder that you may write to";
  };
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return complain("cannot be created (" + error.message() + ")");
  if (!std::filesystem::is_directory(folder)) return complain("is not a folder");
  for (const std::string& file : replaced) {
    std::filesystem::remove(std::filesystem::path(folder) / file, error);
    if (error) return complain("holds a " + file + " that cannot be removed (" + error.message() + ")");
  }
  const std::string probe = folder + "/.slipscale-probe";
  try {
    replace_text_file(probe, "");
  } catch (const LibraryError& failure) {
    return complain(std::string("cannot be written to (") + failure.what() + ")");
  }
  std::filesystem::remove(probe, error);
  return "";
}

}  // namespace

void replace_text_file(const std::string& path, const std::string& text) {
  const std::string temporary = path + ".partial";
  const auto fail = [&] {
    const std::string reason = std::strerror(errno);
    (void)std::remove(temporary.c_str());
    throw LibraryError("cannot write " + path + ": " + reason);
  };
  std::FILE* file = std::fopen(temporary.c_str(), "w");
  if (!file) fail();
  bool good = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  good = std::fclose(file) == 0 && good;
  if (!good || std::rename(temporary.c_str(), path.c_str()) != 0) fail();
}

OutputFolder::OutputFolder(MPI_Comm comm, const std::string& folder, const std::vector<std::string>& replaced)
    : comm_(comm), path_(folder) {
  throw_together(comm, is_root(comm) ? prepare(folder, replaced) : "");
}

void OutputFolder::write_text(const std::string& file, const std::string& text) const {
  std::string fault;
  try {
    if (is_root(comm_)) replace_text_file(path(file), text);
  } catch (const LibraryError& error) {
    fault = std::string(error.what()) + "; see that -output_folder is writable and its disk has room";
  }
  throw_together(comm_, fault);
}

}  // namespace slipscale
