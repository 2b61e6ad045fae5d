#include "png_file.hpp"

#include <png.h>

#include <csetjmp>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "msh_file.hpp"
#include "slipscale/morphology/grey_image.hpp"

namespace slipscale {
namespace {

/// libpng leaves a failure by a jump back into the reader's functions, which keep nothing on their stack that
/// is to be destroyed.
struct Failure {
  char message[200] = "";
};

[[noreturn]] void fail(png_structp png, png_const_charp message) {
  std::snprintf(static_cast<Failure*>(png_get_error_ptr(png))->message, sizeof Failure::message, "%s",
                message);
  png_longjmp(png, 1);
}
void ignore(png_structp, png_const_charp) {}

class Reader {
 public:
  explicit Reader(const std::string& path) : file_(std::fopen(path.c_str(), "rb"), std::fclose) {
    if (!file_) throw std::runtime_error("it cannot be opened");
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &failure_, fail, ignore);
    if (png_) info_ = png_create_info_struct(png_);
    if (!info_) throw std::runtime_error("no memory");
  }
  ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  void read_header(PngPixels& pixels) {
    if (setjmp(png_jmpbuf(png_))) throw std::runtime_error(failure_.message);
    png_init_io(png_, file_.get());
    png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_read_info(png_, info_);
    pixels.columns = static_cast<int>(png_get_image_width(png_, info_));
    pixels.rows = static_cast<int>(png_get_image_height(png_, info_));
  }

  /// Without any conversion of values: what the file holds, as one or two bytes a sample.
  void read_samples(PngPixels& pixels) {
    if (setjmp(png_jmpbuf(png_))) throw std::runtime_error(failure_.message);
    png_set_expand(png_);  // palettes to colours, a transparent colour to alpha, fewer than 8 bits to 8
    passes_ = png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    pixels.channels = png_get_channels(png_, info_);
    pixels.bits = png_get_bit_depth(png_, info_);
    row_ = png_get_rowbytes(png_, info_);
    pixels.bytes.resize(row_ * static_cast<std::size_t>(pixels.rows));
    for (pass_ = 0; pass_ < passes_; ++pass_)
      for (line_ = 0; line_ < pixels.rows; ++line_)
        png_read_row(png_, pixels.bytes.data() + row_ * static_cast<std::size_t>(line_), nullptr);
    png_read_end(png_, nullptr);
  }

 private:
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  Failure failure_;
  int passes_ = 0, pass_ = 0, line_ = 0;  ///< not on the stack, which a jump leaves undefined
  std::size_t row_ = 0;
};

}  // namespace

PngPixels read_png_pixels(const std::string& path, double most) {
  PngPixels pixels;
  Reader reader(path);
  reader.read_header(pixels);
  if (static_cast<double>(pixels.columns) * pixels.rows > most) return pixels;
  reader.read_samples(pixels);
  return pixels;
}

void write_png(const std::string& path, int columns, int rows, const std::vector<std::uint8_t>& rgb) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(columns);
  image.height = static_cast<png_uint_32>(rows);
  image.format = PNG_FORMAT_RGB;
  if (!png_image_write_to_file(&image, path.c_str(), 0, rgb.data(), 0, nullptr)) refuse_unwritten(path);
}

}  // namespace slipscale
