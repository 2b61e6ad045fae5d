#include "block_mesh.hpp"

#include <petscsys.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <vector>

#include "slipscale/base/parallel.hpp"

namespace slipscale::testing_support {
namespace {

struct Corners {
  std::vector<int> nodes;
  int region;
};

class Writer {
 public:
  explicit Writer(const Block& block) : b(block) {}

  void write(const std::string& path) {
    out.open(path);
    out.precision(17);
    make_cells();
    names();
    entities();
    nodes();
    elements();
    if (b.periodic_x || b.periodic_y) periodic();
  }

 private:
  int node(int i, int j) const { return j * (b.nx + 1) + i + 1; }

  std::array<double, 2> position(int i, int j) const {
    const double dx = b.width / b.nx, dy = b.height / b.ny;
    std::array<double, 2> x{b.left + b.width * i / b.nx, b.height * j / b.ny};
    if (i > 0 && i < b.nx && j > 0 && j < b.ny) {
      x[0] += b.distortion * dx * std::sin(12.9898 * i + 78.233 * j);
      x[1] += b.distortion * dy * std::sin(39.346 * i + 11.135 * j);
    }
    return x;
  }

  void make_cells() {
    for (int j = 0; j < b.ny; ++j)
      for (int i = 0; i < b.nx; ++i) {
        const int a = node(i, j), c = node(i + 1, j), d = node(i + 1, j + 1), e = node(i, j + 1);
        const int region = b.region(b.left + b.width * (i + 0.5) / b.nx, b.height * (j + 0.5) / b.ny);
        two_regions = two_regions || region == 2;
        const bool quad = b.shape == Shape::quadrilaterals || (b.shape == Shape::mixed && (i + j) % 2 == 0);
        if (quad) {
          quads.push_back({{a, c, d, e}, region});
        } else if (b.mirrored) {
          triangles.push_back({{a, c, e}, region});
          triangles.push_back({{c, d, e}, region});
        } else {
          triangles.push_back({{a, c, d}, region});
          triangles.push_back({{a, d, e}, region});
        }
      }
  }

  void names() {
    out << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n"
        << (two_regions ? 6 : 5) << '\n'
        << "1 1 \"bottom\"\n1 2 \"right\"\n1 3 \"top\"\n1 4 \"left\"\n2 1 \"matrix\"\n";
    if (two_regions) out << "2 2 \"inclusion\"\n";
    out << "$EndPhysicalNames\n";
  }

  void entities() {
    const double x0 = b.left, x1 = b.left + b.width, y1 = b.height;
    out << "$Entities\n4 4 " << (two_regions ? 2 : 1) << " 0\n";
    out << "1 " << x0 << " 0 0 0\n2 " << x1 << " 0 0 0\n3 " << x1 << ' ' << y1 << " 0 0\n4 " << x0 << ' '
        << y1 << " 0 0\n";
    out << "1 " << x0 << " 0 0 " << x1 << " 0 0 1 1 2 1 -2\n";
    out << "2 " << x1 << " 0 0 " << x1 << ' ' << y1 << " 0 1 2 2 2 -3\n";
    out << "3 " << x0 << ' ' << y1 << " 0 " << x1 << ' ' << y1 << " 0 1 3 2 3 -4\n";
    out << "4 " << x0 << " 0 0 " << x0 << ' ' << y1 << " 0 1 4 2 4 -1\n";
    for (int region = 1; region <= (two_regions ? 2 : 1); ++region)
      out << region << ' ' << x0 << " 0 0 " << x1 << ' ' << y1 << " 0 1 " << region << " 4 1 2 3 4\n";
    out << "$EndEntities\n";
  }

  void nodes() {
    const int count = (b.nx + 1) * (b.ny + 1);
    out << "$Nodes\n9 " << count << " 1 " << count << '\n';
    const auto block = [&](int dim, int tag, const std::vector<std::array<int, 2>>& at) {
      out << dim << ' ' << tag << " 0 " << at.size() << '\n';
      for (const auto& [i, j] : at) out << node(i, j) << '\n';
      for (const auto& [i, j] : at) {
        const auto x = position(i, j);
        out << x[0] << ' ' << x[1] << " 0\n";
      }
    };
    block(0, 1, {{0, 0}});
    block(0, 2, {{b.nx, 0}});
    block(0, 3, {{b.nx, b.ny}});
    block(0, 4, {{0, b.ny}});
    std::vector<std::array<int, 2>> bottom, right, top, left, inside;
    for (int i = 1; i < b.nx; ++i) bottom.push_back({i, 0});
    for (int j = 1; j < b.ny; ++j) right.push_back({b.nx, j});
    for (int i = b.nx - 1; i > 0; --i) top.push_back({i, b.ny});
    for (int j = b.ny - 1; j > 0; --j) left.push_back({0, j});
    for (int j = 1; j < b.ny; ++j)
      for (int i = 1; i < b.nx; ++i) inside.push_back({i, j});
    block(1, 1, bottom);
    block(1, 2, right);
    block(1, 3, top);
    block(1, 4, left);
    block(2, 1, inside);
    out << "$EndNodes\n";
  }

