#include "scenes/images/image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>

#include "scenes/base/input_error.h"
#include "scenes/base/size_text.h"
#include "scenes/files/atomic_file.h"
#include "scenes/images/colour_choice.h"
#include "scenes/images/display_window.h"
#include "scenes/images/exr_file.h"
#include "scenes/images/image_file.h"
#include "scenes/images/netpbm_file.h"
#include "scenes/images/png_file.h"

namespace photonproof::inline scenes_images {
namespace {

constexpr std::int64_t kMaxPixels = std::int64_t{1} << 28;
using Channels = std::array<int, 3>;

/// The place of the channel of that name, or -1.
int find_channel(const ImageHeader& header, const std::string& name) {
  const auto found = std::ranges::find(header.channels, name);
  return found == header.channels.end() ? -1 : static_cast<int>(found - header.channels.begin());
}

/// The channels named prefix+R, prefix+G, prefix+B, if all are there.
std::optional<Channels> find_rgb(const ImageHeader& header, const std::string& prefix) {
  const Channels found = {find_channel(header, prefix + "R"), find_channel(header, prefix + "G"),
                          find_channel(header, prefix + "B")};
  if (found[0] < 0 || found[1] < 0 || found[2] < 0) return std::nullopt;
  return found;
}

/// Three channels, or a single one three times.
Channels places_of(const ImageHeader& header, const std::vector<std::string>& colour) {
  Channels places{};
  for (std::size_t c = 0; c < places.size(); ++c)
    places[c] = find_channel(header, colour[std::min(c, colour.size() - 1)]);
  return places;
}

/// Remarks on an image that is stored or read in another way than as plain linear RGB, for readers of its numbers.
std::vector<std::string> remarks_on(const ImageHeader& stored) {
  std::vector<std::string> remarks = stored.remarks;
  if (const std::string& layer = stored.layer; !layer.empty()) {
    const bool is_named = !layer.starts_with("grey ") && !layer.starts_with("part ");
    remarks.insert(remarks.begin(), (is_named ? "layer " : "") + layer);
  }
  if (stored.samples != ImageHeader::Samples::floating)
    remarks.push_back(std::string(stored.samples == ImageHeader::Samples::bytes ? "8-bit" : "16-bit") +
                      ", made linear from sRGB");
  if (stored.x != 0 || stored.y != 0 || stored.width != stored.display_width || stored.height != stored.display_height)
    remarks.push_back("stored are " + size_text(stored.width, stored.height) + " pixels from (" +
                      std::to_string(stored.x) + ", " + std::to_string(stored.y) + ") on, black around them");
  return remarks;
}

float decode_srgb(float v) { return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f); }

float encode_srgb(float v) { return v <= 0.0031308f ? v * 12.92f : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f; }

void check_size(const std::string& path, const Image& image) {
  const bool whole =
      image.width > 0 && image.height > 0 &&
      image.rgb.size() == 3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (!whole) throw InputError(path, "cannot be written: the image has no pixels or too few for its size");
}

/// sRGB decoding of 8- and 16-bit samples, which have few values: each is computed once.
class SrgbDecoder {
 public:
  explicit SrgbDecoder(const ImageHeader& header)
      : greatest_(header.samples == ImageHeader::Samples::bytes ? 255.0f : 65535.0f),
        known_(static_cast<std::size_t>(greatest_) + 1, {-1, 0}) {}
  float operator()(float v) {
    auto& [encoded, linear] = known_[static_cast<std::size_t>(v * greatest_ + 0.5f)];
    if (encoded != v) {
      encoded = v;
      linear = decode_srgb(v);
    }
    return linear;
  }

