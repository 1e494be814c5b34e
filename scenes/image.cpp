#include "scenes/image.h"

#include <OpenImageIO/imageio.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>

#include "scenes/atomic_file.h"
#include "scenes/input_error.h"
#include "scenes/png_check.h"

namespace photonproof {
namespace {

constexpr std::int64_t kMaxPixels = std::int64_t{1} << 28;
using Channels = std::array<int, 3>;

std::string first_line(std::string message) {
  if (const auto end = message.find('\n'); end != std::string::npos) message.resize(end);
  return message.empty() ? "unknown reason" : message;
}

/// The channels named prefix+R, prefix+G, prefix+B, if all are there.
std::optional<Channels> find_rgb(const OIIO::ImageSpec& spec, const std::string& prefix) {
  const Channels found = {spec.channelindex(prefix + "R"), spec.channelindex(prefix + "G"),
                          spec.channelindex(prefix + "B")};
  if (found[0] < 0 || found[1] < 0 || found[2] < 0) return std::nullopt;
  return found;
}

/// The colour of an image: R,G,B; else the first layer "<layer>.R/G/B"; else grey from Y or from an only channel.
std::optional<Channels> find_colour(const OIIO::ImageSpec& spec) {
  if (const auto plain = find_rgb(spec, "")) return plain;
  for (const std::string& name : spec.channelnames) {
    const auto dot = name.rfind('.');
    if (dot == std::string::npos || name.substr(0, dot) == "variance") continue;
    if (const auto layer = find_rgb(spec, name.substr(0, dot + 1))) return layer;
  }
  const int luminance = spec.channelindex("Y");
  if (luminance >= 0 && spec.channelindex("RY") < 0) return Channels{luminance, luminance, luminance};
  if (spec.nchannels == 1 && spec.alpha_channel < 0 && spec.z_channel < 0) return Channels{0, 0, 0};
  return std::nullopt;
}

float decode_srgb(float v) { return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f); }

float encode_srgb(float v) { return v <= 0.0031308f ? v * 12.92f : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f; }

/// False for what describes the file rather than the rendering in it.
bool is_metadata(const std::string& name) {
  return name.rfind("oiio:", 0) != 0 && name != "compression" && name != "DateTime";
}

void check_supported(const std::string& path, const OIIO::ImageSpec& spec) {
  if (spec.deep || spec.depth > 1) throw InputError(path, "is a deep or volume image, expected a flat one");
  if (spec.width <= 0 || spec.height <= 0) throw InputError(path, "image has no pixels");
  const bool samples_ok =
      spec.format.is_floating_point() || spec.format == OIIO::TypeUInt8 || spec.format == OIIO::TypeUInt16;
  if (!samples_ok)
    throw InputError(path, std::string("samples are ") + spec.format.c_str() + ", expected float or 8- or 16-bit");
}

/// Writes interleaved `data` with the named OpenImageIO format; throws on every failure OpenImageIO reports.
void write_with(const char* format, const std::string& target, const std::string& temporary,
                const OIIO::ImageSpec& spec, const OIIO::TypeDesc& type, const void* data) {
  const std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create(format);
  if (!out) throw InputError(target, "cannot be written: " + first_line(OIIO::geterror()));
  // close() reports what the operating system could not flush, such as a full disk.
  if (out->open(temporary, spec) && out->write_image(type, data) && out->close()) return;
  std::string reason = first_line(out->geterror());
  if (const auto at = reason.find(temporary); at != std::string::npos) reason.replace(at, temporary.size(), target);
  throw InputError(target, "cannot be written: " + reason);
}

void check_size(const std::string& path, const Image& image) {
  const bool whole =
      image.width > 0 && image.height > 0 &&
      image.rgb.size() == 3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (!whole) throw InputError(path, "cannot be written: the image has no pixels or too few for its size");
}

std::string size_text(const OIIO::ImageSpec& spec) {
  return std::to_string(spec.width) + "x" + std::to_string(spec.height);
}

/// sRGB decoding of 8- and 16-bit samples, which take few values: each is worked out once.
class SrgbDecoder {
 public:
  explicit SrgbDecoder(const OIIO::ImageSpec& spec)
      : greatest_(spec.format == OIIO::TypeUInt8 ? 255.0f : 65535.0f),
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
int rows_at_once(const OIIO::ImageSpec& spec) {
  constexpr std::int64_t kValues = std::int64_t{1} << 20;
  if (spec.tile_height > 0) return spec.tile_height;
  return static_cast<int>(std::clamp<std::int64_t>(kValues / (std::int64_t{spec.nchannels} * spec.width), 1, 256));
}

bool read_rows(OIIO::ImageInput& in, const OIIO::ImageSpec& spec, int begin, int end, std::vector<float>& rows) {
  rows.resize(static_cast<std::size_t>(spec.nchannels) * static_cast<std::size_t>(spec.width) *
              static_cast<std::size_t>(end - begin));
  const int y = spec.y + begin, y_end = spec.y + end;
  if (spec.tile_height > 0)
    return in.read_tiles(0, 0, spec.x, spec.x + spec.width, y, y_end, spec.z, spec.z + 1, 0, spec.nchannels,
                         OIIO::TypeFloat, rows.data());
  return in.read_scanlines(0, 0, y, y_end, spec.z, 0, spec.nchannels, OIIO::TypeFloat, rows.data());
}

/// An open file whose rows are asked for in any order.
class OpenImage {
 public:
  explicit OpenImage(const std::string& path) : path_(path) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) throw InputError(path, "no such file");
    if (!std::filesystem::is_regular_file(path, ignored)) throw InputError(path, "not a regular file");
    check_png(path);
    OIIO::ImageSpec wanted;
    wanted.attribute("oiio:UnassociatedAlpha", 1);  // alpha is ignored, so it must not have scaled the colour either
    in_ = OIIO::ImageInput::open(path, &wanted);
    if (!in_) throw InputError(path, "cannot be read as an image: " + first_line(OIIO::geterror()));
    spec_ = in_->spec();
    check_supported(path, spec_);
    const auto found = find_colour(spec_);
    if (!found) throw InputError(path, "image has no colour: expected channels R, G, B or a single grey one");
    colour_ = *found;
  }
  const OIIO::ImageSpec& spec() const { return spec_; }
  const Channels& colour() const { return colour_; }

