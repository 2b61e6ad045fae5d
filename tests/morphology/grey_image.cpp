#include <gtest/gtest.h>
#include <png.h>

#include <array>
#include <cstdio>
#include <fstream>

#include "scenes.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/morphology/grey_image.hpp"

using namespace slipscale;
using testing_support::scratch;

namespace {

struct Png {
  int colour = PNG_COLOR_TYPE_GRAY, bits = 8, columns = 1;
  std::vector<png_byte> row;  ///< one, as stored
  double gamma = 0;           ///< of the gAMA chunk; none when zero
  std::vector<png_color> palette = {};
};

std::string written(const Png& picture) {
  const std::string path = scratch("levels.png");
  std::FILE* file = std::fopen(path.c_str(), "wb");
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_set_IHDR(png, info, static_cast<png_uint_32>(picture.columns), 1, picture.bits, picture.colour,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (picture.gamma > 0) png_set_gAMA(png, info, picture.gamma);
  if (!picture.palette.empty())
    png_set_PLTE(png, info, picture.palette.data(), static_cast<int>(picture.palette.size()));
  png_write_info(png, info);
  png_write_row(png, picture.row.data());
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  std::fclose(file);
  return path;
}

void expect_grey(const Png& picture, const std::vector<double>& expected) {
  const GreyPicture read = read_grey(written(picture));
  ASSERT_EQ(read.grey.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(read.grey[k], expected[k], 1e-15) << k;
}

std::string refusal(const std::string& path) {
  try {
    read_grey(path);
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

std::string header_only(std::uint32_t columns, std::uint32_t rows) {
  const std::string path = scratch("header.png");
  std::ofstream file(path, std::ios::binary);
  std::string chunk = "IHDR";
  for (const std::uint32_t size : {columns, rows})
    for (int shift = 24; shift >= 0; shift -= 8) chunk += static_cast<char>(size >> shift & 255);
  chunk += std::string("\x08\0\0\0\0", 5);
  std::uint32_t crc = 0xffffffff;
  for (const char c : chunk) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
  }
  crc ^= 0xffffffff;
  file << "\x89PNG\r\n\x1a\n" << std::string("\0\0\0\r", 4) << chunk;
  for (int shift = 24; shift >= 0; shift -= 8) file << static_cast<char>(crc >> shift & 255);
  file << std::string("\0\0\0\0", 4) << "IDAT";
  return path;
}

}  // namespace

/// The value in the file over its largest one, whatever gamma the file states.
TEST(GreyImage, HasTheLevelsOfTheFile) {
  for (const double gamma : {0.0, 1.0, 0.45455}) {
    expect_grey({PNG_COLOR_TYPE_GRAY, 1, 3, {0b10100000}, gamma}, {1, 0, 1});
    expect_grey({PNG_COLOR_TYPE_GRAY, 2, 4, {0b00011011}, gamma}, {0, 1. / 3, 2. / 3, 1});
    expect_grey({PNG_COLOR_TYPE_GRAY, 4, 2, {0x3a}, gamma}, {3. / 15, 10. / 15});
    expect_grey({PNG_COLOR_TYPE_GRAY, 8, 2, {26, 179}, gamma}, {26. / 255, 179. / 255});
    expect_grey({PNG_COLOR_TYPE_GRAY, 16, 2, {0x19, 0x9a, 0xb3, 0x33}, gamma},
                {6554. / 65535, 45875. / 65535});
  }
}

/// ITU-R BT.601: .299 R + .587 G + .114 B.
TEST(GreyImage, TakesTheLumaOfColours) {
  const std::vector<double> luma{0.299, 0.587, 0.114, 100. / 255};
  expect_grey({PNG_COLOR_TYPE_RGB, 8, 4, {255, 0, 0, 0, 255, 0, 0, 0, 255, 100, 100, 100}}, luma);
  expect_grey({PNG_COLOR_TYPE_PALETTE,
               2,
               4,
               {0b00011011},
               0,
               {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {100, 100, 100}}},
              luma);
  expect_grey({PNG_COLOR_TYPE_RGB, 16, 1, {0xff, 0xff, 0, 0, 0, 0}}, {0.299});
  EXPECT_TRUE(read_grey(written({PNG_COLOR_TYPE_RGB, 8, 1, {1, 2, 3}})).coloured);
  EXPECT_FALSE(read_grey(written({PNG_COLOR_TYPE_GRAY, 8, 1, {1}})).coloured);
}

TEST(GreyImage, RefusesTransparentPixels) {
  expect_grey({PNG_COLOR_TYPE_GRAY_ALPHA, 8, 2, {51, 255, 204, 255}}, {0.2, 0.8});
  const std::string said = refusal(written({PNG_COLOR_TYPE_GRAY_ALPHA, 8, 2, {51, 255, 204, 254}}));
  EXPECT_NE(said.find("has 1 transparent pixels, which have no grey level"), std::string::npos) << said;
}

/// Before memory is taken: the files hold nothing but their headers.
TEST(GreyImage, RefusesHugePictures) {
  const std::string path = scratch("huge.pgm");
  std::ofstream(path) << "P5\n31622 31622\n255\n";
  EXPECT_NE(refusal(path).find("31622 x 31622 pixels, more than the 1e+08"), std::string::npos)
      << refusal(path);
  const std::string said = refusal(header_only(30000, 30000));
  EXPECT_NE(said.find("30000 x 30000 pixels, more than the 1e+08"), std::string::npos) << said;
  std::ofstream(path) << "P5\n9000 9000\n255\n";
  EXPECT_NE(refusal(path).find("ends early"), std::string::npos) << refusal(path);
}

/// Of 3 x 3 pixels: a lone bright pixel has eight dark neighbours and goes, in a corner of the picture and
/// at its sides too; a straight edge stays, and so does a half plane across a seam.
TEST(Median, TakesLonePixelsAndKeepsEdges) {
  GreyPicture picture{6, 5, std::vector<double>(30, 0.1)};
  for (int row = 0; row < 5; ++row)
    for (int column = 3; column < 6; ++column) picture.grey[6 * row + column] = 0.8;
  const std::vector<double> drawn = picture.grey;
  for (const int speck : {0, 6 * 2, 6 * 4}) picture.grey[speck] = 1;
  picture.grey[6 * 2 + 4] = 0;
  median_filter(picture, {false, false}, 1);
  EXPECT_EQ(picture.grey, drawn);
  median_filter(picture, {true, true}, 1);
  EXPECT_EQ(picture.grey, drawn);
  median_filter(picture, {false, false}, 0);
  EXPECT_EQ(picture.grey, drawn);
}

/// At a seam the neighbours stand on the other side of the picture: one bright column of six has two thirds
/// of its neighbours dark, and goes; mirrored at the side it has two thirds of them bright, and stays.
TEST(Median, LooksAcrossPeriodicSides) {
  GreyPicture picture{6, 3, std::vector<double>(18, 0)};
  for (int row = 0; row < 3; ++row) picture.grey[6 * row] = 1;
  const std::vector<double> drawn = picture.grey;
  median_filter(picture, {false, false}, 1);
  EXPECT_EQ(picture.grey, drawn);
  median_filter(picture, {true, false}, 1);
  EXPECT_EQ(picture.grey, std::vector<double>(18, 0));
}

/// Islands by their sides: of 2 pixels one at the seam, of 1 pixel one beside it, and one of 4 that stays.
TEST(Despeckle, GivesSmallIslandsToTheirSurroundings) {
  const std::vector<int> drawn{0, 0, 0, 0, 0, 0,  //
                               1, 0, 0, 1, 1, 1,  //
                               0, 0, 0, 1, 1, 0,  //
                               0, 0, 2, 0, 0, 0};
  std::vector<int> regions = drawn;
  EXPECT_EQ(despeckle(regions, 6, 4, {true, false}, 6), 1);  // six pixels across the seam, and the lone 2
  std::vector<int> expected = drawn;
  expected[20] = 0;
  EXPECT_EQ(regions, expected);
  regions = drawn;
  EXPECT_EQ(despeckle(regions, 6, 4, {false, false}, 6), 7);
  EXPECT_EQ(regions, std::vector<int>(24, 0));
  regions = drawn;
  EXPECT_EQ(despeckle(regions, 6, 4, {true, true}, 0), 0);
}