 private:
  float greatest_;
  std::vector<std::pair<float, float>> known_;
};

/// Rows to read at once: few, so that a header cannot claim much more memory than its file has pixels for.
int rows_at_once(const ImageHeader& header) {
  constexpr std::int64_t kValues = std::int64_t{1} << 20;
  if (header.rows_together > 0) return header.rows_together;
  const std::int64_t row = static_cast<std::int64_t>(header.channels.size()) * header.width;
  return static_cast<int>(std::clamp<std::int64_t>(kValues / row, 1, 256));
}

std::unique_ptr<ImageFile> open_stored(const std::string& path, const std::string& layer) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) throw InputError(path, "no such file");
  if (!std::filesystem::is_regular_file(path, ignored)) throw InputError(path, "not a regular file");
  if (is_exr(path)) return open_exr(path, layer);
  if (is_png(path)) return open_png(path);
  if (std::unique_ptr<ImageFile> plain = open_plain_pfm(path)) return plain;
  std::string start(64, '\0');
  std::ifstream(path, std::ios::binary).read(start.data(), static_cast<std::streamsize>(start.size()));
  refuse_lfs_pointer(path, start);
  return open_other_format(path);
}

/// The place of a file that stores only a part of its image.
std::optional<ImagePlace> place_of(const ImageHeader& h) {
  const bool whole = h.width == h.display_width && h.height == h.display_height;
  const bool within = h.x >= 0 && h.y >= 0 && h.x + h.width <= h.display_width && h.y + h.height <= h.display_height;
  return within && !whole ? std::optional(ImagePlace{h.x, h.y, h.display_width, h.display_height}) : std::nullopt;
}

struct Opened {
  std::unique_ptr<ImageFile> file;
  std::optional<ImagePlace> place;   ///< of the stored part
  std::vector<std::string> remarks;  ///< on it
};

Opened open_part(const std::string& path, const std::string& layer, ImageWindow part) {
  Opened opened{open_stored(path, layer), {}, {}};
  opened.place = place_of(opened.file->header());
  opened.remarks = remarks_on(opened.file->header());
  if (!opened.place || part == ImageWindow::displayed) opened.file = as_displayed(std::move(opened.file), path);
  return opened;
}

/// An open file whose rows can be read in any order.
class OpenImage {
 public:
  OpenImage(const std::string& path, Opened opened, const std::string& layer = "")
      : file_(std::move(opened.file)), place_(opened.place), remarks_(std::move(opened.remarks)) {
    if (header().width <= 0 || header().height <= 0) throw InputError(path, "image has no pixels");
    const bool is_chosen = !header().colour.empty();
    colour_ = places_of(header(),
                        is_chosen ? header().colour : choose_colour(path, {{"", header().channels}}, layer).channels);
  }
  const ImageHeader& header() const { return file_->header(); }
  const std::vector<std::string>& remarks() const { return remarks_; }
  const std::optional<ImagePlace>& place() const { return place_; }
  const Channels& colour() const { return colour_; }

  /// Reads all channels together from now on, for a caller who wants more than the colour.
  void read_whole_rows() { whole_rows_ = true; }

  /// Three channels of rows [begin, end), interleaved.
  void read(int begin, int end, const Channels& channels, float* rgb) {
    const bool adjacent = channels[1] == channels[0] + 1 && channels[2] == channels[0] + 2;
    if (header().rows_together == 0 && adjacent && !whole_rows_) return file_->read(begin, end, channels[0], 3, rgb);
    const std::size_t stride = header().channels.size();
    const std::size_t row = static_cast<std::size_t>(header().width) * stride;
    for (int y = begin; y < end;) {
      load_group_of(y);
      const int last = std::min(end, group_end_);
      const float* at = group_.data() + static_cast<std::size_t>(y - group_begin_) * row;
      for (const float* stop = at + static_cast<std::size_t>(last - y) * row; at < stop; at += stride)
        for (const int c : channels) *rgb++ = at[c];
      y = last;
    }
  }

 private:
  /// All channels of the rows that are best read together with row y.
  void load_group_of(int y) {
    if (y >= group_begin_ && y < group_end_) return;
    const int rows = rows_at_once(header());
    const int begin = y / rows * rows, end = std::min(header().height, begin + rows);
    const std::size_t channels = header().channels.size();
    group_.resize(channels * static_cast<std::size_t>(header().width) * static_cast<std::size_t>(end - begin));
    file_->read(begin, end, 0, static_cast<int>(channels), group_.data());
    group_begin_ = begin;
    group_end_ = end;
  }

