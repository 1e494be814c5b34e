#include "scenes/images/netpbm_file.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string_view>

#include "scenes/base/input_error.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline scenes_images {
namespace {

constexpr std::int64_t greatest_size = 1 << 24;

class NetpbmFile : public ImageFile {
 public:
  explicit NetpbmFile(const std::string& path) : path_(path), bytes_(read_file(path)) {
    kind_ = bytes_.size() > 1 && bytes_[0] == 'P' ? bytes_[1] : '\0';
    at_ = 2;
    header_.width = header_.display_width = static_cast<int>(integer(greatest_size));
    header_.height = header_.display_height = static_cast<int>(integer(greatest_size));
    const std::string_view last = word();
    if (is_float())
      read_scale(last);
    else
      greatest_ = value_of(last, 65535);
    if (header_.width == 0 || header_.height == 0 || greatest_ == 0) damaged("a size or a greatest value of 0");
    ++at_;  // one blank, whatever comes after it
    header_.channels = kind_ == 'f' ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"};
    if (!is_float()) header_.samples = greatest_ < 256 ? ImageHeader::Samples::bytes : ImageHeader::Samples::words;
    header_.rows_together = header_.height;  // rows of text have no fixed place
  }

  const ImageHeader& header() const override { return header_; }
  bool has_scale() const { return scale_ != 1; }

  // Checks, before memory is taken for the samples, that the file is long enough for them.
  void check_length() const {
    const std::size_t samples =
        static_cast<std::size_t>(header_.width) * static_cast<std::size_t>(header_.height) * header_.channels.size();
    const std::size_t needed = kind_ == '3' ? 2 * samples - 1 : samples * sample_bytes();
    if (at_ > bytes_.size() || bytes_.size() - at_ < needed) truncated();
  }

  void read(int, int, int first, int count, float* values) override {
    check_length();
    const auto width = static_cast<std::size_t>(header_.width), height = static_cast<std::size_t>(header_.height);
    const std::size_t channels = header_.channels.size(), samples = width * height * channels;
    for (std::size_t sample = 0; sample < samples; ++sample) {
      const float value = next();
      const std::size_t channel = sample % channels, pixel = sample / channels;
      if (channel < static_cast<std::size_t>(first) || channel >= static_cast<std::size_t>(first + count)) continue;
      const std::size_t y = is_float() ? height - 1 - pixel / width : pixel / width;  // PFM starts with the lowest row
      values[(y * width + pixel % width) * static_cast<std::size_t>(count) + channel -
             static_cast<std::size_t>(first)] = value;
    }
  }

 private:
  bool is_float() const { return kind_ == 'F' || kind_ == 'f'; }
  [[noreturn]] void damaged(const std::string& how) const { throw InputError(path_, "is damaged: " + how); }
  [[noreturn]] void truncated() const { throw InputError(path_, "is truncated: fewer numbers than its size says"); }

  // The next word; blanks and comments separate words.
  std::string_view word() {
    const auto blank = [this] { return std::isspace(static_cast<unsigned char>(bytes_[at_])) != 0; };
    while (at_ < bytes_.size() && (blank() || bytes_[at_] == '#'))
      if (bytes_[at_] == '#')
        at_ = std::min(bytes_.find('\n', at_), bytes_.size());
      else
        ++at_;
    const std::size_t begin = at_;
    while (at_ < bytes_.size() && !blank() && bytes_[at_] != '#') ++at_;
    if (begin == at_) truncated();
    return std::string_view(bytes_).substr(begin, at_ - begin);
  }
  std::int64_t value_of(std::string_view text, std::int64_t most) const {
    std::int64_t value = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failure != std::errc{} || end != text.data() + text.size() || value < 0 || value > most)
      damaged("expected a number up to " + std::to_string(most));
    return value;
  }
  std::int64_t integer(std::int64_t most) { return value_of(word(), most); }
  void read_scale(std::string_view text) {
    double scale = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), scale);
    if (failure != std::errc{} || end != text.data() + text.size() || scale == 0 || !std::isfinite(scale))
      damaged("expected a scale other than 0");
    swapped_ = (scale > 0) == (std::endian::native == std::endian::little);
    scale_ = std::abs(scale);
  }

  std::size_t sample_bytes() const { return is_float() ? 4 : greatest_ < 256 ? 1 : 2; }

  float next() {
    if (kind_ == '3') return normalised(integer(greatest_));
    if (is_float()) {
      std::uint32_t bits = 0;
      std::memcpy(&bits, bytes_.data() + at_, sizeof bits);
      at_ += sizeof bits;
      return std::bit_cast<float>(swapped_ ? __builtin_bswap32(bits) : bits);
    }
    std::int64_t value = 0;
    for (std::size_t byte = 0; byte < sample_bytes(); ++byte)
      value = 256 * value + static_cast<unsigned char>(bytes_[at_++]);
    if (value > greatest_) damaged("a number above its greatest value");
    return normalised(value);
  }
  float normalised(std::int64_t value) const { return static_cast<float>(value) / static_cast<float>(greatest_); }

  std::string path_, bytes_;
  std::size_t at_ = 0;
  char kind_ = '\0';
  std::int64_t greatest_ = 1;
  bool swapped_ = false;
  double scale_ = 1;
  ImageHeader header_;
};

}  // namespace

std::unique_ptr<ImageFile> open_netpbm(const std::string& path) { return std::make_unique<NetpbmFile>(path); }

std::unique_ptr<ImageFile> open_plain_pfm(const std::string& path) {
  char start[2] = {};
  std::ifstream(path, std::ios::binary).read(start, sizeof start);
  if (start[0] != 'P' || (start[1] != 'F' && start[1] != 'f')) return nullptr;
  auto file = std::make_unique<NetpbmFile>(path);
  if (file->has_scale()) return nullptr;
  file->check_length();
  return file;
}

void write_pfm(const std::string& path, const Image& image) {
  static_assert(std::endian::native == std::endian::little, "as the scale -1 tells");
  std::string bytes = "PF\n" + std::to_string(image.width) + " " + std::to_string(image.height) + "\n-1\n";
  const std::size_t head = bytes.size(), row = 3 * sizeof(float) * static_cast<std::size_t>(image.width);
  bytes.resize(head + row * static_cast<std::size_t>(image.height));
  for (int y = 0; y < image.height; ++y)
    std::memcpy(&bytes[head + row * static_cast<std::size_t>(image.height - 1 - y)], image.pixel(0, y), row);
  write_file_atomically(path, bytes);
}

}  // namespace photonproof::inline scenes_images
