// Images in memory and on disk (image_file.h names the libraries). Linear Rec.709 RGB, row 0 on top, interleaved
// floats.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace photonproof::inline scenes_images {

struct Image {
  int width = 0;
  int height = 0;
  std::vector<float> rgb;  ///< size 3 * width * height

  Image() = default;
  Image(int w, int h) : width(w), height(h), rgb(3 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  std::size_t pixels() const { return rgb.size() / 3; }
  float* pixel(int x, int y) {
    return &rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x))];
  }
  const float* pixel(int x, int y) const { return const_cast<Image*>(this)->pixel(x, y); }
};

/// Place of a stored image in the full one, and the full one's size: EXR's data window in its display window.
struct ImagePlace {
  int x = 0, y = 0, width = 0, height = 0;
  friend bool operator==(const ImagePlace&, const ImagePlace&) = default;
};

/// A rendering: pixel means and, where at least two independent estimates were made, the variance of each mean.
struct Rendering {
  Image mean;
  std::optional<Image> variance;
  std::map<std::string, std::string> metadata;  ///< String attributes stored in the EXR header.
  std::vector<float> alpha{};                   ///< A of each pixel (written, never read). Empty: none.
  std::optional<ImagePlace> place{};            ///< These pixels' part of the image. Empty: all of it.
};

/// The pixels to read of a file whose data window is a part of its display window. Either the displayed image, black
/// where nothing is stored, or the stored part alone. Stored pixels outside the display window are never read.
enum class ImageWindow { displayed, stored };

/// Reads any format OpenImageIO supports as linear RGB: EXR and other float formats unchanged, 8- and 16-bit formats
/// decoded from sRGB. One-channel images become grey; alpha is ignored. Of several layers or parts choose_colour takes
/// one, or the one named `layer`. Beside plain R, G, B the channels variance.R/G/B fill Rendering::variance. Throws
/// InputError when the file is missing, not an image, larger than 2^28 pixels, or has no colour or several to choose
/// from. With ImageWindow::stored the result also has its place.
Rendering read_rendering(const std::string& path, const std::string& layer = "",
                         ImageWindow part = ImageWindow::displayed);
/// The whole image of a rendering that is a part, black around it.
Rendering displayed(const Rendering& part);
inline Image read_image(const std::string& path) { return read_rendering(path).mean; }

/// The same colours a few rows at a time, for images that do not fit into memory: up to 2^18 columns and 2^32 pixels.
class ImageRows {
 public:
  /// Throws InputError as read_rendering does.
  explicit ImageRows(const std::string& path, const std::string& layer = "", ImageWindow part = ImageWindow::displayed);
  ~ImageRows();
  ImageRows(ImageRows&&) noexcept;
  int width() const;
  int height() const;
  const std::string& layer() const;  ///< The layer that is read; empty where the file has plain R, G, B.
  /// Properties of the file other than plain linear RGB, in words: its layer, decoding, windows. Mostly empty.
  const std::vector<std::string>& remarks() const;
  /// The place of the stored part; empty where that is the whole image.
  std::optional<ImagePlace> place() const;
  /// Reads rows [begin, end) into 3 * width * (end - begin) floats. Rows are quickest in ascending order. Throws
  /// InputError when they cannot be read.
  void read(int begin, int end, float* rgb);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The colour of such a file for use as a texture; `raw` takes 8- and 16-bit samples as numbers from 0 to 1 instead of
/// decoding them. Throws InputError also when a value is negative or not finite.
Image read_texture_image(const std::string& path, bool raw);

/// Sample type of the channels R,G,B of an EXR; variances are always 32-bit floats.
enum class ExrColour { single, half };

/// 32-bit float EXR with channels R,G,B, variance.R,G,B and A. It is written beside the target and renamed, so a file
/// under the final name is always whole. Throws InputError when it cannot be written.
void write_exr(const std::string& path, const Rendering& rendering, ExrColour colour = ExrColour::single);

/// An 8-bit RGB PNG written a few rows at a time; without finish() there is no file.
class PngRows {
 public:
  /// Throws InputError when it cannot be written.
  PngRows(const std::string& path, int width, int height);
  ~PngRows();
  PngRows(PngRows&&) noexcept;
  /// The next rows: 3 * width * count sRGB bytes.
  void add(int count, const std::uint8_t* rgb);
  /// Call after the last row: it gives the file its name.
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// 8-bit sRGB PNG of 2^exposure * image, clamped to [0,1]; the same atomic rename.
void write_png(const std::string& path, const Image& image, double exposure = 0);

}  // namespace photonproof::inline scenes_images
