#include "scenes/images/png_file.h"

#include <png.h>

#include <cerrno>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <optional>
#include <utility>

#include "scenes/base/input_error.h"
#include "scenes/base/text_numbers.h"

namespace photonproof::inline scenes_images {
namespace {

/// A file, libpng's structures for it, and libpng's messages. libpng reports errors by a jump, which must not skip a
/// destructor: functions that `attempt` calls have none.
class PngStream {
 public:
  enum class Use { reading, writing };

  /// file() is null where it cannot be opened; errno has the reason.
  PngStream(const std::string& path, Use use)
      : use_(use), file_(std::fopen(path.c_str(), use == Use::reading ? "rb" : "wb")) {
    const auto create = use == Use::reading ? png_create_read_struct : png_create_write_struct;
    png_ = create(PNG_LIBPNG_VER_STRING, this, complain, ignore);
    info_ = png_create_info_struct(png_);
  }
  ~PngStream() {
    if (use_ == Use::reading)
      png_destroy_read_struct(&png_, &info_, nullptr);
    else
      png_destroy_write_struct(&png_, &info_);
    if (file_) std::fclose(file_);
  }
  PngStream(const PngStream&) = delete;
  PngStream& operator=(const PngStream&) = delete;

  std::FILE* file() const { return file_; }
  png_structp png() const { return png_; }
  png_infop info() const { return info_; }
  bool close() { return std::fclose(std::exchange(file_, nullptr)) == 0; }
  const char* message() const { return message_; }

  /// False when libpng complains.
  template <class Action>
  bool attempt(const Action& action) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    action();
    return true;
  }

 private:
  static void complain(png_structp png, png_const_charp message) {
    auto* const stream = static_cast<PngStream*>(png_get_error_ptr(png));
    std::snprintf(stream->message_, sizeof stream->message_, "%s", message);
    png_longjmp(png, 1);
  }
  static void ignore(png_structp, png_const_charp) {}

  Use use_;
  std::FILE* file_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  char message_[200] = "";
};

constexpr double srgb_exponent = 2.2;  // of the power nearest to sRGB, by which gAMA chunks stand for it

class PngReader : public ImageFile {
 public:
  explicit PngReader(const std::string& path) : path_(path) { begin(); }

  const ImageHeader& header() const override { return header_; }

  void read(int begin_row, int end, int first, int count, float* values) override {
    if (begin_row < next_) begin();
    const bool bytes = header_.samples == ImageHeader::Samples::bytes;
    const std::size_t channels = header_.channels.size(), width = static_cast<std::size_t>(header_.width);
    for (int y = next_; y < end; ++y) {
      const png_byte* row = next_row();
      if (y < begin_row) continue;
      for (std::size_t x = 0; x < width; ++x)
        for (int c = first; c < first + count; ++c) {
          const std::size_t i = x * channels + static_cast<std::size_t>(c);
          // 16 bits come with the more significant byte first.
          *values++ =
              bytes ? static_cast<float>(row[i]) / 255 : static_cast<float>(256 * row[2 * i] + row[2 * i + 1]) / 65535;
        }
    }
  }

