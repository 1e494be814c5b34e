// Images of all formats but EXR, through OpenImageIO: the module that image_file.h tells of.

#include <OpenImageIO/imageio.h>

#include "scenes/image_file.h"
#include "scenes/input_error.h"

namespace photonproof {
namespace {

std::string first_line(std::string message) {
  if (const auto end = message.find('\n'); end != std::string::npos) message.resize(end);
  return message.empty() ? "unknown reason" : message;
}

/// False for what describes the file rather than the rendering in it.
bool is_metadata(const std::string& name) { return !name.starts_with("oiio:") && name != "DateTime"; }

class OpenImageIoFile : public ImageFile {
 public:
  explicit OpenImageIoFile(const std::string& path) : path_(path) {
    OIIO::ImageSpec wanted;
    wanted.attribute("oiio:UnassociatedAlpha", 1);  // alpha is ignored, so it must not have scaled the colour either
    in_ = OIIO::ImageInput::open(path, &wanted);
    if (!in_) throw InputError(path, "cannot be read as an image: " + first_line(OIIO::geterror()));
    spec_ = in_->spec();
    if (spec_.deep || spec_.depth > 1) throw InputError(path, "is a deep or volume image, expected a flat one");
    header_.width = spec_.width;
    header_.height = spec_.height;
    header_.channels = spec_.channelnames;
    if (spec_.format == OIIO::TypeUInt8)
      header_.samples = ImageHeader::Samples::bytes;
    else if (spec_.format == OIIO::TypeUInt16)
      header_.samples = ImageHeader::Samples::words;
    else if (!spec_.format.is_floating_point())
      throw InputError(path, std::string("samples are ") + spec_.format.c_str() + ", expected float or 8- or 16-bit");
    header_.rows_together = spec_.tile_height;
    for (const auto& attribute : spec_.extra_attribs)
      if (attribute.type() == OIIO::TypeString && is_metadata(attribute.name().string()))
        header_.metadata[attribute.name().string()] = attribute.get_string();
  }

  const ImageHeader& header() const override { return header_; }

  void read(int begin, int end, int first, int count, float* values) override {
    const int y = spec_.y + begin, y_end = spec_.y + end;
    const bool read = spec_.tile_height > 0
                          ? in_->read_tiles(0, 0, spec_.x, spec_.x + spec_.width, y, y_end, spec_.z, spec_.z + 1, first,
                                            first + count, OIIO::TypeFloat, values)
                          : in_->read_scanlines(0, 0, y, y_end, spec_.z, first, first + count, OIIO::TypeFloat, values);
    if (!read) throw InputError(path_, "cannot be read, truncated or damaged: " + first_line(in_->geterror()));
  }

 private:
  std::string path_;
  std::unique_ptr<OIIO::ImageInput> in_;
  OIIO::ImageSpec spec_;
  ImageHeader header_;
};

class PngFile : public ByteImageWriter {
 public:
  PngFile(const std::string& path, const std::string& target, int width, int height)
      : path_(path), target_(target), out_(OIIO::ImageOutput::create("png")) {
    if (!out_) fail(OIIO::geterror());
    OIIO::ImageSpec spec(width, height, 3, OIIO::TypeUInt8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    // Of large pictures the best compression would take longer than what they show.
    if (std::int64_t{width} * height > (1 << 20)) spec.attribute("png:compressionLevel", 1);
    if (!out_->open(path, spec)) fail(out_->geterror());
  }

  void add(int rows, const std::uint8_t* rgb) override {
    if (!out_->write_scanlines(rows_, rows_ + rows, 0, OIIO::TypeUInt8, rgb)) fail(out_->geterror());
    rows_ += rows;
  }

  void close() override {
    if (!out_->close()) fail(out_->geterror());
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    std::string reason = first_line(message);
    if (const auto at = reason.find(path_); at != std::string::npos) reason.replace(at, path_.size(), target_);
    throw InputError(target_, "cannot be written: " + reason);
  }

  std::string path_, target_;
  std::unique_ptr<OIIO::ImageOutput> out_;
  int rows_ = 0;
};

}  // namespace
}  // namespace photonproof

extern "C" const photonproof::ImageFormats photonproof_image_formats;
const photonproof::ImageFormats photonproof_image_formats = {
    [](const std::string& path) -> std::unique_ptr<photonproof::ImageFile> {
      return std::make_unique<photonproof::OpenImageIoFile>(path);
    },
    [](const std::string& path, const std::string& target, int width,
       int height) -> std::unique_ptr<photonproof::ByteImageWriter> {
      return std::make_unique<photonproof::PngFile>(path, target, width, height);
    }};
