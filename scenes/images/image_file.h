// What image.cpp needs of the libraries that read and write image files: OpenEXR, libpng, and OpenImageIO for all other
// formats. OpenImageIO brings more than 200 shared libraries, which take longer to load than a small scene to render;
// so it is in a module, image_formats.cpp, that is loaded by whoever meets a file of another format.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace photonproof::inline scenes_images {

struct ImageHeader {
  enum class Samples { floating, bytes, words };
  int width = 0, height = 0;  ///< of the pixels that are stored: the data window
  /// Where their upper left one lies in the display window, the image that is meant, and how large that is.
  int x = 0, y = 0, display_width = 0, display_height = 0;
  std::vector<std::string> channels;
  Samples samples = Samples::floating;
  std::vector<std::string> colour;              ///< those of the channels that are the image: three, or a grey one
  std::string layer;                            ///< of several that the file may hold; empty where it is plain R, G, B
  std::vector<std::string> remarks;             ///< what a reader of numbers has to know of the file
  int rows_together = 0;                        ///< rows that are stored as one, as in tiles; 0: each by itself
  std::map<std::string, std::string> metadata;  ///< texts about the rendering
};

/// An image file open for reading; every failure is an InputError about the path.
class ImageFile {
 public:
  virtual ~ImageFile() = default;
  virtual const ImageHeader& header() const = 0;
  /// Rows [begin, end) of `count` channels from `first` on, interleaved; 8- and 16-bit samples from 0 to 1. Where rows
  /// are together, begin is the first of such a group and end the last's.
  virtual void read(int begin, int end, int first, int count, float* values) = 0;
};

/// An 8-bit RGB file being written, row after row; every failure is an InputError.
class ByteImageWriter {
 public:
  virtual ~ByteImageWriter() = default;
  virtual void add(int rows, const std::uint8_t* rgb) = 0;
  /// After the last row: what the operating system could not write shows here at the latest.
  virtual void close() = 0;
};

/// By OpenImageIO. Throws InputError, also when the module is neither in lib/ beside the program's folder nor where it
/// was built.
std::unique_ptr<ImageFile> open_other_format(const std::string& path);

}  // namespace photonproof::inline scenes_images
