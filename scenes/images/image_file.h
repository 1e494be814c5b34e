// The interface of image.cpp to readers of image files: OpenEXR, libpng, our own of PFM, and OpenImageIO for all
// others. OpenImageIO brings more than 200 shared libraries, which take longer to load than a small scene to render. So
// it is in a module, image_formats.cpp, that is loaded at the first file of another format.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace photonproof::inline scenes_images {

struct ImageHeader {
  enum class Samples { floating, bytes, words };
  int width = 0, height = 0;  ///< of the stored pixels: the data window
  /// Place of their upper left pixel in the display window, the full image, and that window's size.
  int x = 0, y = 0, display_width = 0, display_height = 0;
  std::vector<std::string> channels;
  Samples samples = Samples::floating;
  std::vector<std::string> colour;              ///< The channels that are the image: three, or a grey one.
  std::string layer;                            ///< The chosen layer of several; empty where it is plain R, G, B.
  std::vector<std::string> remarks;             ///< Remarks for readers of the file's numbers.
  int rows_together = 0;                        ///< Rows that are stored together, as in tiles. 0: each by itself.
  std::map<std::string, std::string> metadata;  ///< Texts about the rendering.
};

/// An image file open for reading; every failure is an InputError about the path.
class ImageFile {
 public:
  virtual ~ImageFile() = default;
  virtual const ImageHeader& header() const = 0;
  /// Reads rows [begin, end) of `count` channels from `first` on, interleaved; 8- and 16-bit samples from 0 to 1. Where
  /// rows are stored together, begin is the first of such a group and end the last's.
  virtual void read(int begin, int end, int first, int count, float* values) = 0;
};

/// An 8-bit RGB file being written, row after row; every failure is an InputError.
class ByteImageWriter {
 public:
  virtual ~ByteImageWriter() = default;
  virtual void add(int rows, const std::uint8_t* rgb) = 0;
  /// Call after the last row: write errors of the operating system show here at the latest.
  virtual void close() = 0;
};

/// Opens a file by OpenImageIO. Throws InputError, also when the module is neither in lib/ beside the program's folder
/// nor at its build location.
std::unique_ptr<ImageFile> open_other_format(const std::string& path);

}  // namespace photonproof::inline scenes_images
