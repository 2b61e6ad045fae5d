#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "slipscale/morphology/recipe.hpp"

namespace slipscale {

constexpr double most_pixels = 1e8;  ///< of a picture that is read

/// Grey levels of a picture, 0 black to 1 white, [rows][columns] from the top as stored.
struct GreyPicture {
  int columns = 0, rows = 0;
  std::vector<double> grey;
  bool coloured = false;  ///< the file holds colours, palette or not
};

/// Reads a PNG (1 to 16 bits, palette or not) or a PGM (plain or raw, 8 or 16 bit). Grey levels are those of
/// the file over its white, colours give their luma .299 R + .587 G + .114 B; neither gamma nor a colour
/// profile is applied. Throws UserError, for pixels that are transparent and for more than `most_pixels` too.
GreyPicture read_grey(const std::string& path);

/// Each grey level becomes the median of those in the square of 2·`reach` + 1 pixels around it, continued
/// across periodic axes and mirrored at the other sides: single odd pixels go, straight edges stay.
void median_filter(GreyPicture& picture, const std::array<bool, 2>& periodic, int reach);

/// Gives islands of fewer than `smallest` pixels that touch by their sides to the region that has the most
/// sides along them, the smallest islands first, across periodic sides as well. Returns the number of pixels
/// that changed.
long despeckle(std::vector<int>& regions, int columns, int rows, const std::array<bool, 2>& periodic,
               long smallest);

/// Region of every pixel, row by row from the bottom.
std::vector<int> regions_of(const GreyPicture& picture, const GreyImage& image);

/// Writes a picture of 8-bit red, green, blue [rows][columns][3], from the top. Throws UserError when the
/// file cannot be written.
void write_png(const std::string& path, int columns, int rows, const std::vector<std::uint8_t>& rgb);

}  // namespace slipscale
