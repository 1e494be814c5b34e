#include "harness/submissions/image_decoder.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <fstream>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "harness/submissions/plain_bmp_file.h"
#include "scenes/base/input_error.h"
#include "scenes/base/size_text.h"
#include "scenes/images/display_window.h"
#include "scenes/images/exr_file.h"
#include "scenes/images/image_file.h"
#include "scenes/images/netpbm_file.h"
#include "scenes/images/png_file.h"

namespace photonproof::inline harness_submissions {
namespace {

namespace fs = std::filesystem;
using namespace std::string_view_literals;

struct Start {
  SubmittedFormat format;
  std::string_view bytes;
};
constexpr std::array starts{Start{SubmittedFormat::exr, "\x76\x2f\x31\x01"sv},
                            Start{SubmittedFormat::pfm, "PF"sv},
                            Start{SubmittedFormat::pfm, "Pf"sv},
                            Start{SubmittedFormat::hdr, "#?RADIANCE"sv},
                            Start{SubmittedFormat::hdr, "#?RGBE"sv},
                            Start{SubmittedFormat::png, "\x89PNG\r\n\x1a\n"sv},
                            Start{SubmittedFormat::bmp, "BM"sv},
                            Start{SubmittedFormat::ppm, "P3"sv},
                            Start{SubmittedFormat::ppm, "P6"sv}};

// TGA has no magic number, so this tests whether its header is possible.
bool may_be_tga(std::string_view start) {
  if (start.size() < 18) return false;
  const auto byte = [start](std::size_t i) { return static_cast<unsigned char>(start[i]); };
  constexpr std::array kinds{1, 2, 3, 9, 10, 11};
  constexpr std::array depths{8, 15, 16, 24, 32};
  return byte(1) <= 1 && std::ranges::count(kinds, byte(2)) != 0 && std::ranges::count(depths, byte(16)) != 0;
}

std::optional<SubmittedFormat> format_of(std::string_view start) {
  for (const Start& row : starts)
    if (start.starts_with(row.bytes)) return row.format;
  if (may_be_tga(start)) return SubmittedFormat::tga;
  return std::nullopt;
}

std::string in_capitals(SubmittedFormat format) {
  std::string name = name_of(format);
  for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return name;
}

[[noreturn]] void refuse(const std::string& what) { throw InputError("the image", what); }

// Indices of red, green and blue.
std::array<int, 3> colour_of(const std::vector<std::string>& channels) {
  const auto place = [&channels](const char* name) {
    return static_cast<int>(std::ranges::find(channels, name) - channels.begin());
  };
  const int count = static_cast<int>(channels.size());
  const std::array<int, 3> rgb{place("R"), place("G"), place("B")};
  if (std::ranges::max(rgb) < count) return rgb;
  if (count <= 2 && count > 0) return {0, 0, 0};  // grey, possibly with alpha
  refuse("has no channels R, G and B");
}

std::unique_ptr<ImageFile> open_submitted(const std::string& path, SubmittedFormat format) {
  if (format == SubmittedFormat::exr) return as_displayed(open_exr(path), path);
  if (format == SubmittedFormat::ppm || format == SubmittedFormat::pfm) return open_netpbm(path);
  if (format == SubmittedFormat::png) return open_png(path);
  if (format == SubmittedFormat::bmp)
    if (std::unique_ptr<ImageFile> plain = open_plain_bmp(path)) return plain;
  return open_other_format(path);
}

void copy_pixels(ImageFile& in, const std::array<int, 3>& colour, std::ofstream& out) {
  const ImageHeader& header = in.header();
  const std::size_t stride = header.channels.size(), row = stride * static_cast<std::size_t>(header.width);
  const int together = std::max(1, header.rows_together);
  std::vector<float> values, rgb;
  for (int y = 0; y < header.height; y += together) {
    const int end = std::min(header.height, y + together);
    values.resize(row * static_cast<std::size_t>(end - y));
    in.read(y, end, 0, static_cast<int>(stride), values.data());
    rgb.clear();
    for (std::size_t pixel = 0; pixel < values.size(); pixel += stride)
      for (const int channel : colour) rgb.push_back(values[pixel + static_cast<std::size_t>(channel)]);
    static_assert(std::endian::native == std::endian::little);
    out.write(reinterpret_cast<const char*>(rgb.data()), static_cast<std::streamsize>(rgb.size() * sizeof(float)));
  }
}

}  // namespace

std::string what_is_wrong_with_start(const fs::path& file, SubmittedFormat format) {
  std::string start(32, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(in.gcount()));
  const auto found = format_of(start);
  if (found == format) return {};
  if (!found || *found == SubmittedFormat::tga) return "is no " + in_capitals(format) + " file";
  return "is a " + in_capitals(*found) + " file, not " + in_capitals(format);
}

void decode_image(const fs::path& file, SubmittedFormat format, int width, int height, const fs::path& pixels) {
  if (const std::string wrong = what_is_wrong_with_start(file, format); !wrong.empty()) refuse(wrong);
  try {
    const std::unique_ptr<ImageFile> in = open_submitted(file.string(), format);
    const ImageHeader& header = in->header();
    if (header.width != width || header.height != height)
      refuse("is " + size_text(header.width, header.height) + ", not " + size_text(width, height));
    constexpr std::size_t most_channels = 64;
    if (header.channels.size() > most_channels) refuse("has more than " + std::to_string(most_channels) + " channels");
    std::ofstream out(pixels, std::ios::binary);
    copy_pixels(*in, colour_of(header.channels), out);
    if (!out.flush()) throw InputError(pixels.string(), "cannot be written");
  } catch (const InputError& error) {
    // Removes our own path, which the file's author does not know.
    const std::string ours = file.string() + ": error: ", text = error.summary();
    if (!text.starts_with(ours)) throw;
    refuse(text.substr(ours.size()));
  }
}

}  // namespace photonproof::inline harness_submissions
