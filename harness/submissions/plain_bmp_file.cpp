#include "harness/submissions/plain_bmp_file.h"

#include <cstdint>
#include <cstdlib>
#include <limits>
#include <utility>

#include "scenes/base/input_error.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline harness_submissions {
namespace {

constexpr std::size_t file_header = 14, info_header = 40;

class PlainBmpFile : public ImageFile {
 public:
  PlainBmpFile(const std::string& path, std::string bytes) : path_(path), bytes_(std::move(bytes)) {
    const auto width = static_cast<std::int32_t>(number(18, 4)), height = static_cast<std::int32_t>(number(22, 4));
    if (width <= 0 || height == 0 || height == std::numeric_limits<std::int32_t>::min())
      throw InputError(path_, "is damaged: a size of " + std::to_string(width) + " x " + std::to_string(height));
    is_top_down_ = height < 0;
    header_.width = header_.display_width = width;
    header_.height = header_.display_height = std::abs(height);
    header_.channels = {"R", "G", "B"};
    header_.samples = ImageHeader::Samples::bytes;
    pixels_at_ = number(10, 4);
    row_bytes_ = (3 * static_cast<std::size_t>(width) + 3) / 4 * 4;
  }

  /// Whether a complete header is that of a plain BMP.
  static bool is_plain(const std::string& bytes) {
    const auto at = [&bytes](std::size_t place) { return static_cast<unsigned char>(bytes[place]); };
    constexpr std::size_t bits = 28, compression = 30;
    return bytes.size() >= file_header + info_header && at(file_header) >= info_header && at(bits) == 24 &&
           at(bits + 1) == 0 && at(compression) == 0;
  }

  const ImageHeader& header() const override { return header_; }

  void read(int begin, int end, int first, int count, float* values) override {
    // The last row's padding is often missing.
    const std::size_t row = 3 * static_cast<std::size_t>(header_.width);
    const std::size_t needed = pixels_at_ + (static_cast<std::size_t>(header_.height) - 1) * row_bytes_ + row;
    if (pixels_at_ < file_header + info_header || bytes_.size() < needed)
      throw InputError(path_, "is truncated: fewer pixels than its size says");
    for (int y = begin; y < end; ++y) {
      const int stored = is_top_down_ ? y : header_.height - 1 - y;
      const std::size_t start = pixels_at_ + static_cast<std::size_t>(stored) * row_bytes_;
      for (std::size_t x = 0; x < static_cast<std::size_t>(header_.width); ++x)
        for (int channel = first; channel < first + count; ++channel)  // stored as blue, green, red
          *values++ = static_cast<float>(number(start + 3 * x + static_cast<std::size_t>(2 - channel), 1)) / 255.0f;
    }
  }

 private:
  std::uint32_t number(std::size_t place, std::size_t bytes) const {
    std::uint32_t value = 0;
    for (std::size_t i = bytes; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes_[place + i]);
    return value;
  }

  std::string path_, bytes_;
  ImageHeader header_;
  std::size_t pixels_at_ = 0, row_bytes_ = 0;
  bool is_top_down_ = false;
};

}  // namespace

std::unique_ptr<ImageFile> open_plain_bmp(const std::string& path) {
  std::string bytes = read_file(path);
  if (!PlainBmpFile::is_plain(bytes)) return nullptr;
  return std::make_unique<PlainBmpFile>(path, std::move(bytes));
}

}  // namespace photonproof::inline harness_submissions