  std::unique_ptr<ImageFile> file_;
  std::optional<ImagePlace> place_;
  std::vector<std::string> remarks_;
  Channels colour_{};
  std::vector<float> group_;
  int group_begin_ = 0, group_end_ = 0;
  bool whole_rows_ = false;
};

struct Decoded {
  ImageHeader header;
  Image colour;
  std::optional<Image> variance;
  std::optional<ImagePlace> place;
};

Decoded decode(const std::string& path, Opened opened, const std::string& layer = "") {
  OpenImage file(path, std::move(opened), layer);
  const ImageHeader& header = file.header();
  if (static_cast<std::int64_t>(header.width) * header.height > kMaxPixels)
    throw InputError(path, "image is " + size_text(header.width, header.height) + ", the limit is 2^28 pixels");
  Decoded decoded{header, {}, {}, file.place()};
  const auto variance = header.layer.empty() ? find_rgb(header, "variance.") : std::nullopt;  // of plain R, G, B
  if (variance) {
    decoded.variance.emplace();
    file.read_whole_rows();
  }
  const std::size_t row = 3 * static_cast<std::size_t>(header.width);
  const auto append = [&](Image& image, int begin, int end, const Channels& channels) {
    // Reserved memory that is never written to takes no page.
    image.rgb.reserve(row * static_cast<std::size_t>(header.height));
    image.rgb.resize(row * static_cast<std::size_t>(end));
    image.width = header.width;
    image.height = end;
    file.read(begin, end, channels, image.rgb.data() + row * static_cast<std::size_t>(begin));
  };
  for (int y = 0, end = 0; y < header.height; y = end) {
    end = std::min(header.height, y + rows_at_once(header));
    append(decoded.colour, y, end, file.colour());
    if (variance) append(*decoded.variance, y, end, *variance);
  }
  return decoded;
}

Image colour_of(Decoded&& decoded, bool raw) {
  if (!raw && decoded.header.samples != ImageHeader::Samples::floating) {
    SrgbDecoder linear(decoded.header);
    for (float& v : decoded.colour.rgb) v = linear(v);
  }
  return std::move(decoded.colour);
}

}  // namespace

struct ImageRows::State {
  OpenImage file;
  std::optional<SrgbDecoder> decoder;
};

ImageRows::ImageRows(const std::string& path, const std::string& layer, ImageWindow part)
    : state_(std::make_unique<State>(State{OpenImage(path, open_part(path, layer, part), layer), {}})) {
  const ImageHeader& header = state_->file.header();
  constexpr std::int64_t kMaxWidth = std::int64_t{1} << 18, kMaxStreamed = (std::int64_t{1} << 32) - 1;
  if (header.width > kMaxWidth || std::int64_t{header.width} * header.height > kMaxStreamed)
    throw InputError(
        path, "image is " + size_text(header.width, header.height) + ", the limit is 2^18 columns and 2^32 pixels");
  if (header.samples != ImageHeader::Samples::floating) state_->decoder.emplace(header);
}
ImageRows::~ImageRows() = default;
ImageRows::ImageRows(ImageRows&&) noexcept = default;
int ImageRows::width() const { return state_->file.header().width; }
int ImageRows::height() const { return state_->file.header().height; }
const std::string& ImageRows::layer() const { return state_->file.header().layer; }
const std::vector<std::string>& ImageRows::remarks() const { return state_->file.remarks(); }
std::optional<ImagePlace> ImageRows::place() const { return state_->file.place(); }

void ImageRows::read(int begin, int end, float* rgb) {
  state_->file.read(begin, end, state_->file.colour(), rgb);
  if (!state_->decoder) return;
  const std::size_t values = 3 * static_cast<std::size_t>(width()) * static_cast<std::size_t>(end - begin);
  for (std::size_t i = 0; i < values; ++i) rgb[i] = (*state_->decoder)(rgb[i]);
}