 private:
  void begin() {
    stream_.emplace(path_, PngStream::Use::reading);
    if (!stream_->file()) throw InputError(path_, std::string("cannot be read: ") + std::strerror(errno));
    const png_structp png = stream_->png();
    const png_infop info = stream_->info();
    const bool good = stream_->attempt([=, this] {
      png_init_io(png, stream_->file());
      png_set_crc_action(png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
      png_read_info(png, info);
      png_set_expand(png);
      png_set_strip_alpha(png);
      interlaced_ = png_set_interlace_handling(png) > 1;
      png_read_update_info(png, info);
    });
    if (!good) fail();
    header_.width = static_cast<int>(png_get_image_width(png, info));
    header_.height = static_cast<int>(png_get_image_height(png, info));
    header_.display_width = header_.width;
    header_.display_height = header_.height;
    header_.samples = png_get_bit_depth(png, info) == 16 ? ImageHeader::Samples::words : ImageHeader::Samples::bytes;
    header_.channels =
        png_get_channels(png, info) == 3 ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{"Y"};
    header_.remarks.clear();
    if (double gamma = 0; png_get_valid(png, info, PNG_INFO_sRGB) == 0 && png_get_gAMA(png, info, &gamma) != 0)
      if (std::abs(gamma * srgb_exponent - 1) > 0.05)
        header_.remarks.push_back("its gAMA chunk of " + format_number(gamma) + " is not used");
    next_ = 0;
    row_.resize(png_get_rowbytes(png, info));
    if (interlaced_) read_interlaced();
  }

  /// The rows of an interlaced file come out last.
  void read_interlaced() {
    rows_.resize(row_.size() * static_cast<std::size_t>(header_.height));
    std::vector<png_bytep> starts;
    for (std::size_t y = 0; y < static_cast<std::size_t>(header_.height); ++y)
      starts.push_back(rows_.data() + y * row_.size());
    const bool good = stream_->attempt([this, all = starts.data()] {
      png_read_image(stream_->png(), all);
      png_read_end(stream_->png(), nullptr);
    });
    if (!good) fail();
  }

  const png_byte* next_row() {
    const int y = next_++;
    if (interlaced_) return rows_.data() + static_cast<std::size_t>(y) * row_.size();
    const bool good = stream_->attempt([this] {
      png_read_row(stream_->png(), row_.data(), nullptr);
      if (next_ == header_.height) png_read_end(stream_->png(), nullptr);
    });
    if (!good) fail();
    return row_.data();
  }

  [[noreturn]] void fail() const {
    const char* reason = std::feof(stream_->file()) ? "it ends before its last chunk" : stream_->message();
    throw InputError(path_, std::string("cannot be read, truncated or damaged: ") + reason);
  }

  std::string path_;
  std::optional<PngStream> stream_;
  ImageHeader header_;
  bool interlaced_ = false;
  int next_ = 0;
  std::vector<png_byte> row_, rows_;
};

class PngWriter : public ByteImageWriter {
 public:
  PngWriter(const std::string& path, const std::string& target, int width, int height)
      : target_(target), stream_(path, PngStream::Use::writing), row_(3 * static_cast<std::size_t>(width)) {
    if (!stream_.file()) fail(std::strerror(errno));
    attempt([=](png_structp png, png_infop info, std::FILE* file) {
      png_init_io(png, file);
      png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), 8, PNG_COLOR_TYPE_RGB,
                   PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
      png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_RELATIVE);
      // For large images the best compression takes longer than the rendering that they show.
      if (std::int64_t{width} * height > (1 << 20)) png_set_compression_level(png, 1);
      png_write_info(png, info);
    });
  }

  void add(int rows, const std::uint8_t* rgb) override {
    attempt([=, this](png_structp png, png_infop, std::FILE*) {
      for (int y = 0; y < rows; ++y) png_write_row(png, rgb + static_cast<std::size_t>(y) * row_);
    });
  }

  void close() override {
    attempt([](png_structp png, png_infop, std::FILE*) { png_write_end(png, nullptr); });
    if (!stream_.close()) fail(std::strerror(errno));
  }

 private:
  template <class Action>
  void attempt(const Action& action) {
    errno = 0;
    if (!stream_.attempt([&] { action(stream_.png(), stream_.info(), stream_.file()); }))
      fail(errno != 0 ? std::strerror(errno) : stream_.message());
  }
  [[noreturn]] void fail(const std::string& reason) const { throw InputError(target_, "cannot be written: " + reason); }

  std::string target_;
  PngStream stream_;
  std::size_t row_;  // bytes
};

}  // namespace

bool is_png(const std::string& path) {
  constexpr std::size_t size = 8;
  char signature[size] = {};
  std::ifstream(path, std::ios::binary).read(signature, size);
  return png_sig_cmp(reinterpret_cast<png_const_bytep>(signature), 0, size) == 0;
}

std::unique_ptr<ImageFile> open_png(const std::string& path) { return std::make_unique<PngReader>(path); }

std::unique_ptr<ByteImageWriter> create_png(const std::string& path, const std::string& target, int width, int height) {
  return std::make_unique<PngWriter>(path, target, width, height);
}

}  // namespace photonproof::inline scenes_images
