#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace slipscale {

/// A PNG as it is stored, palettes expanded and fewer than 8 bits spread to 8.
struct PngPixels {
  int columns = 0, rows = 0;
  int channels = 0;                 ///< grey, grey alpha, RGB, RGB alpha
  int bits = 0;                     ///< 8, or 16 with the high byte first
  std::vector<std::uint8_t> bytes;  ///< [rows][columns][channels][bits / 8]; empty beyond `most` pixels
};

/// Throws std::runtime_error with libpng's words.
PngPixels read_png_pixels(const std::string& path, double most);

}  // namespace slipscale