  /// Reads all channels together from now on, for a caller who wants more than the colour.
  void read_whole_rows() { whole_rows_ = true; }

  /// Three channels of rows [begin, end), interleaved.
  void read(int begin, int end, const Channels& channels, float* rgb) {
    const bool adjacent = channels[1] == channels[0] + 1 && channels[2] == channels[0] + 2;
    if (spec_.tile_height == 0 && adjacent && !whole_rows_) {
      if (!in_->read_scanlines(0, 0, spec_.y + begin, spec_.y + end, spec_.z, channels[0], channels[0] + 3,
                               OIIO::TypeFloat, rgb))
        throw InputError(path_, "cannot be read, truncated or damaged: " + first_line(in_->geterror()));
      return;
    }
    const auto stride = static_cast<std::size_t>(spec_.nchannels);
    const std::size_t row = static_cast<std::size_t>(spec_.width) * stride;
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
    const int rows = rows_at_once(spec_);
    const int begin = y / rows * rows, end = std::min(spec_.height, begin + rows);
    if (!read_rows(*in_, spec_, begin, end, group_))
      throw InputError(path_, "cannot be read, truncated or damaged: " + first_line(in_->geterror()));
    group_begin_ = begin;
    group_end_ = end;
  }

  std::string path_;
  std::unique_ptr<OIIO::ImageInput> in_;
  OIIO::ImageSpec spec_;
  Channels colour_{};
  std::vector<float> group_;
  int group_begin_ = 0, group_end_ = 0;
  bool whole_rows_ = false;
};

