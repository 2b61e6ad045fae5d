#include "slipscale/files/output_folder.hpp"

#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "slipscale/base/error.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/files/disk_space.hpp"
#include "slipscale/files/folder_lock.hpp"

namespace slipscale {
namespace {

namespace fs = std::filesystem;

std::string complaint(const std::string& folder, const std::string& fault) {
  return "-output_folder '" + folder + "' " + fault + "; give a folder that you may write to";
}

constexpr const char* ends[] = {"", ".partial",
                                ".journal"};  ///< of a file, and of what a kill left beside it

/// Removes the files of an older run; what is wrong, or nothing.
std::string remove_older(const std::string& folder, const std::vector<std::string>& files) {
  std::error_code error, ignored;
  for (const std::string& file : files) {
    fs::remove(fs::path(folder) / file, error);
    // What a run that was killed may have left beside it is in nobody's way if it cannot be removed.
    for (const char* end : ends) fs::remove(fs::path(folder) / (file + end), ignored);
    if (error)
      return complaint(folder, "holds a " + file + " that cannot be removed (" + error.message() + ")");
  }
  return "";
}

/// Moves them into another folder, in place of what that had under their names; what is wrong, or nothing.
std::string keep_older(const std::string& folder, const std::vector<std::string>& files,
                       const std::string& to) {
  std::error_code error;
  fs::create_directories(to, error);
  if (error) return complaint(to, "cannot be created (" + error.message() + ")");
  if (std::string fault = remove_older(to, files); !fault.empty()) return fault;
  for (const std::string& file : files)
    for (const char* end : ends) {
      const fs::path from = fs::path(folder) / (file + end);
      if (!fs::exists(from, error)) continue;
      fs::rename(from, fs::path(to) / (file + end), error);
      if (error)
        return complaint(folder, "holds a " + file + " that cannot be moved (" + error.message() + ")");
    }
  return "";
}

/// What is wrong with the folder, once made ready and locked; empty when nothing is. `kept`: where the older
/// run is, if it is worth it.
std::string prepare(const std::string& folder, const std::vector<std::string>& replaced,
                    const OutputFolder::WorthKeeping& worth_keeping, std::unique_ptr<FolderLock>& lock,
                    std::string& kept) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return complaint(folder, "cannot be created (" + error.message() + ")");
  try {
    lock = std::make_unique<FolderLock>(folder);
  } catch (const UserError& held) {
    return held.what();
  } catch (const LibraryError& failure) {
    return complaint(folder, std::string("cannot be written to (") + failure.what() + ")");
  }
  for (const std::string& file : replaced)
    if (fs::is_directory(fs::path(folder) / file, error))
      return complaint(folder, "holds a folder named " + file + ", which is to be a file");
  if (!worth_keeping || !worth_keeping(folder)) return remove_older(folder, replaced);
  kept = folder + "/replaced";
  return keep_older(folder, replaced, kept);
}

}  // namespace

std::string try_replace_text_file(const std::string& path, const std::string& text) {
  const std::string temporary = path + ".partial";
  std::FILE* const file = std::fopen(temporary.c_str(), "w");
  bool good = file && std::fwrite(text.data(), 1, text.size(), file) == text.size();
  if (file) good = std::fclose(file) == 0 && good;
  if (good && std::rename(temporary.c_str(), path.c_str()) == 0) return "";
  const std::string reason = std::strerror(errno);
  (void)std::remove(temporary.c_str());
  return write_fault(path, reason);
}

void replace_text_file(const std::string& path, const std::string& text) {
  if (const std::string fault = try_replace_text_file(path, text); !fault.empty()) throw LibraryError(fault);
}

std::string why_unwritable(const std::string& folder) {
  std::error_code none;
  fs::path place = fs::absolute(folder, none);
  while (!fs::exists(place, none) && place.has_relative_path()) place = place.parent_path();
  if (!fs::is_directory(place, none))
    return complaint(folder, "cannot be created ('" + place.string() + "' is no folder)");
  if (access(place.c_str(), W_OK | X_OK) != 0)
    return complaint(folder, "cannot be written to ('" + place.string() + "': " + std::strerror(errno) + ")");
  return "";
}

void refuse_unwritable(MPI_Comm comm, const std::string& folder) {
  throw_together(comm, is_root(comm) ? why_unwritable(folder) : "");
}

OutputFolder::OutputFolder(MPI_Comm comm, const std::string& folder, const std::vector<std::string>& replaced,
                           const WorthKeeping& worth_keeping)
    : comm_(comm), path_(folder) {
  // Past a limit on the size of files a write then fails with words, and the process is not ended by a
  // signal.
  (void)std::signal(SIGXFSZ, SIG_IGN);
  throw_together(comm, is_root(comm) ? prepare(folder, replaced, worth_keeping, lock_, kept_) : "");
}

OutputFolder::~OutputFolder() = default;
OutputFolder::OutputFolder(OutputFolder&&) noexcept = default;

void OutputFolder::write_text(const std::string& file, const std::string& text) const {
  stop_together(comm_, is_root(comm_) ? try_replace_text_file(path(file), text) : "");
}

}  // namespace slipscale
