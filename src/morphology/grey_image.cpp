#include "slipscale/morphology/grey_image.hpp"

#include <png.h>

#include <algorithm>
#include <cstring>
#include <fstream>

#include "slipscale/base/error.hpp"

namespace slipscale {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw UserError("-image_file '" + path + "' " + why + "; give a PNG or PGM picture");
}

GreyPicture read_png(const std::string& path) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_file(&image, path.c_str()))
    refuse(path, std::string("cannot be read: ") + image.message);
  // 16-bit values are linear in light; grey levels of a micrograph are those of the file.
  image.format = PNG_FORMAT_GRAY;
  std::vector<png_byte> bytes(PNG_IMAGE_SIZE(image));
  const png_color white{255, 255, 255};
  if (!png_image_finish_read(&image, &white, bytes.data(), 0, nullptr))
    refuse(path, std::string("cannot be read: ") + image.message);
  GreyPicture picture{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  for (const png_byte byte : bytes) picture.grey.push_back(byte / 255.0);
  return picture;
}

/// The next number of a PGM header; comments run from # to the end of the line.
int header_number(std::istream& file) {
  while (file >> std::ws && file.peek() == '#') file.ignore(1 << 20, '\n');
  int number = 0;
  file >> number;
  return number;
}

GreyPicture read_pgm(const std::string& path, bool raw) {
  std::ifstream file(path, std::ios::binary);
  file.ignore(2);
  GreyPicture picture;
  picture.columns = header_number(file);
  picture.rows = header_number(file);
  const int white = header_number(file);
  if (!file || picture.columns < 1 || picture.rows < 1 || white < 1 || white > 65535 ||
      static_cast<double>(picture.columns) * picture.rows > 1e9)
    refuse(path, "has a header that makes no sense");
  file.get();
  picture.grey.resize(static_cast<std::size_t>(picture.columns) * picture.rows);
  for (double& grey : picture.grey) {
    int value = 0;
    if (!raw)
      file >> value;
    else if (white < 256)
      value = file.get();
    else {
      value = file.get() << 8;
      value |= file.get();
    }
    if (!file || value < 0 || value > white) refuse(path, "ends early or holds a value beyond its white");
    grey = static_cast<double>(value) / white;
  }
  return picture;
}

}  // namespace

GreyPicture read_grey(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  char start[2] = {0, 0};
  if (!file.read(start, 2)) refuse(path, "cannot be opened");
  if (start[0] == 'P' && (start[1] == '2' || start[1] == '5')) return read_pgm(path, start[1] == '5');
  return read_png(path);
}

std::vector<int> regions_of(const GreyPicture& picture, const GreyImage& image) {
  std::vector<int> regions;
  for (int row = picture.rows - 1; row >= 0; --row)
    for (int column = 0; column < picture.columns; ++column) {
      const double grey = picture.grey[static_cast<std::size_t>(row) * picture.columns + column];
      regions.push_back(
          static_cast<int>(std::ranges::upper_bound(image.levels, grey) - image.levels.begin()));
    }
  return regions;
}

void write_png(const std::string& path, int columns, int rows, const std::vector<std::uint8_t>& rgb) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(columns);
  image.height = static_cast<png_uint_32>(rows);
  image.format = PNG_FORMAT_RGB;
  if (!png_image_write_to_file(&image, path.c_str(), 0, rgb.data(), 0, nullptr))
    throw LibraryError("libpng cannot write '" + path + "': " + image.message);
}

}  // namespace slipscale
