#include "nodal_table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <string_view>

#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

/// Columns of the table, and where their numbers go.
enum Column { x, y, ux, uy, vx, vy, columns };
const std::map<std::string, Column> names{{"x", x},   {"y", y},  {"ux", ux}, {"u", ux},
                                          {"uy", uy}, {"v", uy}, {"vx", vx}, {"vy", vy}};
const char* const wanted = "columns named x, y and any of ux (or u), uy (or v), vx, vy, separated by commas";

using Row = std::array<double, columns>;

std::vector<std::string> items_of(const std::string& line) {
  std::vector<std::string> items(1);
  for (const char c : line) {
    if (c == ',')
      items.emplace_back();
    else if (c != ' ' && c != '\t' && c != '\r' && c != '"')
      items.back() += c;
  }
  return items;
}

std::vector<Column> head_of(const std::string& where, const std::string& line) {
  std::vector<Column> order;
  for (const std::string& item : items_of(line)) {
    const auto found = names.find(item);
    if (found == names.end())
      throw UserError(where + " has a column '" + item + "' in its first line; it needs " + wanted);
    if (std::ranges::find(order, found->second) != order.end())
      throw UserError(where + " names column '" + item + "' twice; it needs " + wanted);
    order.push_back(found->second);
  }
  for (const auto& [column, name] : {std::pair{x, "x"}, std::pair{y, "y"}})
    if (std::ranges::find(order, column) == order.end())
      throw UserError(where + " has no column '" + name + "'; it needs " + wanted);
  if (order.size() == 2) throw UserError(where + " has nothing but places; it needs " + wanted);
  return order;
}

std::vector<Row> rows_of(const std::string& where, const std::string& text) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";  // of UTF-8, which spreadsheets put first
  std::istringstream lines(text.starts_with(mark) ? text.substr(mark.size()) : text);
  std::string line;
  std::vector<Column> order;
  std::vector<Row> rows;
  for (long number = 1; std::getline(lines, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos || line.starts_with('#')) continue;
    if (order.empty()) {
      order = head_of(where, line);
      continue;
    }
    const auto items = items_of(line);
    if (items.size() != order.size())
      throw UserError(
          format("{}, line {}: {} numbers in {} columns", where, number, items.size(), order.size()) +
          "; give every point one in each");
    Row& row = rows.emplace_back();
    row.fill(0);
    for (std::size_t k = 0; k < items.size(); ++k) {
      const char *begin = items[k].data(), *end = begin + items[k].size();
      double& value = row[order[k]];
      const auto [stop, fault] = std::from_chars(begin, end, value);
      if (fault != std::errc() || stop != end || !(std::abs(value) < 1e100))
        throw UserError(format("{}, line {}: '{}' is no number below 1e100; write one as 1.5e-6", where,
                               number, items[k]));
    }
  }
  if (rows.empty()) throw UserError(where + " holds no points; it needs " + wanted + ", and a line a point");
  return rows;
}

/// The different values of a column, ascending; what differs by rounding is one.
std::vector<double> levels(const std::vector<Row>& rows, Column column) {
  std::vector<double> all;
  for (const Row& row : rows) all.push_back(row[column]);
  std::ranges::sort(all);
  const double rounding = 1e-9 * (all.back() - all.front());
  std::vector<double> found{all.front()};
  for (const double value : all)
    if (value > found.back() + rounding) found.push_back(value);
  return found;
}

int place_in(const std::vector<double>& levels, double value) {
  const auto above = std::ranges::upper_bound(levels, value);
  const auto below = static_cast<int>(above - levels.begin()) - 1;
  const auto last = static_cast<int>(levels.size()) - 1;
  if (below < 0) return 0;
  return below < last && levels[below + 1] - value < value - levels[below] ? below + 1 : below;
}

}  // namespace

NodalSource nodal_table(const std::string& where, const std::string& text) {
  const std::vector<Row> rows = rows_of(where, text);
  const auto across = levels(rows, x), up = levels(rows, y);
  const auto width = static_cast<int>(across.size()), height = static_cast<int>(up.size());
  const std::string cure =
      "; a table is interpolated between the points of a grid, every x with every y (two of each at least); "
      "give such points, or the fields.h5 of a run";
  if (width < 2 || height < 2)
    throw UserError(format("{} has {} different x and {} different y", where, width, height) + cure);
  NodalSource source;
  const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (rows.size() != count)
    throw UserError(
        format("{} has {} points, but {} different x and {} different y", where, rows.size(), width, height) +
        cure);
  source.displacement.resize(count);
  source.velocity.resize(count);
  std::vector<char> there(count, 0);
  for (const Row& row : rows) {
    const auto at = static_cast<std::size_t>(place_in(up, row[y]) * width + place_in(across, row[x]));
    if (there[at])
      throw UserError(format("{} has two points at x = {:g} m, y = {:g} m", where, row[x], row[y]) + cure);
    there[at] = 1;
    source.displacement[at] = {row[ux], row[uy]};
    source.velocity[at] = {row[vx], row[vy]};
  }
  PlaneGrid& grid = source.grid;
  grid.regions = {"table"};
  for (const double level : up)
    for (const double place : across) grid.points.push_back({place, level});
  for (int row = 0; row + 1 < height; ++row)
    for (int column = 0; column + 1 < width; ++column) {
      const int first = row * width + column;
      for (const int corner : {first, first + 1, first + 1 + width, first + width})
        grid.corners.push_back(corner);
      grid.first.push_back(static_cast<int>(grid.corners.size()));
      grid.region.push_back(0);
    }
  source.description = format("{} x {} points", width, height);
  return source;
}

}  // namespace slipscale
