// A page with the viewer alone, for images of any origin.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scenes/images/image.h"

namespace photonproof::inline reports_page {

struct ViewedImage {
  std::string title;    ///< the file's name
  std::string caption;  ///< a line below it
  Image image;          ///< linear Rec. 709
};

struct ViewerPage {
  std::string title;
  std::vector<ViewedImage> images;            ///< at least one, all of one size of at most `largest_viewed`
  std::optional<std::size_t> reference = {};  ///< the image that signed errors are taken from
  double exposure = 0;                        ///< stops
};

/// Pixels a side.
inline constexpr int largest_viewed = 4096;

/// Replaces `out` as a whole. The page refers to no other file. Larger images are reduced until the page has about 24
/// MB, and the page says so. Throws InputError when it cannot be written.
void write_viewer_page(ViewerPage page, const std::filesystem::path& out);

}  // namespace photonproof::inline reports_page
