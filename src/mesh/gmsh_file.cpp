#include "gmsh_file.hpp"

#include <charconv>
#include <filesystem>
#include <fstream>

#include "slipscale/base/checksum.hpp"
#include "slipscale/base/error.hpp"

namespace slipscale::mesh_stages {
namespace {

std::string bytes_of(const std::string& path) {
  std::error_code none;
  std::ifstream stream(path, std::ios::binary);
  if (!stream || !std::filesystem::is_regular_file(path, none))
    throw UserError("-mesh_file: cannot read '" + path + "'; give the path of a gmsh file (MSH 4.1)");
  std::string bytes(std::filesystem::file_size(path), '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  return bytes;
}

/// What gmsh (4.8 and later) does to a file that it can read and we cannot.
std::string conversion(const std::string& path) {
  const auto quoted = [](const std::string& word) {
    return word.find_first_of(" '\"") == word.npos ? word : '"' + word + '"';
  };
  std::filesystem::path other(path);
  other.replace_filename(other.stem().string() + "-41.msh");
  return "gmsh -0 " + quoted(path) + " -format msh41 -o " + quoted(other.string());
}

/// What cannot be converted, since gmsh loses the pairs of nodes when it reads MSH 2.
bool loses_periods(double version, const std::string& bytes) {
  return version < 4 && bytes.find("\n$Periodic") != bytes.npos;
}

/// Reads the section $MeshFormat. What stands before it is skipped.
void read_format(GmshStream& in, const std::string& path, const std::string& bytes) {
  std::string name = in.open();
  while (!name.empty() && name != "MeshFormat") {
    in.skip();
    name = in.open();
  }
  const std::string version(in.word()), form(in.word()), width(in.word());
  double number = 0;
  std::from_chars(version.data(), version.data() + version.size(), number);
  if (number != 4.1) {
    const std::string is_old = "is written as MSH " + version.substr(0, 8) + ", and only MSH 4.1 is read; ";
    throw GmshFault(is_old +
                    (loses_periods(number, bytes)
                         ? "it would lose its periodicity when it is converted, so mesh its geometry "
                           "again with gmsh -2 -format msh41"
                         : "convert it with " + conversion(path)));
  }
  if ((form != "0" && form != "1") || width != "8")
    throw GmshFault("is written as no MSH 4.1 of 8-byte sizes; convert it with " + conversion(path));
  in.line();
  if (form == "1") {
    in.set_binary();
    if (in.integer() != 1)
      throw GmshFault("is written in the byte order of another machine; convert it with " + conversion(path));
  }
  in.close();
}

}  // namespace

std::string sentence(const std::string& path, const std::string& fault) {
  std::string text = "mesh '" + path + "'" + (fault.starts_with(":") ? "" : " ") + fault;
  for (char& c : text)  // of a damaged name
    if (static_cast<unsigned char>(c) < ' ') c = '?';
  return text;
}

GmshFile read_gmsh(const std::string& path) {
  const std::string bytes = bytes_of(path);
  if (bytes.starts_with("$NOD"))
    throw UserError(
        sentence(path, "is written as MSH 1, and only MSH 4.1 is read; convert it with " + conversion(path)));
  if (bytes.substr(0, 4096).find("$MeshFormat") == bytes.npos)
    throw UserError("-mesh_file: '" + path + "' is not a gmsh mesh; write one with gmsh -2 -format msh41");
  try {
    GmshStream stream(bytes);
    read_format(stream, path, bytes);
    Checksum sum;
    sum.add(bytes.data(), bytes.size());
    return {sum.value(), read_gmsh_mesh(stream)};
  } catch (const GmshFault& fault) {
    throw UserError(sentence(path, fault.what()));
  }
}

}  // namespace slipscale::mesh_stages
