#include "slipscale/record/checkpoint.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <tuple>

#include "slipscale/base/checksum.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/base/yaml_text.hpp"
#include "slipscale/files/disk_space.hpp"
#include "slipscale/files/yaml.hpp"

namespace slipscale {
namespace {

namespace fs = std::filesystem;

std::string materials_checksum(const std::vector<Material>& materials) {
  Checksum sum;
  for (const Material& material : materials) {
    sum.add(material.stiffness.data(), sizeof(double) * static_cast<std::size_t>(material.stiffness.size()));
    sum.add(&material.density, sizeof material.density);
  }
  return checksum_text(sum.value());
}

void rename_or_throw(const std::string& from, const std::string& to) {
  if (std::rename(from.c_str(), to.c_str()) != 0) throw LibraryError(std::strerror(errno));
}

/// Of what a checkpoint holds, for a program that expects another to say so.
constexpr const char* format_of_checkpoints = "3";

/// A folder by the name of one of the files would stop the next checkpoint.
void refuse_folders(const std::string& folder) {
  for (const char* name : {checkpoint_names[0], checkpoint_names[1], checkpoint_next}) {
    std::error_code none;
    if (fs::is_directory(folder + "/" + name, none))
      throw UserError("-restart: '" + folder + "/" + name +
                      "' is a folder, but it is to be a file; move it away");
  }
}

/// The newest sound checkpoint and what is to say of it. On the calling rank; UserError when there is none.
std::pair<std::string, std::string> newest_checkpoint(const std::string& folder) {
  const std::string newer = folder + "/" + checkpoint_names[0], older = folder + "/" + checkpoint_names[1];
  const bool has_newer = fs::exists(newer), has_older = fs::exists(older);
  if (has_newer && is_sealed(newer)) return {newer, ""};
  if (has_older && is_sealed(older))
    return {older,
            has_newer ? "'" + newer + "' is damaged; going on from '" + older + "', which is older" : ""};
  if (has_newer || has_older)
    throw UserError("-restart: the checkpoints in '" + folder +
                    "' are damaged (their checksums are wrong); start the run anew");
  throw UserError("-restart: there is no checkpoint in '" + folder +
                  "'; give the output folder of a run of slide " +
                  "that has one (checkpoint.h5; see -checkpoint_minutes)");
}

std::string read_text(hid_t file, const char* name) {
  const Hdf5Attribute attribute(hdf5(H5Aopen(file, name, H5P_DEFAULT), name));
  const Hdf5Type type(hdf5(H5Aget_type(attribute), name));
  std::string text(H5Tget_size(type), '\0');
  hdf5(H5Aread(attribute, type, text.data()), name);
  return text.substr(0, text.find('\0'));
}

/// Rank 0 reads, all ranks throw.
template <class Action>
void on_root(MPI_Comm comm, const std::string& path, Action&& action) {
  std::string fault;
  if (is_root(comm)) try {
      action();
    } catch (const UserError& error) {
      fault = error.what();
    } catch (const LibraryError& error) {
      fault = "-restart: '" + path + "' cannot be read: " + error.what() + "; start the run anew";
    }
  throw_together(comm, fault);
}

}  // namespace

bool can_go_on(const std::string& folder) {
  std::ifstream summary(folder + "/summary.yaml");
  for (std::string line; std::getline(summary, line);)
    if (line.starts_with("state: finished")) return false;
  return std::ranges::any_of(checkpoint_names,
                             [&](const char* name) { return is_sealed(folder + "/" + name); });
}

SceneMarks scene_marks(const Options& options, const Mesh& mesh, const std::vector<Material>& materials,
                       const std::string& run, const std::string& initial) {
  auto effective = options.effective();
  for (const char* of_the_job : {"restart", "time_wall", "progress"}) effective.erase(of_the_job);
  return {run_yaml(effective, [](Yaml& yaml) { yaml.text("program", "slide"); }),
          checksum_text(mesh.checksum), materials_checksum(materials), run, initial};
}

void write_checkpoint(MPI_Comm comm, const std::string& folder, const SceneMarks& marks,
                      const std::vector<StateGroup>& groups, bool sync) {
  const std::string newer = folder + "/" + checkpoint_names[0], older = folder + "/" + checkpoint_names[1],
                    next = folder + "/" + checkpoint_next;
  {
    SharedFile file(comm, next, state_bytes(comm, groups));
    file.describe("/", [&](hid_t root) {
      write_attribute(root, "format", format_of_checkpoints);
      write_attribute(root, "options", marks.options);
      write_attribute(root, "mesh_checksum", marks.mesh);
      write_attribute(root, "materials_checksum", marks.materials);
      write_attribute(root, "run", marks.run);
      if (!marks.initial.empty()) write_attribute(root, "initial_checksum", marks.initial);
    });
    write_state(comm, file, groups);
    file.finish();
  }
  write_together(comm, newer, [&] {
    if (!is_root(comm)) return;
    try {
      seal(next);
      if (sync) sync_file(next);
      if (fs::exists(newer)) rename_or_throw(newer, older);
      rename_or_throw(next, newer);
      if (sync) sync_file(newer);
    } catch (const LibraryError&) {
      (void)std::remove(next.c_str());
      throw;
    }
  });
}

Restart::Restart(MPI_Comm comm, const std::string& folder) : comm_(comm), folder_(folder) {
  on_root(comm, folder, [&] {
    refuse_folders(folder);
    std::tie(path_, note_) = newest_checkpoint(folder);
    file_ = open_file(path_);
    const std::string format = H5Aexists(file_, "format") > 0 ? read_text(file_, "format") : "1";
    if (format != format_of_checkpoints)
      throw UserError(
          "-restart: '" + path_ + "' was written by slipscale " + read_text(file_, "version") +
          " in a form that this version does not read; go on with that one, or start the run anew");
    mesh_ = read_text(file_, "mesh_checksum");
    materials_ = read_text(file_, "materials_checksum");
    run_ = read_text(file_, "run");
    if (H5Aexists(file_, "initial_checksum") > 0) initial_ = read_text(file_, "initial_checksum");
  });
  for (std::string* text : {&path_, &note_, &mesh_, &materials_, &run_, &initial_})
    *text = text_on_all(std::move(*text));
  double carried[5] = {};
  StateGroup body{"body", {0}, 0, is_root(comm), {{"carried", "", "", 5, carried}}};
  read({position_.state(is_root(comm)), body});
  steps_done_ = static_cast<long>(carried[0]);
}

void Restart::expect_files() const {
  on_root(comm_, folder_, [&] {
    std::vector<std::string> expected{"history.h5", "summary.yaml"};
    if (position_.contact_rows > 0) expected.push_back("contact.h5");
    if (position_.interface_rows > 0) expected.push_back("interfaces.h5");
    if (position_.frames > 0) expected.push_back("fields.h5");
    for (const std::string& file : expected)
      if (!fs::exists(fs::path(folder_) / file))
        throw UserError("-restart: the run in '" + folder_ + "' was finished, but its " + file +
                        " is gone; start the run anew");
  });
}

void Restart::check(const Mesh& mesh, const std::vector<Material>& materials,
                    const std::string& initial) const {
  if (checksum_text(mesh.checksum) != mesh_)
    throw UserError("-restart: the mesh '" + mesh.file + "' has the checksum " +
                    checksum_text(mesh.checksum) + ", but the run in '" + folder_ + "' began with " + mesh_ +
                    "; give that mesh with -mesh_file, or start a new run");
  if (materials_checksum(materials) != materials_)
    throw UserError("-restart: stiffness or density of a region is not what the run in '" + folder_ +
                    "' began with; put back the file that -material_..._file names, or start a new run");
  if (initial != initial_)
    throw UserError("-restart: what -initial_file holds is not what the run in '" + folder_ +
                    "' began with; put back that file, or start a new run");
}

TimeStep Restart::time_step(double end) const {
  TimeStep time = position_.time_step();
  const long own = time.count;
  time.count = steps_to(end, time.step, ", so give an earlier -time_end");
  if (time.count < own)
    throw UserError(
        format("-time_end is {:g} s, but the run in '{}' goes to {:g} s; a restart can only go further", end,
               folder_, static_cast<double>(own) * time.step));
  return time;
}

void Restart::read(std::vector<StateGroup> groups) const { read_state(comm_, file_, path_, groups); }

std::string options_of_checkpoint(const std::string& folder) {
  const std::string path = newest_checkpoint(folder).first;
  try {
    return read_text(open_file(path), "options");
  } catch (const LibraryError& error) {
    throw UserError("-restart: '" + path + "' cannot be read: " + error.what() + "; start the run anew");
  }
}

}  // namespace slipscale