struct Decoded {
  OIIO::ImageSpec spec;
  Image colour;
  std::optional<Image> variance;
};

Decoded decode(const std::string& path) {
  OpenImage file(path);
  const OIIO::ImageSpec& spec = file.spec();
  if (static_cast<std::int64_t>(spec.width) * spec.height > kMaxPixels)
    throw InputError(path, "image is " + size_text(spec) + ", the limit is 2^28 pixels");
  Decoded decoded{spec, {}, {}};
  const auto variance = find_rgb(spec, "variance.");
  if (variance) {
    decoded.variance.emplace();
    file.read_whole_rows();
  }
  const std::size_t row = 3 * static_cast<std::size_t>(spec.width);
  const auto append = [&](Image& image, int begin, int end, const Channels& channels) {
    // Reserved memory that is never written to takes no page.
    image.rgb.reserve(row * static_cast<std::size_t>(spec.height));
    image.rgb.resize(row * static_cast<std::size_t>(end));
    image.width = spec.width;
    image.height = end;
    file.read(begin, end, channels, image.rgb.data() + row * static_cast<std::size_t>(begin));
  };
  for (int y = 0, end = 0; y < spec.height; y = end) {
    end = std::min(spec.height, y + rows_at_once(spec));
    append(decoded.colour, y, end, file.colour());
    if (variance) append(*decoded.variance, y, end, *variance);
  }
  return decoded;
}

Image colour_of(Decoded&& decoded, bool raw) {
  if (!raw && !decoded.spec.format.is_floating_point()) {
    SrgbDecoder linear(decoded.spec);
    for (float& v : decoded.colour.rgb) v = linear(v);
  }
  return std::move(decoded.colour);
}

}  // namespace

struct ImageRows::State {
  OpenImage file;
  std::optional<SrgbDecoder> decoder;
};

ImageRows::ImageRows(const std::string& path) : state_(std::make_unique<State>(State{OpenImage(path), {}})) {
  const OIIO::ImageSpec& spec = state_->file.spec();
  constexpr std::int64_t kMaxWidth = std::int64_t{1} << 18, kMaxStreamed = (std::int64_t{1} << 32) - 1;
  if (spec.width > kMaxWidth || std::int64_t{spec.width} * spec.height > kMaxStreamed)
    throw InputError(path, "image is " + size_text(spec) + ", the limit is 2^18 columns and 2^32 pixels");
  if (!spec.format.is_floating_point()) state_->decoder.emplace(spec);
}
ImageRows::~ImageRows() = default;
ImageRows::ImageRows(ImageRows&&) noexcept = default;
int ImageRows::width() const { return state_->file.spec().width; }
int ImageRows::height() const { return state_->file.spec().height; }

void ImageRows::read(int begin, int end, float* rgb) {
  state_->file.read(begin, end, state_->file.colour(), rgb);
  if (!state_->decoder) return;
  const std::size_t values = 3 * static_cast<std::size_t>(width()) * static_cast<std::size_t>(end - begin);
  for (std::size_t i = 0; i < values; ++i) rgb[i] = (*state_->decoder)(rgb[i]);
}

Rendering read_rendering(const std::string& path) {
  Decoded decoded = decode(path);
  Rendering rendering;
  for (const auto& attribute : decoded.spec.extra_attribs)
    if (attribute.type() == OIIO::TypeString && is_metadata(attribute.name().string()))
      rendering.metadata[attribute.name().string()] = attribute.get_string();
  rendering.variance = std::move(decoded.variance);
  rendering.mean = colour_of(std::move(decoded), false);
  return rendering;
}

