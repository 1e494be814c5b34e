// Images in formats that our own code does not write, byte by byte. The readers are thus compared with the formats'
// definitions only.
#pragma once

#include <filesystem>

#include "scenes/images/image.h"

namespace photonproof::inline harness_stress {

/// Portable float map: rows from the bottom up, little endian.
void write_pfm(const std::filesystem::path& file, const Image& image);

/// Radiance's (Ward 1991): a common exponent, 8 bits a channel, here without run lengths.
void write_rgbe(const std::filesystem::path& file, const Image& image);

/// PNG of 16 bits a channel (ISO 15948), sRGB, clamped to [0, 1]; zlib's stored blocks hold the rows.
void write_png_of_words(const std::filesystem::path& file, const Image& image);

/// TIFF 6.0 in one strip, not compressed: 16 bits a channel, sRGB, clamped to [0, 1], the more significant byte first.
void write_tiff_of_words(const std::filesystem::path& file, const Image& image);
/// The same with 32-bit floats, the less significant byte first.
void write_tiff_of_floats(const std::filesystem::path& file, const Image& image);

/// The value that 16 bits of sRGB (IEC 61966-2-1) keep of a linear value.
float as_srgb_word(float value);

}  // namespace photonproof::inline harness_stress