  void elements() {
    struct Part {
      int dim, entity, type;
      std::vector<std::vector<int>> cells;
    };
    std::vector<Part> parts(4);
    for (int side = 0; side < 4; ++side) parts[side] = {1, side + 1, 1, {}};
    for (int i = 0; i < b.nx; ++i) parts[0].cells.push_back({node(i, 0), node(i + 1, 0)});
    for (int j = 0; j < b.ny; ++j) parts[1].cells.push_back({node(b.nx, j), node(b.nx, j + 1)});
    for (int i = b.nx; i > 0; --i) parts[2].cells.push_back({node(i, b.ny), node(i - 1, b.ny)});
    for (int j = b.ny; j > 0; --j) parts[3].cells.push_back({node(0, j), node(0, j - 1)});
    for (int region = 1; region <= 2; ++region) {
      Part p1{2, region, 2, {}}, q1{2, region, 3, {}};
      for (const auto& c : triangles)
        if (c.region == region) p1.cells.push_back(c.nodes);
      for (const auto& c : quads)
        if (c.region == region) q1.cells.push_back(c.nodes);
      if (!p1.cells.empty()) parts.push_back(p1);
      if (!q1.cells.empty()) parts.push_back(q1);
    }
    std::size_t total = 0;
    for (const auto& part : parts) total += part.cells.size();
    out << "$Elements\n" << parts.size() << ' ' << total << " 1 " << total << '\n';
    std::size_t tag = 0;
    for (const auto& part : parts) {
      out << part.dim << ' ' << part.entity << ' ' << part.type << ' ' << part.cells.size() << '\n';
      for (const auto& cell : part.cells) {
        out << ++tag;
        for (int n : cell) out << ' ' << n;
        out << '\n';
      }
    }
    out << "$EndElements\n";
  }

  /// What one entity copies from another, shifted by (dx, dy).
  struct Link {
    int dim, slave, master;
    double dx, dy;
    std::vector<std::array<int, 2>> nodes;
  };

  std::vector<Link> links() const {
    const int a = node(0, 0), c = node(b.nx, 0), d = node(b.nx, b.ny), e = node(0, b.ny);
    std::vector<Link> all;
    if (b.periodic_x) {
      all.push_back({0, 2, 1, b.width, 0, {{c, a}}});
      Link right{1, 2, 4, b.width, 0, {}};
      for (int j = 0; j <= b.ny; ++j) right.nodes.push_back({node(b.nx, j), node(0, j)});
      if (!b.periodic_y) all.push_back({0, 3, 4, b.width, 0, {{d, e}}});
      all.push_back(right);
    }
    if (b.periodic_y) {
      all.push_back({0, 4, 1, 0, b.height, {{e, a}}});
      Link top{1, 3, 1, 0, b.height, {}};
      for (int i = 0; i <= b.nx; ++i) top.nodes.push_back({node(i, b.ny), node(i, 0)});
      all.push_back({0, 3, 2, 0, b.height, {{d, c}}});
      all.push_back(top);
    }
    return all;
  }

  void periodic() {
    const auto all = links();
    out << "$Periodic\n" << all.size() << '\n';
    for (const Link& link : all) {
      out << link.dim << ' ' << link.slave << ' ' << link.master << '\n';
      out << "16 1 0 0 " << link.dx << " 0 1 0 " << link.dy << " 0 0 1 0 0 0 0 1\n"
          << link.nodes.size() << '\n';
      for (const auto& [slave, master] : link.nodes) out << slave << ' ' << master << '\n';
    }
    out << "$EndPeriodic\n";
  }

  const Block& b;
  std::ofstream out;
  std::vector<Corners> triangles, quads;
  bool two_regions = false;
};

}  // namespace

void write_block(const Block& block, const std::string& path) {
  if (is_root(PETSC_COMM_WORLD)) Writer(block).write(path);
  MPI_Barrier(PETSC_COMM_WORLD);
}

namespace {

std::filesystem::path scratch_folder;

}  // namespace

std::string scratch(const std::string& name) {
  static int calls = 0;
  int process = static_cast<int>(getpid());
  MPI_Bcast(&process, 1, MPI_INT, 0, PETSC_COMM_WORLD);
  scratch_folder = std::filesystem::temp_directory_path() / ("slipscale-test-" + std::to_string(process));
  std::filesystem::create_directories(scratch_folder);
  return (scratch_folder / (std::to_string(++calls) + "-" + name)).string();
}

void remove_scratch() {
  std::error_code ignored;  // another rank may have been faster
  if (!scratch_folder.empty()) std::filesystem::remove_all(scratch_folder, ignored);
}

}  // namespace slipscale::testing_support