Rendering read_rendering(const std::string& path, const std::string& layer, ImageWindow part) {
  Decoded decoded = decode(path, open_part(path, layer, part), layer);
  Rendering rendering;
  if (part == ImageWindow::stored) rendering.place = decoded.place;
  rendering.metadata = std::move(decoded.header.metadata);
  rendering.variance = std::move(decoded.variance);
  rendering.mean = colour_of(std::move(decoded), false);
  return rendering;
}

Rendering displayed(const Rendering& part) {
  if (!part.place) return part;
  const auto whole = [&](const Image& image) {
    Image out(part.place->width, part.place->height);
    for (int y = 0; y < image.height; ++y)
      std::copy_n(image.pixel(0, y), 3 * image.width, out.pixel(part.place->x, part.place->y + y));
    return out;
  };
  Rendering out;
  out.mean = whole(part.mean);
  if (part.variance) out.variance = whole(*part.variance);
  out.metadata = part.metadata;
  return out;
}

Image read_texture_image(const std::string& path, bool raw) {
  Image image = colour_of(decode(path, {open_stored(path, ""), {}, {}}), raw);
  const auto bad =
      std::find_if(image.rgb.begin(), image.rgb.end(), [](float v) { return !(v >= 0 && std::isfinite(v)); });
  if (bad == image.rgb.end()) return image;
  const auto pixel = static_cast<std::size_t>(bad - image.rgb.begin()) / 3,
             width = static_cast<std::size_t>(image.width);
  throw InputError(path, std::string(std::isfinite(*bad) ? "has a negative value" : "has a value that is not finite") +
                             " at column " + std::to_string(pixel % width) + ", row " + std::to_string(pixel / width));
}

void write_exr(const std::string& path, const Rendering& rendering, ExrColour colour) {
  check_size(path, rendering.mean);
  const bool has_variance = rendering.variance.has_value();
  if (has_variance) {
    check_size(path, *rendering.variance);
    if (rendering.variance->width != rendering.mean.width || rendering.variance->height != rendering.mean.height)
      throw InputError(path, "cannot be written: mean and variance differ in size");
  }
  if (!rendering.alpha.empty() && rendering.alpha.size() != rendering.mean.pixels())
    throw InputError(path, "cannot be written: mean and alpha differ in size");
  replace_atomically(path, [&](const std::filesystem::path& temporary) {
    write_exr_file(temporary.string(), path, rendering, colour);
  });
}

struct PngRows::State {
  std::string path, temporary;
  std::unique_ptr<ByteImageWriter> out;

  ~State() {
    std::error_code ignored;
    if (out) std::filesystem::remove(temporary, ignored);
  }
};

PngRows::PngRows(const std::string& path, int width, int height) : state_(std::make_unique<State>()) {
  state_->path = path;
  state_->temporary = temporary_for_rows(path).string();
  state_->out = create_png(state_->temporary, path, width, height);
}
PngRows::~PngRows() = default;
PngRows::PngRows(PngRows&&) noexcept = default;

void PngRows::add(int count, const std::uint8_t* rgb) { state_->out->add(count, rgb); }

void PngRows::finish() {
  state_->out->close();
  replace_atomically(state_->path,
                     [&](const std::filesystem::path& named) { std::filesystem::rename(state_->temporary, named); });
  state_->out.reset();
}

void write_png(const std::string& path, const Image& image, double exposure) {
  check_size(path, image);
  const auto scale = static_cast<float>(std::exp2(exposure));
  std::vector<std::uint8_t> data(image.rgb.size());
  for (std::size_t i = 0; i < data.size(); ++i) {
    const float v = image.rgb[i] * scale;
    const float clamped = v > 0 ? std::min(v, 1.0f) : 0.0f;  // NaN shows as black
    data[i] = static_cast<std::uint8_t>(std::lround(255 * encode_srgb(clamped)));
  }
  replace_atomically(path, [&](const std::filesystem::path& temporary) {
    const auto png = create_png(temporary.string(), path, image.width, image.height);
    png->add(image.height, data.data());
    png->close();
  });
}

}  // namespace photonproof::inline scenes_images
