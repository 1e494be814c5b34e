#include "scenes/images/exr_file.h"

#include <ImathBox.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTestFile.h>
#include <OpenEXR/ImfThreading.h>
#include <half.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "scenes/base/input_error.h"
#include "scenes/images/colour_choice.h"
#include "scenes/images/exr_sizes.h"

namespace photonproof::inline scenes_images {
namespace {

constexpr int greatest_side = 1 << 22, greatest_tile = 1 << 12;

/// Compressed blocks of large files are worked on by every core; small ones are done before threads would start.
void set_up_openexr(std::uintmax_t bytes) {
  static std::once_flag limits, threads;
  std::call_once(limits, [] {
    Imf::Header::setMaxImageSize(greatest_side, greatest_side);
    Imf::Header::setMaxTileSize(greatest_tile, greatest_tile);
  });
  constexpr std::uintmax_t large = 4 << 20;
  if (bytes > large)
    std::call_once(threads, [] { Imf::setGlobalThreadCount(static_cast<int>(std::thread::hardware_concurrency())); });
}

/// False for attributes that describe the file rather than the rendering in it.
bool is_metadata(const std::string& name) {
  return name != "type" && name != "name" && name != "view" && name != "capDate";
}

class ExrFile : public ImageFile {
 public:
  ExrFile(const std::string& path, const std::string& layer) : path_(path) {
    std::error_code ignored;
    set_up_openexr(std::filesystem::file_size(path, ignored));
    check_attribute_sizes(path);
    try {
      file_.emplace(path.c_str());
      const ColourChoice choice = choose_colour(path, readable_parts(), layer);
      const auto part = static_cast<int>(choice.part);
      part_.emplace(*file_, part);
      describe(file_->header(part));
      header_.colour = choice.channels;
      header_.layer = choice.layer;
      if (file_->parts() > 1)
        header_.layer += (header_.layer.empty() ? "part " : ", part ") + std::to_string(choice.part + 1) + " of " +
                         std::to_string(file_->parts());
    } catch (const std::exception& error) {
      refuse("cannot be read as an image: ", error);
    }
  }

  const ImageHeader& header() const override { return header_; }

  void read(int begin, int end, int first, int count, float* values) override {
    const auto channels = static_cast<std::size_t>(count);
    const std::size_t pixel = sizeof(float) * channels, row = pixel * static_cast<std::size_t>(header_.width);
    const int y = window_.min.y + begin;
    Imf::FrameBuffer buffer;
    for (std::size_t c = 0; c < channels; ++c)
      buffer.insert(header_.channels[static_cast<std::size_t>(first) + c],
                    Imf::Slice::Make(Imf::FLOAT, values + c, Imath::V2i(window_.min.x, y), header_.width, end - begin,
                                     pixel, row));
    try {
      part_->setFrameBuffer(buffer);
      part_->readPixels(y, window_.min.y + end - 1);
    } catch (const std::exception& error) {
      refuse("cannot be read, truncated or damaged: ", error);
    }
  }

 private:
  /// Channels with a number for every pixel, and the reasons against the others.
  std::vector<ImagePart> readable_parts() const {
    std::vector<ImagePart> parts;
    std::string unreadable;
    bool any = false;
    for (int p = 0; p < file_->parts(); ++p) {
      const Imf::Header& header = file_->header(p);
      parts.push_back({header.hasName() ? header.name() : std::string(), {}});
      if (header.hasType() && Imf::isDeepData(header.type())) {
        unreadable = "is a deep or volume image, expected a flat one";
        continue;
      }
      for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
        const std::string why = why_unreadable(channel.channel());
        if (why.empty()) parts.back().channels.emplace_back(channel.name());
        any = any || why.empty();
        if (!why.empty()) unreadable = why;
      }
    }
    if (!any && !unreadable.empty()) throw InputError(path_, unreadable);
    return parts;
  }

  static std::string why_unreadable(const Imf::Channel& channel) {
    if (channel.type == Imf::UINT) return "samples are uint, expected float or 8- or 16-bit";
    if (channel.xSampling != 1 || channel.ySampling != 1) return "samples are fewer than pixels (subsampled)";
    return {};
  }

