#include "slipscale/morphology/grid_file.hpp"

#include <charconv>
#include <cstring>
#include <fstream>
#include <vector>

#include "msh_file.hpp"

namespace slipscale {
namespace {

/// Text in pieces of a megabyte. Numbers are the shortest that give back the same bits.
class Text {
 public:
  explicit Text(const std::string& path) : path_(path), file_(path, std::ios::binary) {
    buffer_.reserve(room);
  }

  template <class... Words>
  void line(const Words&... words) {
    bool first = true;
    ((first ? void(first = false) : buffer_.push_back(' '), add(words)), ...);
    buffer_ += '\n';
    if (buffer_.size() > room - longest_line) flush();
  }

  void close() {
    flush();
    file_.close();
    if (!file_) refuse_unwritten(path_);
  }

 private:
  static constexpr std::size_t room = 1 << 20, longest_line = 1 << 12;

  void add(const char* word) { buffer_ += word; }
  void add(const std::string& word) { buffer_ += word; }
  template <class Number>
  void add(Number number) {
    char digits[32];
    const auto [end, fault] = std::to_chars(digits, digits + sizeof digits, number);
    buffer_.append(digits, end);
  }

  void flush() {
    file_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    if (!file_) refuse_unwritten(path_);
    buffer_.clear();
  }

  std::string path_;
  std::ofstream file_;
  std::string buffer_;
};

constexpr int line_type = 1, triangle_type = 2, quadrilateral_type = 3;

class GridFile {
 public:
  GridFile(const CompositeMesh& mesh, const Box& block, const std::array<int, 2>& cells,
           const std::array<bool, 2>& periodic, const std::string& path)
      : mesh_(mesh), block_(block), cells_(cells), periodic_(periodic), text_(path) {}

  void write() {
    text_.line("$MeshFormat");
    text_.line(4.1, 0, 8);
    text_.line("$EndMeshFormat");
    names();
    entities();
    nodes();
    elements();
    if (periodic_[0] || periodic_[1]) pairs();
    text_.close();
  }

 private:
  int node(int column, int row) const { return row * (cells_[0] + 1) + column + 1; }

  /// Nodes of bottom, right, top and left, ascending.
  std::vector<int> side(int k) const {
    std::vector<int> found;
    const int along = k % 2;
    for (int i = 0; i <= cells_[along]; ++i)
      found.push_back(along == 0 ? node(i, k == 0 ? 0 : cells_[1]) : node(k == 1 ? cells_[0] : 0, i));
    return found;
  }

  void names() {
    text_.line("$PhysicalNames");
    text_.line(4 + mesh_.regions.size());
    int tag = 0;
    for (const char* name : {"\"bottom\"", "\"right\"", "\"top\"", "\"left\""}) text_.line(1, ++tag, name);
    for (std::size_t k = 0; k < mesh_.regions.size(); ++k) text_.line(2, k + 1, '"' + mesh_.regions[k] + '"');
    text_.line("$EndPhysicalNames");
  }

  void entities() {
    const double x0 = block_.lower[0], x1 = block_.upper[0], y0 = block_.lower[1], y1 = block_.upper[1];
    text_.line("$Entities");
    text_.line(4, 4, mesh_.regions.size(), 0);
    text_.line(1, x0, y0, 0, 0);
    text_.line(2, x1, y0, 0, 0);
    text_.line(3, x1, y1, 0, 0);
    text_.line(4, x0, y1, 0, 0);
    text_.line(1, x0, y0, 0, x1, y0, 0, 1, 1, 2, 1, -2);
    text_.line(2, x1, y0, 0, x1, y1, 0, 1, 2, 2, 2, -3);
    text_.line(3, x0, y1, 0, x1, y1, 0, 1, 3, 2, 4, -3);
    text_.line(4, x0, y0, 0, x0, y1, 0, 1, 4, 2, 1, -4);
    for (std::size_t k = 1; k <= mesh_.regions.size(); ++k) text_.line(k, x0, y0, 0, x1, y1, 0, 1, k, 0);
    text_.line("$EndEntities");
  }

  void nodes() {
    const std::size_t count = mesh_.nodes.size();
    text_.line("$Nodes");
    text_.line(1, count, 1, count);
    text_.line(2, 1, 0, count);
    for (std::size_t k = 1; k <= count; ++k) text_.line(k);
    for (const Vector2& x : mesh_.nodes) text_.line(x[0], x[1], 0);
    text_.line("$EndNodes");
  }

  /// Cells of one surface and one type stand together; their numbers tell the order of the mesh.
  void elements() {
    const std::size_t edges = 2 * static_cast<std::size_t>(cells_[0] + cells_[1]);
    std::vector<std::array<std::size_t, 2>> counts(mesh_.regions.size());
    for (const CompositeMesh::Cell& cell : mesh_.cells) ++counts[cell.region][cell.count - 3];
    std::size_t blocks = 4;
    for (const auto& count : counts) blocks += (count[0] > 0) + (count[1] > 0);
    text_.line("$Elements");
    text_.line(blocks, edges + mesh_.cells.size(), 1, edges + mesh_.cells.size());
    std::size_t tag = 0;
    for (int k = 0; k < 4; ++k) {
      const std::vector<int> nodes = side(k);
      text_.line(1, k + 1, line_type, nodes.size() - 1);
      for (std::size_t i = 0; i + 1 < nodes.size(); ++i) text_.line(++tag, nodes[i], nodes[i + 1]);
    }
    for (std::size_t region = 0; region < counts.size(); ++region)
      for (const int corners : {3, 4}) {
        if (counts[region][corners - 3] == 0) continue;
        text_.line(2, region + 1, corners == 3 ? triangle_type : quadrilateral_type,
                   counts[region][corners - 3]);
        for (std::size_t k = 0; k < mesh_.cells.size(); ++k) {
          const CompositeMesh::Cell& cell = mesh_.cells[k];
          if (cell.region != static_cast<int>(region) || cell.count != corners) continue;
          const auto& c = cell.corners;
          if (corners == 3)
            text_.line(edges + k + 1, c[0] + 1, c[1] + 1, c[2] + 1);
          else
            text_.line(edges + k + 1, c[0] + 1, c[1] + 1, c[2] + 1, c[3] + 1);
        }
      }
    text_.line("$EndElements");
  }

  void pairs() {
    text_.line("$Periodic");
    text_.line(int{periodic_[0]} + int{periodic_[1]});
    for (int axis = 0; axis < 2; ++axis) {
      if (!periodic_[axis]) continue;
      const int slave = axis == 0 ? 1 : 2, master = axis == 0 ? 3 : 0;  // right of left, top of bottom
      const std::vector<int> slaves = side(slave), masters = side(master);
      text_.line(1, slave + 1, master + 1);
      text_.line(16, 1, 0, 0, axis == 0 ? block_.width() : 0, 0, 1, 0, axis == 1 ? block_.height() : 0, 0, 0,
                 1, 0, 0, 0, 0, 1);
      text_.line(slaves.size());
      for (std::size_t i = 0; i < slaves.size(); ++i) text_.line(slaves[i], masters[i]);
    }
    text_.line("$EndPeriodic");
  }

  const CompositeMesh& mesh_;
  const Box& block_;
  const std::array<int, 2>& cells_;
  const std::array<bool, 2>& periodic_;
  Text text_;
};

}  // namespace

void write_grid_msh(const CompositeMesh& mesh, const Box& block, const std::array<int, 2>& cells,
                    const std::array<bool, 2>& periodic, const std::string& path) {
  GridFile(mesh, block, cells, periodic, path).write();
}

}  // namespace slipscale
