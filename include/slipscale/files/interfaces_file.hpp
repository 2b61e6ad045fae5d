#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "slipscale/files/interface_choice.hpp"
#include "slipscale/files/series_file.hpp"

namespace slipscale {

/// The highest of something along interfaces: where and when.
struct InterfacePeak {
  double value = 0;
  int row = -1;     ///< of Inclusions::interface; −1: never above 0
  double time = 0;  ///< s
};

/// Peaks at one inclusion over the rows so far: tension, size of the shear traction (Pa), debonding index;
/// and the first row in which the index reached 1.
struct InclusionPeaks {
  InterfacePeak normal, shear, index;
  InterfacePeak debonds;  ///< `value` is the index then
};

/// interfaces.h5: tractions along the interfaces of inclusions over time. Lives on rank 0.
///
/// Fixed: /x, /y [ni] m, /inclusion [ni] (from 0), /normal [ni, 2], /length [ni] m, /angle [ni] rad, /outer
/// [ni] 1 where the node is also on the outer boundary; /inclusions/centre [k, 2] m, /inclusions/area [k] m².
/// One row a time: /time; /normal_traction and /shear_traction [ni] Pa, /index [ni] where strengths are
/// known; /inclusions/force [k, 2] N/m, the sum over the interface; /inclusions/highest_normal,
/// highest_shear, highest_index [k] and their nodes, /inclusions/at_normal … [k]. Nodes that are `outer` have
/// no peak: their force holds what acts from outside. A second recovery beside the first has the same
/// datasets below its name.
class InterfacesFile {
 public:
  /// `variants`: names of the recoveries; the first is "" and stands at the root. `rows` that are expected.
  InterfacesFile(const std::string& path, const Inclusions& inclusions, const InterfaceChoice& choice,
                 std::vector<std::string> variants, double rows,
                 std::optional<SeriesFile::Continue> continued = {});

  /// A row: forces on the inclusions at the nodes, [variants][interface], N/m.
  void write(double time, const std::vector<std::vector<Vector2>>& forces);
  /// Of a continued file: the peaks of the rows that count. A fault or a refusal of the series when they
  /// cannot be read.
  void recall();
  SeriesFile& series() { return file_; }
  /// [variants][inclusions], over all rows so far.
  const std::vector<std::vector<InclusionPeaks>>& peaks() const { return peaks_; }

  /// The text of interfaces.yaml.
  std::string report() const;
  /// One line on what debonds first, or comes nearest to it, or is pulled hardest; of the first recovery.
  /// Ends with the number of rows where they are few, for what happens between rows is not seen.
  std::string headline() const;
  /// The text of interfaces.xdmf: the nodes as points, with the tractions at every row, of more than ten
  /// thousand at every second, third … `name`: of the HDF5 file.
  std::string xdmf(const std::string& name);

 private:
  struct Columns {
    int normal, shear, index = -1, force;
    std::array<int, 3> highest{-1, -1, -1}, at{-1, -1, -1};  ///< normal, shear, index
  };
  Columns add_columns(const std::string& variant);
  void write_variant(std::size_t v, const std::vector<Vector2>& force);
  void merge(std::size_t v, double time, const std::array<std::vector<double>, 3>& highest,
             const std::array<std::vector<double>, 3>& at);
  std::string place_of(const InterfacePeak& peak) const;
  std::string finding() const;

  SeriesFile file_;
  const Inclusions inclusions_;
  const InterfaceChoice choice_;
  const std::vector<std::string> variants_;
  int time_;
  std::vector<Columns> columns_;
  std::vector<std::vector<InclusionPeaks>> peaks_;
  std::array<std::vector<double>, 3> values_, highest_, at_;  ///< of the row that is written
  std::vector<double> force_;
  double now_ = 0;  ///< time of that row, s
};

}  // namespace slipscale
