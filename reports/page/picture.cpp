#include "reports/page/picture.h"

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "reports/page/reduced_image.h"
#include "reports/view/results_file.h"
#include "reports/view/temporary_folder.h"
#include "reports/view/text.h"
#include "scenes/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "scenes/images/image.h"

namespace photonproof::reports::inline reports_page {
namespace {

namespace fs = std::filesystem;

constexpr int max_side = 4096;
constexpr std::size_t max_file_bytes = std::size_t{64} << 20;

std::uint32_t big_endian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (const char c : bytes.substr(0, 4)) value = value << 8 | static_cast<unsigned char>(c);
  return value;
}

/// Fills in the size from the IHDR chunk, which PNG puts first: 8 bytes signature, length, type, width, height.
void read_png_header(PictureBytes& file, const std::string& name) {
  using namespace std::string_view_literals;
  const std::string_view bytes = file.bytes;
  if (!bytes.starts_with("\x89PNG\r\n\x1a\n\0\0\0\rIHDR"sv) || bytes.size() < 24) {
    file.problem = name + " is not a PNG";
    return;
  }
  const std::uint32_t width = big_endian(bytes.substr(16)), height = big_endian(bytes.substr(20));
  if (width == 0 || height == 0 || width > max_side || height > max_side) {
    file.problem = name + " is too large to show";
    return;
  }
  file.width = static_cast<int>(width);
  file.height = static_cast<int>(height);
}

PictureBytes read_picture(const ResultsFile& found, const std::string& relative) {
  PictureBytes file;
  file.problem = found.problem;
  if (!file.problem.empty()) return file;
  try {
    file.bytes = read_file(found.path, max_file_bytes);
    read_png_header(file, relative);
  } catch (const InputError&) {
    file.problem = relative + " cannot be read";
  }
  return file;
}

}  // namespace

PictureBytes read_thumbnail(const fs::path& folder, const std::string& relative, int longest_side) {
  const ResultsFile found = results_file(folder, relative);
  PictureBytes picture = read_picture(found, relative);
  const int side = std::max(picture.width, picture.height);
  if (!picture.problem.empty() || side <= longest_side) return picture;
  try {
    const TemporaryFolder temporary;
    const std::string small = (temporary.path() / "thumbnail.png").string();
    write_png(small, reduced_image(read_image(found.path.string()), (side + longest_side - 1) / longest_side));
    picture.bytes = read_file(small);
    read_png_header(picture, relative);
  } catch (const InputError&) {
    picture.problem = relative + " cannot be decoded";
  }
  picture.reduced = true;
  return picture;
}

EmbeddedPicture embed_thumbnail(const fs::path& folder, const std::string& relative, int longest_side) {
  const PictureBytes read = read_thumbnail(folder, relative, longest_side);
  if (!read.problem.empty()) return {{}, 0, 0, read.problem, read.reduced};
  return {"data:image/png;base64," + base64(read.bytes), read.width, read.height, {}, read.reduced};
}

}  // namespace photonproof::reports::inline reports_page