  void describe(const Imf::Header& header) {
    window_ = header.dataWindow();
    header_.width = window_.max.x - window_.min.x + 1;
    header_.height = window_.max.y - window_.min.y + 1;
    const Imath::Box2i& display = header.displayWindow();
    header_.x = window_.min.x - display.min.x;
    header_.y = window_.min.y - display.min.y;
    header_.display_width = display.max.x - display.min.x + 1;
    header_.display_height = display.max.y - display.min.y + 1;
    if (header.hasTileDescription()) header_.rows_together = static_cast<int>(header.tileDescription().ySize);
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
      if (why_unreadable(channel.channel()).empty()) header_.channels.emplace_back(channel.name());
    }
    // Rows of colour, as files mostly have them, are read in one piece: OpenEXR lists channels by their letters.
    std::ranges::stable_sort(header_.channels, {}, [](const std::string& name) {
      const std::size_t dot = name.rfind('.');
      const std::string layer = dot == std::string::npos ? "" : name.substr(0, dot + 1);
      const std::size_t place = std::string("RGB").find(name.substr(layer.size()));
      return std::pair(layer, std::min<std::size_t>(place, 3));
    });
    for (auto attribute = header.begin(); attribute != header.end(); ++attribute)
      if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute());
          text && is_metadata(attribute.name()))
        header_.metadata[attribute.name()] = text->value();
  }

  /// Rethrows InputErrors; for others it throws their first line, without the path.
  [[noreturn]] void refuse(const std::string& words, const std::exception& error) const {
    if (dynamic_cast<const InputError*>(&error)) throw;
    std::string reason = error.what();
    reason.resize(std::min(reason.find('\n'), reason.size()));
    throw InputError(path_, words + reason);
  }

  std::string path_;
  std::optional<Imf::MultiPartInputFile> file_;
  std::optional<Imf::InputPart> part_;
  Imath::Box2i window_;
  ImageHeader header_;
};

/// A file whose every write is checked, closing too: OpenEXR's own does not report a disk that is full at the end.
class CheckedFile : public Imf::OStream {
 public:
  CheckedFile(const std::string& path, const std::string& target)
      : Imf::OStream(target.c_str()), target_(target), file_(std::fopen(path.c_str(), "wb")) {
    if (!file_) fail();
  }
  ~CheckedFile() override {
    if (file_) std::fclose(file_);
  }
  void write(const char* bytes, int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (std::fwrite(bytes, 1, size, file_) != size) fail();
  }
  std::uint64_t tellp() override { return static_cast<std::uint64_t>(ftello(file_)); }
  void seekp(std::uint64_t place) override {
    if (fseeko(file_, static_cast<off_t>(place), SEEK_SET) != 0) fail();
  }
  void close() {
    const bool written = std::ferror(file_) == 0;  // OpenEXR passes over what fails as it closes
    if (std::fclose(std::exchange(file_, nullptr)) != 0 || !written) fail();
  }

 private:
  [[noreturn]] void fail() const {
    throw InputError(target_, std::string("cannot be written: ") + std::strerror(errno));
  }

  std::string target_;
  std::FILE* file_;
};

std::vector<half> halves(const std::vector<float>& values) { return {values.begin(), values.end()}; }

}  // namespace

bool is_exr(const std::string& path) { return Imf::isOpenExrFile(path.c_str()); }

std::unique_ptr<ImageFile> open_exr(const std::string& path, const std::string& layer) {
  return std::make_unique<ExrFile>(path, layer);
}

void write_exr_file(const std::string& path, const std::string& target, const Rendering& rendering, ExrColour colour) {
  const ImagePlace place = rendering.place.value_or(ImagePlace{0, 0, rendering.mean.width, rendering.mean.height});
  const Imath::V2i first(place.x, place.y), size(rendering.mean.width, rendering.mean.height);
  Imf::Header header(Imath::Box2i({0, 0}, {place.width - 1, place.height - 1}),
                     Imath::Box2i(first, first + size - Imath::V2i(1)));
  // Deflating 32-bit noise takes as long as a short render and saves 2 %.
  header.compression() = colour == ExrColour::half ? Imf::ZIP_COMPRESSION : Imf::RLE_COMPRESSION;
  for (const auto& [name, value] : rendering.metadata) header.insert(name, Imf::StringAttribute(value));

  const std::vector<half> short_colour = colour == ExrColour::half ? halves(rendering.mean.rgb) : std::vector<half>();
  Imf::FrameBuffer buffer;
  const auto add = [&](const std::string& prefix, Imf::PixelType type, const void* values) {
    const std::size_t sample = type == Imf::HALF ? sizeof(half) : sizeof(float);
    const std::size_t row = 3 * sample * static_cast<std::size_t>(rendering.mean.width);
    for (std::size_t c = 0; c < 3; ++c) {
      const std::string name = prefix + "RGB"[c];
      header.channels().insert(name, Imf::Channel(type));
      buffer.insert(name, Imf::Slice::Make(type, static_cast<const char*>(values) + c * sample, header.dataWindow(),
                                           3 * sample, row));
    }
  };
  if (colour == ExrColour::half)
    add("", Imf::HALF, short_colour.data());
  else
    add("", Imf::FLOAT, rendering.mean.rgb.data());
  if (rendering.variance) add("variance.", Imf::FLOAT, rendering.variance->rgb.data());
  if (!rendering.alpha.empty()) {
    header.channels().insert("A", Imf::Channel(Imf::FLOAT));
    buffer.insert("A", Imf::Slice::Make(Imf::FLOAT, rendering.alpha.data(), header.dataWindow()));
  }

  try {
    set_up_openexr(sizeof(float) * rendering.mean.rgb.size());
    CheckedFile file(path, target);
    {
      Imf::OutputFile out(file, header);
      out.setFrameBuffer(buffer);
      out.writePixels(rendering.mean.height);
    }
    file.close();
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(target, std::string("cannot be written: ") + error.what());
  }
}

}  // namespace photonproof::inline scenes_images
