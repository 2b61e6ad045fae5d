#include "slipscale/morphology/grey_image.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "png_file.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw UserError("-image_file '" + path + "' " + why + "; give a PNG or PGM picture");
}

void refuse_too_large(const std::string& path, double columns, double rows) {
  if (columns * rows > most_pixels)
    throw UserError("-image_file '" + path +
                    format("' has {:.0f} x {:.0f} pixels, more than the {:.0e} that are "
                           "meshed; cut out a part, or scale it down",
                           columns, rows, most_pixels));
}

GreyPicture grey_of(const std::string& path, const PngPixels& pixels) {
  const bool coloured = pixels.channels > 2, alpha = pixels.channels % 2 == 0, wide = pixels.bits == 16;
  const double white = wide ? 65535 : 255;
  const std::size_t count = static_cast<std::size_t>(pixels.columns) * pixels.rows;
  GreyPicture picture{pixels.columns, pixels.rows, std::vector<double>(count), coloured};
  std::size_t transparent = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const auto sample = [&](int channel) -> double {
      const std::size_t at =
          k * static_cast<std::size_t>(pixels.channels) + static_cast<std::size_t>(channel);
      return wide ? pixels.bytes[2 * at] * 256 + pixels.bytes[2 * at + 1] : pixels.bytes[at];
    };
    transparent += alpha && sample(pixels.channels - 1) < white;
    // Thousandths, so that equal channels give their own value.
    picture.grey[k] =
        coloured ? (299 * sample(0) + 587 * sample(1) + 114 * sample(2)) / (1000 * white) : sample(0) / white;
  }
  if (transparent > 0)
    throw UserError("-image_file '" + path +
                    format("' has {} transparent pixels, which have no grey level; fill "
                           "them, for example by convert {} -background black -flatten "
                           "filled.png",
                           transparent, path));
  return picture;
}

GreyPicture read_png(const std::string& path) {
  PngPixels pixels;
  try {
    pixels = read_png_pixels(path, most_pixels);
  } catch (const std::runtime_error& error) {
    refuse(path, std::string("cannot be read: ") + error.what());
  }
  refuse_too_large(path, pixels.columns, pixels.rows);
  return grey_of(path, pixels);
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
  if (!file || picture.columns < 1 || picture.rows < 1 || white < 1 || white > 65535)
    refuse(path, "has a header that makes no sense");
  refuse_too_large(path, picture.columns, picture.rows);
  file.get();
  // Seen before memory is taken: a plain sample is a digit and a blank at least.
  const double smallest =
      static_cast<double>(picture.columns) * picture.rows * (raw && white < 256 ? 1 : 2) - !raw;
  std::error_code code;
  if (static_cast<double>(std::filesystem::file_size(path, code)) - static_cast<double>(file.tellg()) <
      smallest)
    refuse(path, "ends early or holds a value beyond its white");
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

}  // namespace slipscale
