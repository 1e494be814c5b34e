// Reads PNGs of a results folder, and embeds them as data URIs, so that a page needs no other file.
#pragma once

#include <filesystem>
#include <string>

namespace photonproof::reports::inline reports_page {

struct EmbeddedPicture {
  std::string uri;            ///< "data:image/png;base64,...", or empty when there is a problem
  int width = 0, height = 0;  ///< pixels
  std::string problem;        ///< one sentence, empty on success
  bool reduced = false;       ///< a smaller copy of the file's picture
};

struct PictureBytes {
  std::string bytes;  ///< of a PNG's file
  int width = 0, height = 0;
  std::string problem;
  bool reduced = false;
};

/// The picture of `embed_thumbnail` as the bytes of a file.
PictureBytes read_thumbnail(const std::filesystem::path& folder, const std::string& relative, int longest_side);

/// `relative` comes from results.json and is not trusted: it must name a PNG inside `folder`, of at most 4096 pixels a
/// side. The picture is reduced by a whole factor (area average of linear light) until no side is longer than
/// `longest_side`. A picture that cannot be shown is a problem to print, not an error.
EmbeddedPicture embed_thumbnail(const std::filesystem::path& folder, const std::string& relative, int longest_side);

}  // namespace photonproof::reports::inline reports_page
