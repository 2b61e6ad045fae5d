#include "scene_file.hpp"

#include <petscsys.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <vector>

#include "names.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/base/print.hpp"
#include "spelling.hpp"

namespace slipscale {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Whether PETSc can read the text; into a database of its own that is thrown away.
bool readable(const std::string& text) {
  PetscOptions scratch = nullptr;
  petsc(PetscOptionsCreate(&scratch));
  const PetscErrorCode code = PetscOptionsInsertStringYAML(scratch, text.c_str());
  (void)take_petsc_message();
  petsc(PetscOptionsDestroy(&scratch));
  return code == 0;
}

/// PETSc does not say where a YAML text goes wrong. The line after the longest readable beginning is the
/// place, or where the bracket opens that is never closed.
std::string place(const std::string& text) {
  const std::vector<std::string> lines = lines_of(text);
  // Every beginning is parsed anew: not worth the wait in a file that a program must have written.
  if (lines.size() > 2000) return "";
  std::vector<std::size_t> ends = {0};
  for (const std::string& line : lines) ends.push_back(std::min(ends.back() + line.size() + 1, text.size()));
  std::size_t good = lines.size();
  while (good > 0 && !readable(text.substr(0, ends[good]))) --good;
  if (good == lines.size()) return "";
  std::string shown = lines[good];
  shown.erase(0, std::min(shown.find_first_not_of(" \t\r"), shown.size()));
  return format(" near line {} ({:.60})", good + 1, shown);
}

/// Who wrote what so far, and where PETSc is reading now.
Origins origins;
Origin reading;

/// Names set by the file that is being read, folded, and the fault found in them.
struct Watch {
  bool active = false, merges = false;
  std::map<std::string, int> times;
  std::string fault;
} watch;

PetscErrorCode note_option(const char name[], const char value[], void*) {
  (void)value;
  origins[name] = reading;
  if (!watch.active || !watch.fault.empty()) return 0;
  const std::string folded = spelling::fold(name);
  if (++watch.times[folded] > 1 && !watch.merges)
    watch.fault = std::string(name) + " is given twice (keys join with _, capitals do not count); keep one";
  if (names::petsc_system(folded) || folded == "help")
    watch.fault = std::string(name) + " is read when PETSc starts; give it on the command line, as -" + name;
  return 0;
}

/// From now on, what PETSc's database is told comes from `place`, which is later than all before.
void begin_reading(const std::string& place) {
  if (reading.order == 0) petsc(PetscOptionsMonitorSet(note_option, nullptr, nullptr));
  reading = {reading.order + 1, place};
}

std::string explained(const std::string& message) {
  if (message.find("expected scalar or mapping") != std::string::npos)
    return " has a list inside a list%s; write one flat list, x1, y1, x2, y2, …";
  if (message.find("expected mapping") != std::string::npos)
    return " does not consist of options%s; write `name: value`, with a blank after the colon";
  if (message.find("prefix") != std::string::npos)
    return " has a name%s that no option can begin with; names begin with a letter";
  if (message.find("parser") != std::string::npos)
    return " is not valid YAML%s; look at the indentation (blanks, no tabs), colons, quotes and brackets";
  return " has something%s that options cannot express (" + message + ")";
}

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
    if (!fault.empty())
      fault = option + ": cannot read '" + file + "' (" + fault + "); give the path of a file";
  }
  throw_together(MPI_COMM_WORLD, fault);
  unsigned long long length = text.size();
  MPI_Bcast(&length, 1, MPI_UNSIGNED_LONG_LONG, 0, MPI_COMM_WORLD);
  text.resize(length);
  MPI_Bcast(text.data(), static_cast<int>(length), MPI_CHAR, 0, MPI_COMM_WORLD);
  return text;
}

void insert_scene(const std::string& file, const std::string& text) {
  begin_reading(file);
  // A merge key (`<<: *base`) is there to be overridden: the same name twice is then meant.
  watch = {.active = true, .merges = text.find("<<") != std::string::npos, .times = {}, .fault = {}};
  const PetscErrorCode code = PetscOptionsInsertStringYAML(nullptr, text.c_str());
  watch.active = false;
  if (code) {
    std::string sentence = explained(take_petsc_message());
    sentence.replace(sentence.find("%s"), 2, place(text));
    throw UserError(file + sentence);
  }
  if (watch.fault.empty()) return;
  // A `log_view` that came too late to be obeyed would make PETSc's end fail.
  petsc(PetscOptionsClear(nullptr));
  throw UserError(file + ": " + watch.fault);
}

void insert_arguments(std::vector<char*> arguments) {
  begin_reading("the command line");
  petsc(PetscOptionsInsertArgs(nullptr, static_cast<int>(arguments.size()) - 2, arguments.data() + 1));
}

const Origins& written_options() { return origins; }

}  // namespace slipscale
