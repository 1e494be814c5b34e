// Images of all formats except EXR, PNG and plain PFM, through OpenImageIO: the module that image_file.h describes.

#include <OpenImageIO/imageio.h>

#include "scenes/base/input_error.h"
#include "scenes/images/image_file.h"

namespace photonproof::inline scenes_images {
namespace {

std::string first_line(std::string message) {
  if (const auto end = message.find('\n'); end != std::string::npos) message.resize(end);
  return message.empty() ? "unknown reason" : message;
}

/// False for attributes that describe the file rather than the rendering in it.
bool is_of_the_file(const std::string& name) { return !name.starts_with("oiio:") && name != "DateTime"; }

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
    header_.x = spec_.x - spec_.full_x;
    header_.y = spec_.y - spec_.full_y;
    header_.display_width = spec_.full_width;
    header_.display_height = spec_.full_height;
    header_.channels = spec_.channelnames;
    if (spec_.format == OIIO::TypeUInt8)
      header_.samples = ImageHeader::Samples::bytes;
    else if (spec_.format == OIIO::TypeUInt16)
      header_.samples = ImageHeader::Samples::words;
    else if (!spec_.format.is_floating_point())
      throw InputError(path, std::string("samples are ") + spec_.format.c_str() + ", expected float or 8- or 16-bit");
    if (in_->seek_subimage(1, 0)) {
      header_.remarks.emplace_back("the first of several images in the file");
      if (!in_->seek_subimage(0, 0))
        throw InputError(path, "cannot be read as an image: " + first_line(in_->geterror()));
    } else {
      in_->geterror();  // no second one is no error
    }
    header_.rows_together = spec_.tile_height;
    for (const auto& attribute : spec_.extra_attribs)
      if (attribute.type() == OIIO::TypeString && is_of_the_file(attribute.name().string()))
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

}  // namespace
}  // namespace photonproof::inline scenes_images

extern "C" photonproof::ImageFile* photonproof_open_image(const char* path) {
  return new photonproof::OpenImageIoFile(path);
}