Image read_texture_image(const std::string& path, bool raw) {
  Image image = colour_of(decode(path), raw);
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
  const int channels = has_variance ? 6 : 3;
  OIIO::ImageSpec spec(rendering.mean.width, rendering.mean.height, channels, OIIO::TypeFloat);
  spec.channelnames = {"R", "G", "B"};
  if (has_variance) spec.channelnames.insert(spec.channelnames.end(), {"variance.R", "variance.G", "variance.B"});
  if (colour == ExrColour::half) {
    spec.channelformats.assign(static_cast<std::size_t>(channels), OIIO::TypeFloat);
    std::fill_n(spec.channelformats.begin(), 3, OIIO::TypeHalf);
  }
  for (const auto& [name, value] : rendering.metadata) spec.attribute(name, value);
  spec.attribute("compression", "zip");
  spec.attribute("DateTime", "");  // else OpenImageIO writes the current time, and equal renderings differ in bytes

  std::vector<float> data;
  data.reserve(rendering.mean.pixels() * static_cast<std::size_t>(channels));
  for (std::size_t p = 0; p < rendering.mean.pixels(); ++p) {
    const auto at = static_cast<std::ptrdiff_t>(3 * p);
    data.insert(data.end(), rendering.mean.rgb.begin() + at, rendering.mean.rgb.begin() + at + 3);
    if (has_variance)
      data.insert(data.end(), rendering.variance->rgb.begin() + at, rendering.variance->rgb.begin() + at + 3);
  }
  replace_atomically(path, [&](const std::filesystem::path& temporary) {
    write_with("openexr", path, temporary.string(), spec, OIIO::TypeFloat, data.data());
  });
}

struct PngRows::State {
  std::string path, temporary;
  std::unique_ptr<OIIO::ImageOutput> out;
  int rows = 0;

  [[noreturn]] void fail() const { throw InputError(path, "cannot be written: " + first_line(out->geterror())); }
  ~State() {
    std::error_code ignored;
    if (out) std::filesystem::remove(temporary, ignored);
  }
};

PngRows::PngRows(const std::string& path, int width, int height) : state_(std::make_unique<State>()) {
  const std::filesystem::path target(path);
  state_->path = path;
  state_->temporary =
      (target.parent_path() / ("." + target.stem().string() + ".partial-" + std::to_string(getpid()) + "-rows.png"))
          .string();
  state_->out = OIIO::ImageOutput::create("png");
  if (!state_->out) throw InputError(path, "cannot be written: " + first_line(OIIO::geterror()));
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeUInt8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  // Of large pictures the best compression would take longer than what they show.
  if (std::int64_t{width} * height > (1 << 20)) spec.attribute("png:compressionLevel", 1);
  if (!state_->out->open(state_->temporary, spec)) state_->fail();
}
PngRows::~PngRows() = default;
PngRows::PngRows(PngRows&&) noexcept = default;

void PngRows::add(int count, const std::uint8_t* rgb) {
  if (!state_->out->write_scanlines(state_->rows, state_->rows + count, 0, OIIO::TypeUInt8, rgb)) state_->fail();
  state_->rows += count;
}

void PngRows::finish() {
  if (!state_->out->close()) state_->fail();
  replace_atomically(state_->path,
                     [&](const std::filesystem::path& named) { std::filesystem::rename(state_->temporary, named); });
  state_->out.reset();
}

void write_png(const std::string& path, const Image& image, double exposure) {
  check_size(path, image);
  OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeUInt8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  const auto scale = static_cast<float>(std::exp2(exposure));
  std::vector<std::uint8_t> data(image.rgb.size());
  for (std::size_t i = 0; i < data.size(); ++i) {
    const float v = image.rgb[i] * scale;
    const float clamped = v > 0 ? std::min(v, 1.0f) : 0.0f;  // NaN shows as black
    data[i] = static_cast<std::uint8_t>(std::lround(255 * encode_srgb(clamped)));
  }
  replace_atomically(path, [&](const std::filesystem::path& temporary) {
    write_with("png", path, temporary.string(), spec, OIIO::TypeUInt8, data.data());
  });
}

}  // namespace photonproof
