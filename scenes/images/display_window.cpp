#include "scenes/images/display_window.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "scenes/base/input_error.h"

namespace photonproof::inline scenes_images {
namespace {

class DisplayWindow : public ImageFile {
 public:
  explicit DisplayWindow(std::unique_ptr<ImageFile> stored) : stored_(std::move(stored)), header_(stored_->header()) {
    header_.width = header_.display_width;
    header_.height = header_.display_height;
    header_.x = header_.y = header_.rows_together = 0;
  }

  const ImageHeader& header() const override { return header_; }

  void read(int begin, int end, int first, int count, float* values) override {
    const ImageHeader& stored = stored_->header();
    const auto channels = static_cast<std::size_t>(count);
    const std::size_t row = channels * static_cast<std::size_t>(header_.width);
    std::fill(values, values + row * static_cast<std::size_t>(end - begin), 0.0f);
    const int x_begin = std::max(0, stored.x), x_end = std::min(header_.width, stored.x + stored.width);
    for (int y = std::max(begin, stored.y); y < std::min(end, stored.y + stored.height); ++y) {
      const float* from =
          stored_row(y - stored.y, first, count) + channels * static_cast<std::size_t>(x_begin - stored.x);
      float* to = values + row * static_cast<std::size_t>(y - begin) + channels * static_cast<std::size_t>(x_begin);
      std::copy(from, from + channels * static_cast<std::size_t>(x_end - x_begin), to);
    }
  }

 private:
  const float* stored_row(int y, int first, int count) {
    const ImageHeader& stored = stored_->header();
    const std::size_t row = static_cast<std::size_t>(count) * static_cast<std::size_t>(stored.width);
    if (y < begin_ || y >= end_ || first != first_ || count != count_) {
      const int together = std::max(1, stored.rows_together);
      begin_ = y / together * together;
      end_ = std::min(stored.height, begin_ + together);
      first_ = first;
      count_ = count;
      rows_.resize(row * static_cast<std::size_t>(end_ - begin_));
      stored_->read(begin_, end_, first, count, rows_.data());
    }
    return rows_.data() + row * static_cast<std::size_t>(y - begin_);
  }

  std::unique_ptr<ImageFile> stored_;
  ImageHeader header_;
  std::vector<float> rows_;  // those read last: [begin_, end_) of channels from first_ on
  int begin_ = 0, end_ = 0, first_ = 0, count_ = 0;
};

}  // namespace

std::unique_ptr<ImageFile> as_displayed(std::unique_ptr<ImageFile> file, const std::string& path) {
  const ImageHeader& h = file->header();
  if (h.x == 0 && h.y == 0 && h.width == h.display_width && h.height == h.display_height) return file;
  const auto meets = [](std::int64_t place, int size, int display) { return place < display && place + size > 0; };
  if (!meets(h.x, h.width, h.display_width) || !meets(h.y, h.height, h.display_height))
    throw InputError(path, "no pixel of its data window lies in its display window");
  return std::make_unique<DisplayWindow>(std::move(file));
}

}  // namespace photonproof::inline scenes_images
