#include "reports/picture.h"

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "reports/temporary_folder.h"
#include "reports/text.h"
#include "scenes/atomic_file.h"
#include "scenes/image.h"
#include "scenes/input_error.h"

namespace photonproof::reports {
namespace {

namespace fs = std::filesystem;

constexpr int max_side = 4096;
constexpr std::size_t max_file_bytes = std::size_t{64} << 20;

struct File {
  fs::path path;
  std::string bytes;
  int width = 0, height = 0;
  std::string problem;
};

bool is_inside(const fs::path& folder, const fs::path& file) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

std::uint32_t big_endian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (const char c : bytes.substr(0, 4)) value = value << 8 | static_cast<unsigned char>(c);
  return value;
}

/// Fills in the size from the IHDR chunk, which PNG puts first: 8 bytes signature, length, type, width, height.
void read_png_header(File& file, const std::string& name) {
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

File load(const fs::path& folder, const std::string& relative) {
  File file;
  if (relative.empty()) {
    file.problem = "no picture was made";
    return file;
  }
  try {
    std::error_code error;
    const fs::path root = fs::canonical(folder, error);
    file.path = fs::canonical(root / relative, error);
    if (error) {
      file.problem = relative + " is missing";
    } else if (fs::path(relative).is_absolute() || !is_inside(root, file.path)) {
      file.problem = relative + " lies outside the results folder";
    } else {
      file.bytes = read_file(file.path, max_file_bytes);
      read_png_header(file, relative);
    }
  } catch (const InputError&) {
    file.problem = relative + " cannot be read";
  }
  return file;
}

EmbeddedPicture embed(const File& file) {
  if (!file.problem.empty()) return {{}, 0, 0, file.problem};
  return {"data:image/png;base64," + base64(file.bytes), file.width, file.height, {}};
}

/// Averages blocks of factor x factor pixels; what is left over at the right and bottom edge joins smaller blocks.
Image reduced(const Image& image, int factor) {
  Image out((image.width + factor - 1) / factor, (image.height + factor - 1) / factor);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const int x_end = std::min(image.width, (x + 1) * factor), y_end = std::min(image.height, (y + 1) * factor);
      double sum[3] = {0, 0, 0};
      for (int v = y * factor; v < y_end; ++v) {
        for (int u = x * factor; u < x_end; ++u) {
          for (int c = 0; c < 3; ++c) sum[c] += image.pixel(u, v)[c];
        }
      }
      const double count = static_cast<double>(x_end - x * factor) * (y_end - y * factor);
      for (int c = 0; c < 3; ++c) out.pixel(x, y)[c] = static_cast<float>(sum[c] / count);
    }
  }
  return out;
}

}  // namespace

EmbeddedPicture embed_picture(const fs::path& folder, const std::string& relative) {
  return embed(load(folder, relative));
}

EmbeddedPicture embed_thumbnail(const fs::path& folder, const std::string& relative, int longest_side) {
  File file = load(folder, relative);
  const int side = std::max(file.width, file.height);
  if (!file.problem.empty() || side <= longest_side) return embed(file);
  try {
    const TemporaryFolder temporary;
    const std::string small = (temporary.path() / "thumbnail.png").string();
    write_png(small, reduced(read_image(file.path.string()), (side + longest_side - 1) / longest_side));
    file.bytes = read_file(small);
    read_png_header(file, relative);
  } catch (const InputError&) {
    file.problem = relative + " cannot be decoded";
  }
  return embed(file);
}

}  // namespace photonproof::reports
