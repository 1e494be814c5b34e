#include "harness/stress/other_formats.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "scenes/files/atomic_file.h"

namespace photonproof::inline harness_stress {
namespace {

namespace fs = std::filesystem;

/// The low `bytes` bytes of n, in either order.
std::string number(std::uint64_t n, int bytes, bool big_endian) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(n >> (8 * i));
  if (big_endian) std::reverse(text.begin(), text.end());
  return text;
}

std::uint16_t srgb_word(float value) {
  const double v = std::clamp(double{value}, 0.0, 1.0);
  return static_cast<std::uint16_t>(
      std::lround(65535 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055)));
}

/// CRC-32 and Adler-32, bit by bit as ISO 15948 and RFC 1950 define them.
std::uint32_t crc_of(const std::string& text) {
  std::uint32_t crc = 0xffffffffu;
  for (const char c : text) {
    crc ^= static_cast<std::uint8_t>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xedb88320u : 0);
  }
  return ~crc;
}

std::uint32_t adler_of(const std::string& text) {
  std::uint32_t a = 1, b = 0;
  for (const char c : text) {
    a = (a + static_cast<std::uint8_t>(c)) % 65521;
    b = (b + a) % 65521;
  }
  return b << 16 | a;
}

std::string png_chunk(const std::string& kind, const std::string& content) {
  return number(content.size(), 4, true) + kind + content + number(crc_of(kind + content), 4, true);
}

std::string stored_by_zlib(const std::string& text) {
  constexpr std::size_t most = 65535;
  std::string out = "\x78\x01";
  for (std::size_t at = 0; at < text.size(); at += most) {
    const std::size_t size = std::min(most, text.size() - at);
    out += at + size == text.size() ? '\1' : '\0';
    out += number(size, 2, false) + number(~size, 2, false) + text.substr(at, size);
  }
  return out + number(adler_of(text), 4, true);
}

/// Tag, type, count, and the value or its offset.
struct TiffEntry {
  int tag, type;
  std::uint64_t count, value;
};
constexpr int tiff_short = 3, tiff_long = 4;

void write_tiff(const fs::path& file, const Image& image, const std::string& samples, int bits, int sample_format,
                bool big_endian) {
  const auto n = [=](std::uint64_t value, int bytes) { return number(value, bytes, big_endian); };
  const std::uint64_t width = static_cast<std::uint64_t>(image.width),
                      height = static_cast<std::uint64_t>(image.height);
  const std::size_t at_bits = 8, at_formats = 14, at_samples = 20, at_entries = at_samples + samples.size();
  const std::vector<TiffEntry> entries{{256, tiff_long, 1, width},      {257, tiff_long, 1, height},
                                       {258, tiff_short, 3, at_bits},   {259, tiff_short, 1, 1},  // not compressed
                                       {262, tiff_short, 1, 2},                                   // RGB
                                       {273, tiff_long, 1, at_samples}, {277, tiff_short, 1, 3},
                                       {278, tiff_long, 1, height},     {279, tiff_long, 1, samples.size()},
                                       {284, tiff_short, 1, 1},         {339, tiff_short, 3, at_formats}};
  std::string text = (big_endian ? "MM" : "II") + n(42, 2) + n(at_entries, 4);
  for (int c = 0; c < 3; ++c) text += n(static_cast<std::uint64_t>(bits), 2);
  for (int c = 0; c < 3; ++c) text += n(static_cast<std::uint64_t>(sample_format), 2);
  text += samples + n(entries.size(), 2);
  for (const TiffEntry& entry : entries) {
    text += n(static_cast<std::uint64_t>(entry.tag), 2) + n(static_cast<std::uint64_t>(entry.type), 2);
    text += n(entry.count, 4);
    // A single short stands first in its four bytes.
    text += entry.type == tiff_short && entry.count == 1 ? n(entry.value, 2) + n(0, 2) : n(entry.value, 4);
  }
  write_file_atomically(file, text + n(0, 4));
}

}  // namespace

void write_pfm(const fs::path& file, const Image& image) {
  std::string text = "PF\n" + std::to_string(image.width) + " " + std::to_string(image.height) + "\n-1.0\n";
  for (int y = image.height; y-- > 0;) {
    const auto* row = reinterpret_cast<const char*>(image.pixel(0, y));
    text.append(row, 3 * sizeof(float) * static_cast<std::size_t>(image.width));
  }
  write_file_atomically(file, text);
}

void write_rgbe(const fs::path& file, const Image& image) {
  std::string text = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(image.height) + " +X " +
                     std::to_string(image.width) + "\n";
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    const float largest = std::max({image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]});
    int exponent = 0;
    std::frexp(largest, &exponent);
    const bool is_held = largest > 0 && exponent > -128;
    for (std::size_t c = 0; c < 3; ++c)
      text += static_cast<char>(is_held ? static_cast<int>(std::ldexp(double{image.rgb[i + c]}, 8 - exponent)) : 0);
    text += static_cast<char>(is_held ? exponent + 128 : 0);
  }
  write_file_atomically(file, text);
}

void write_png_of_words(const fs::path& file, const Image& image) {
  std::string rows;
  const std::size_t in_row = 3 * static_cast<std::size_t>(image.width);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    if (i % in_row == 0) rows += '\0';  // not filtered
    rows += number(srgb_word(image.rgb[i]), 2, true);
  }
  const std::string header = number(static_cast<std::uint64_t>(image.width), 4, true) +
                             number(static_cast<std::uint64_t>(image.height), 4, true) +
                             std::string("\x10\x02\0\0\0", 5);  // 16 bits, RGB, not interlaced
  write_file_atomically(file, "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) +
                                  png_chunk("IDAT", stored_by_zlib(rows)) + png_chunk("IEND", ""));
}

void write_tiff_of_words(const fs::path& file, const Image& image) {
  std::string samples;
  for (const float v : image.rgb) samples += number(srgb_word(v), 2, true);
  write_tiff(file, image, samples, 16, 1, true);
}

void write_tiff_of_floats(const fs::path& file, const Image& image) {
  std::string samples;
  for (const float v : image.rgb) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &v, sizeof v);
    samples += number(bits, 4, false);
  }
  write_tiff(file, image, samples, 32, 3, false);
}

float as_srgb_word(float value) {
  const double v = srgb_word(value) / 65535.0;
  return static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
}

}  // namespace photonproof::inline harness_stress
