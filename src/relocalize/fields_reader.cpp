#include "slipscale/relocalize/fields_reader.hpp"

#include <filesystem>

#include "slipscale/base/print.hpp"
#include "slipscale/files/grid_file.hpp"

namespace slipscale {
namespace {

std::string dataset(std::size_t frame, const std::string& quantity) {
  return format("/frames/{:05}/{}", frame, quantity);
}

}  // namespace

FieldsReader::FieldsReader(MPI_Comm comm, const std::string& path, const std::string& option)
    : file_(std::make_unique<GridFile>(
          comm, GridFileSource{path, "fields.h5", option,
                               "run slide with -fields_every or -fields_times for that folder"})) {
  file_->refuse_unless(file_->has("/time"), "has no /time, so it is not a fields.h5");
  grid_ = file_->grid();
  block_ = bounding_box(grid_);
  if (file_->has("/mesh/block"))
    file_->together([&] {
      std::array<Vector2, 2> box{};
      file_->read_rows("/mesh/block", 2, 2, 0, 2, box.front().data());
      block_ = {box[0], box[1]};
    });
  file_->together([&] { times_ = file_->reals("/time"); });
  file_->refuse_unless(!times_.empty(), "has no frames yet");
}

FieldsReader::~FieldsReader() = default;
FieldsReader::FieldsReader(FieldsReader&&) noexcept = default;

const std::string& FieldsReader::path() const { return file_->path(); }

std::string FieldsReader::folder() const {
  return std::filesystem::absolute(file_->path()).parent_path().string();
}

bool FieldsReader::has(const std::string& quantity) const {
  for (std::size_t frame = 0; frame < times_.size(); ++frame)
    if (!file_->has(dataset(frame, quantity))) return false;
  return true;
}

void FieldsReader::require(const std::string& quantity) const {
  file_->refuse_unless(has(quantity), "has no " + quantity,
                       "run slide with " + quantity + " among -fields_quantities");
}

void FieldsReader::read(std::size_t frame, const std::string& quantity, std::span<std::array<double, 3>> rows,
                        std::size_t begin) const {
  file_->together([&] {
    file_->read_rows(dataset(frame, quantity), static_cast<hsize_t>(grid_.cells()), 3, begin, rows.size(),
                     rows.empty() ? nullptr : rows.front().data());
  });
}

}  // namespace slipscale
