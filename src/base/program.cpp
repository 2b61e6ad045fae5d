#include "slipscale/base/program.hpp"

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

#include "command_line.hpp"
#include "names.hpp"
#include "places_of_petsc.hpp"
#include "process.hpp"
#include "restart_options.hpp"
#include "scene_file.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/base/provenance.hpp"
#include "slipscale/base/yaml_text.hpp"
#include "slipscale/version.hpp"

namespace slipscale {
namespace {

void complain(const std::string& program, const std::string& text) {
  const std::string sentence = one_line(text);
  std::fflush(stdout);
  std::fprintf(stderr, "%s: %s\n", program.c_str(), sentence.c_str());
  std::fflush(stderr);
}

/// Other ranks may be waiting in a collective call that this one will never join, so all are ended.
[[noreturn]] void abort_all(const std::string& program, const std::string& what) {
  complain(program, "failed on rank " + std::to_string(rank_of(MPI_COMM_WORLD)) + ": " + what);
  MPI_Abort(MPI_COMM_WORLD, 1);
  std::abort();
}

/// 0 when `work` returns, 2 when all ranks threw the same `UserError`, 1 for a `RunError`,
/// 3 for an `Interruption`.
int guarded(const std::string& program, const std::function<void()>& work) {
  try {
    work();
    return 0;
  } catch (const UserError& error) {
    if (is_root(MPI_COMM_WORLD)) complain(program, error.what());
    return 2;
  } catch (const RunError& error) {
    if (is_root(MPI_COMM_WORLD)) complain(program, error.what());
    return 1;
  } catch (const Interruption& stop) {
    if (is_root(MPI_COMM_WORLD)) complain(program, stop.what());
    return 3;
  } catch (const std::bad_alloc&) {
    abort_all(program, "out of memory; use more ranks or a coarser mesh");
  } catch (const std::exception& error) {
    abort_all(program, error.what());
  } catch (...) {
    abort_all(program, "an exception that says nothing");
  }
}

/// The scenes one after the other, then the command line over them.
std::vector<Written> read_later(const CommandLine& line) {
  std::vector<Written> options;
  int order = 1;
  for (const std::string& file : line.scene_files) {
    const auto scene = read_scene_text(file, read_on_all("-options_file_yaml", file), ++order);
    options.insert(options.end(), scene.begin(), scene.end());
  }
  ++order;
  for (Written option : line.options) {
    option.origin = {order, "the command line"};
    options.push_back(option);
  }
  return options;
}

bool is_petsc(const Program& program, const std::string& name) {
  return names::petsc_system(name) || names::petsc_object(name, program.solvers);
}

/// The scenes one after the other, then the command line over them; below all of them, what was in effect in
/// the run that is gone on with.
std::vector<Written> read_all(const Program& program, const CommandLine& line) {
  std::vector<Written> options = read_later(line);
  const auto restart = std::ranges::find(options, "restart", &Written::name);
  if (!program.restart || restart == options.end()) return options;
  const std::vector<Written> before = options_of_run(*program.restart, *restart);
  std::vector<Written> own = options;
  std::erase_if(own, [&](const Written& option) { return is_petsc(program, option.name); });
  refuse_changes(before, own, *program.restart, program.schema, *restart->value);
  options.insert(options.begin(), before.begin(), before.end());
  return options;
}

/// What PETSc is to see of the command line: its own options, and its own files.
std::vector<std::string> petsc_arguments(const Program& program, const CommandLine& line) {
  std::vector<std::string> arguments{line.program};
  for (const std::string& file : line.option_files)
    arguments.insert(arguments.end(), {"-options_file", file});
  for (const Written& option : line.options) {
    if (!is_petsc(program, option.name)) continue;
    arguments.push_back("-" + option.name);
    if (option.value) arguments.push_back(*option.value);
  }
  return arguments;
}

/// PETSc's own options of the scenes, and over them those of the command line.
void fill_database(const Program& program, const std::vector<Written>& options,
                   std::vector<char*>& arguments) {
  for (const Written& option : options)
    if (option.in_yaml && is_petsc(program, option.name))
      petsc(PetscOptionsSetValue(nullptr, ("-" + option.name).c_str(),
                                 option.value ? option.value->c_str() : nullptr));
  petsc(PetscOptionsInsertArgs(nullptr, static_cast<int>(arguments.size()) - 2, arguments.data() + 1));
}

/// PETSc lists options nobody read, at length; we have told the user already, and better.
void silence_leftovers() {
  PetscBool given = PETSC_FALSE;
  petsc(PetscOptionsHasName(nullptr, nullptr, "-options_left", &given));
  if (!given) petsc(PetscOptionsSetValue(nullptr, "-options_left", "no"));
}

/// The libraries under MPI have handlers of their own: UCX takes the hang-up for its debugger.
void start_mpi(int& argc, char**& argv) {
  const KeptSignals kept;
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
}

/// Where PETSc does not start it is for its options: everything else is as at every start.
void start_petsc(std::vector<char*>& arguments) {
  int argc = static_cast<int>(arguments.size()) - 1;
  char** argv = arguments.data();
  const KeptSignals kept;
  // Before PETSc starts, so that its debugging options (-on_error_abort) come on top of ours.
  keep_petsc_messages();
  if (PetscInitialize(&argc, &argv, nullptr, nullptr))
    throw UserError(
        "PETSc does not start with the options it finds, on the command line, in PETSC_OPTIONS or in "
        ".petscrc: " +
        take_petsc_message() + "; correct or remove them");
}

/// Of variables and files. PETSc is not to find them when it ends either.
void refuse_petsc_values(const std::vector<Written>& options) {
  try {
    check_petsc_values(options);
  } catch (const UserError&) {
    for (const Written& option : options)
      if (names::petsc_system(option.name))
        petsc(PetscOptionsClearValue(nullptr, ("-" + option.name).c_str()));
    throw;
  }
}

int run_in_petsc(const Program& program, const CommandLine& line, const std::vector<Written>& own) {
  std::vector<std::string> words = petsc_arguments(program, line);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  start_petsc(arguments);
  const int code = guarded(program.name, [&] {
    std::vector<Written> written;
    for (const std::string& file : line.option_files)
      for (const Written& option : options_of_petsc_file(file)) written.push_back(option);
    written.insert(written.end(), own.begin(), own.end());
    std::vector<Written> found = PlacesOfPetsc().all();
    found.insert(found.end(), written.begin(), written.end());
    if (program.restart) refuse_restart_elsewhere(found);
    refuse_petsc_values(found);
    fill_database(program, written, arguments);
    Options options(program.name, program.schema, written, program.solvers);
    program.run(options);
  });
  silence_leftovers();
  petsc(PetscFinalize());
  return code;
}

/// "Open MPI v4.1.4, package: …" up to the comma.
std::string mpi_version() {
  std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> text{};
  int length = 0;
  MPI_Get_library_version(text.data(), &length);
  const std::string whole(text.data(), static_cast<std::size_t>(length));
  return whole.substr(0, whole.find_first_of(",\n"));
}

std::string hdf5_version() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return format("HDF5 {}.{}.{}", major, minor, release);
}

std::string petsc_version() {
  PetscInt major = 0, minor = 0, patch = 0, is_release = 0;
  petsc(PetscGetVersionNumber(&major, &minor, &patch, &is_release));
  return format("PETSc {}.{}.{}", major, minor, patch);
}

std::string version_line(const Program& program) {
  std::string line = program.name + " " + version;
  if (!program.commit.empty()) line += " (commit " + program.commit + ")";
  std::vector<std::string> libraries{petsc_version(), mpi_version(), hdf5_version()};
  libraries.insert(libraries.end(), program.libraries.begin(), program.libraries.end());
  for (const std::string& library : libraries) line += ", " + library;
  return line + "\n";
}

int answer(int argc, char** argv, const Program& program) {
  const CommandLine line = read_command_line(argc, argv);
  if (line.help) {
    print(manual(program.name, program.purpose, program.schema));
    return 0;
  }
  if (line.version) {
    print(version_line(program));
    return 0;
  }
  check_petsc_values(line.options);
  for (const std::string& file : line.option_files) (void)read_on_all("-options_file", file);
  return run_in_petsc(program, line, read_all(program, line));
}

}  // namespace

void end_reading(const Options& options) {
  options.refuse_unread();
  print_notes(options.notes());
}

int run_program(int argc, char** argv, const Program& program) {
  set_program(program.name, program.commit);
  start_alone();
  start_mpi(argc, argv);
  int code = 0;
  const int fault = guarded(program.name, [&] { code = answer(argc, argv, program); });
  MPI_Finalize();
  return std::max(code, fault);
}

}  // namespace slipscale
