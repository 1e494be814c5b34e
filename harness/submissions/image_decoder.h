// Decodes one untrusted image file to plain numbers. Runs inside the sandbox, by the hidden verb `decode-image`, so
// that a hostile file can harm only the sandbox.
#pragma once

#include <filesystem>
#include <string>

#include "harness/submissions/image_declaration.h"

namespace photonproof::inline harness_submissions {

/// Empty when the file's first bytes are those of the format, else "is no BMP file" or "is a PNG file, not BMP".
std::string what_is_wrong_with_start(const std::filesystem::path& file, SubmittedFormat format);

/// Writes width * height * 3 little-endian floats to `pixels`, the format's upper row first, with the file's numbers
/// (8- and 16-bit ones from 0 to 1). Checks size and channels before decoding. Throws InputError, whose message is a
/// sentence about "the image".
void decode_image(const std::filesystem::path& file, SubmittedFormat format, int width, int height,
                  const std::filesystem::path& pixels);

}  // namespace photonproof::inline harness_submissions
