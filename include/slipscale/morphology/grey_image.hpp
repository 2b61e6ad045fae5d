#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "slipscale/morphology/recipe.hpp"

namespace slipscale {

/// Grey levels of a picture, 0 black to 1 white, [rows][columns] from the top as stored.
struct GreyPicture {
  int columns = 0, rows = 0;
  std::vector<double> grey;
};

/// Reads a PNG (colours are turned to grey, transparency over white) or a PGM (plain or raw, 8 or 16 bit).
/// Throws UserError.
GreyPicture read_grey(const std::string& path);

/// Region of every pixel, row by row from the bottom.
std::vector<int> regions_of(const GreyPicture& picture, const GreyImage& image);

/// Writes a picture of 8-bit red, green, blue [rows][columns][3], from the top. Throws LibraryError.
void write_png(const std::string& path, int columns, int rows, const std::vector<std::uint8_t>& rgb);

}  // namespace slipscale
