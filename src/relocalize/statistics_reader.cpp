#include "slipscale/relocalize/statistics_reader.hpp"

#include <filesystem>

#include "slipscale/base/parallel.hpp"
#include "slipscale/files/grid_file.hpp"

namespace slipscale {

StatisticsReader::StatisticsReader(MPI_Comm comm, const std::string& path, const std::string& option)
    : file_(std::make_unique<GridFile>(
          comm,
          GridFileSource{path, "statistics.h5", option, "run slide with -statistics_from for that folder"})) {
  file_->refuse_unless(file_->has("/statistics"), "has no /statistics, so it is not a statistics.h5");
  grid_ = file_->grid();
  file_->together([&] {
    from_ = file_->number("/statistics", "from");
    to_ = file_->number("/statistics", "to");
    samples_ = file_->number("/statistics", "samples");
    quantile_ = file_->number("/statistics", "quantile");
  });
}

StatisticsReader::~StatisticsReader() = default;
StatisticsReader::StatisticsReader(StatisticsReader&&) noexcept = default;

const std::string& StatisticsReader::path() const { return file_->path(); }

template <std::size_t N>
void StatisticsReader::read_rows(const std::string& quantity, const std::string& statistic,
                                 std::span<std::array<double, N>> rows, std::size_t begin) const {
  const std::string dataset = "/statistics/" + quantity + "/" + statistic;
  file_->refuse_unless(file_->has(dataset), "has no " + dataset);
  file_->together([&] {
    file_->read_rows(dataset, static_cast<hsize_t>(grid_.cells()), N, begin, rows.size(),
                     rows.empty() ? nullptr : rows.front().data());
  });
}

void StatisticsReader::read(const std::string& quantity, const std::string& statistic,
                            std::span<std::array<double, 3>> rows, std::size_t begin) const {
  read_rows(quantity, statistic, rows, begin);
}

void StatisticsReader::read_covariance(const std::string& quantity, std::span<std::array<double, 6>> rows,
                                       std::size_t begin) const {
  read_rows(quantity, "covariance", rows, begin);
}

bool has_statistics(MPI_Comm comm, const std::string& folder) {
  int found = 0;
  std::error_code ignored;
  namespace fs = std::filesystem;
  if (is_root(comm)) found = fs::exists(fs::path(folder) / "statistics.h5", ignored);
  MPI_Bcast(&found, 1, MPI_INT, 0, comm);
  return found != 0;
}

}  // namespace slipscale
