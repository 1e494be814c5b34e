// Reads the rows of an image from memory or a file, whole or in part.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "harness/pixels/pixel_region.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_pixels {

class RowSource {
 public:
  virtual ~RowSource() = default;
  virtual int width() const = 0;
  virtual int height() const = 0;
  /// Reads rows [begin, end) as interleaved linear RGB. Quick for rows in ascending order. Throws InputError when the
  /// file cannot be read.
  virtual void read(int begin, int end, float* rgb) = 0;
  /// All rows, if they are in memory in the layout that `read` gives; else null.
  virtual const float* in_memory() const { return nullptr; }
};

/// The image must outlive it.
class ImageRowSource : public RowSource {
 public:
  explicit ImageRowSource(const Image& image) : image_(image) {}
  int width() const override { return image_.width; }
  int height() const override { return image_.height; }
  void read(int begin, int end, float* rgb) override;
  const float* in_memory() const override { return image_.rgb.data(); }

 private:
  const Image& image_;
};

/// Throws InputError as read_image does. The image, of any size, is never in memory as a whole.
class FileSource : public RowSource {
 public:
  explicit FileSource(const std::string& path, const std::string& layer = "", ImageWindow part = ImageWindow::displayed)
      : rows_(path, layer, part) {}
  int width() const override { return rows_.width(); }
  int height() const override { return rows_.height(); }
  void read(int begin, int end, float* rgb) override { rows_.read(begin, end, rgb); }
  const ImageRows& file() const { return rows_; }

 private:
  ImageRows rows_;
};

/// A part of another source, which must outlive it.
class RegionSource : public RowSource {
 public:
  /// Throws InputError, naming --region, when the region is no part of the image.
  RegionSource(RowSource& whole, const PixelRegion& region);
  int width() const override { return region_.width; }
  int height() const override { return region_.height; }
  void read(int begin, int end, float* rgb) override;

 private:
  RowSource& whole_;
  PixelRegion region_;
  std::vector<float> rows_;
};

}  // namespace photonproof::inline harness_pixels
