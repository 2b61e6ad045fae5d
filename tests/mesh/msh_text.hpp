#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "scenes.hpp"
#include "slipscale/base/parallel.hpp"

namespace slipscale::testing_support {

/// A mesh file of parts, each of which a test may change: the unit square, two triangles.
struct MshText {
  std::string format = "4.1 0 8\n";
  std::string names = "2\n1 1 \"bottom\"\n2 1 \"matrix\"\n";
  std::string entities =
      "0 1 1 0\n"
      "1 0 0 0 1 0 0 1 1 0\n"
      "1 0 0 0 1 1 0 1 1 0\n";
  std::string nodes =
      "1 4 1 4\n"
      "2 1 0 4\n1\n2\n3\n4\n"
      "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  std::string elements =
      "2 3 1 3\n"
      "1 1 1 1\n1 1 2\n"
      "2 1 2 2\n2 1 2 3\n3 1 3 4\n";
  std::string more;

  std::string text() const {
    return "$MeshFormat\n" + format + "$EndMeshFormat\n$PhysicalNames\n" + names +
           "$EndPhysicalNames\n$Entities\n" + entities + "$EndEntities\n$Nodes\n" + nodes +
           "$EndNodes\n$Elements\n" + elements + "$EndElements\n" + more;
  }
};

/// The binary form of the text of a mesh file of MSH 4.1, by gmsh's description of the format.
std::string binary(const std::string& text);

/// Writes a file on rank 0 for all; the name is new for every call.
inline std::string written(const std::string& bytes) {
  const std::string path = scratch("case.msh");
  if (is_root(PETSC_COMM_WORLD)) std::ofstream(path, std::ios::binary) << bytes;
  MPI_Barrier(PETSC_COMM_WORLD);
  return path;
}

/// The sentence of the UserError that reading raises; empty when it raises none on some rank.
inline std::string complaint(const std::string& path, bool cut = false) {
  std::string text;
  try {
    read_mesh(PETSC_COMM_WORLD, {path, Partitioner::metis, 0, cut});
  } catch (const UserError& error) {
    text = error.what();
  }
  int all = !text.empty();
  MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_INT, MPI_MIN, PETSC_COMM_WORLD);
  return all ? text : "";
}

inline std::string complaint(const MshText& file) { return complaint(written(file.text())); }

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

/// One sentence with the fault and the cure.
inline void expect(const std::string& complaint, const std::string& fault, const std::string& cure) {
  EXPECT_NE(complaint.find(fault), std::string::npos) << "fault '" << fault << "' not in: " << complaint;
  EXPECT_NE(complaint.find(cure), std::string::npos) << "cure '" << cure << "' not in: " << complaint;
  EXPECT_EQ(complaint.find('\n'), std::string::npos);
}

}  // namespace slipscale::testing_support
