#include "harness/submissions/submitted_image.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "harness/sandbox/sandbox.h"
#include "harness/submissions/image_decoder.h"
#include "scenes/base/input_error.h"
#include "scenes/base/utf8.h"
#include "scenes/files/scratch_folder.h"

namespace photonproof::inline harness_submissions {
namespace {

namespace fs = std::filesystem;

// Empty for a regular file that is not empty.
std::string what_is_wrong_with_file(const fs::path& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return errno == ELOOP ? "is a symbolic link, not a file" : "was not written";
  struct stat about {};
  const bool known = fstat(descriptor, &about) == 0;
  close(descriptor);
  if (!known || !S_ISREG(about.st_mode)) return "is no regular file";
  return about.st_size == 0 ? "is empty" : "";
}

SandboxOutcome decode_in_sandbox(const fs::path& file, const ImageDeclaration& declaration, const fs::path& program,
                                 const fs::path& pixels, const Handling& handling) {
  constexpr const char* inside = "/decoder";
  const std::string extension = std::string(".") + name_of(declaration.format);
  const fs::path image_inside = inside + ("/image" + extension);
  const fs::path whole_program = fs::canonical(program);
  const fs::path libraries = whole_program.parent_path().parent_path() / "lib";
  SandboxOptions options;
  options.contained = handling.contained;
  options.interrupt = handling.interrupt;
  options.mounts = {{whole_program, fs::path(inside) / "bin/photonproof"}, {fs::canonical(file), image_inside}};
  const fs::path module = libraries / "photonproof_image_formats.so";
  if (fs::exists(module)) options.mounts.push_back({module, fs::path(inside) / "lib" / module.filename()});
  const std::uint64_t bytes = 3 * sizeof(float) * static_cast<std::uint64_t>(declaration.width) *
                              static_cast<std::uint64_t>(declaration.height);
  options.limits.file_bytes = bytes + 1;
  options.limits.disk_bytes = bytes + (std::uint64_t{4} << 20);
  options.limits.memory_bytes = (std::uint64_t{1} << 30) + 8 * bytes;
  options.limits.processes = 256;  // OpenEXR and OpenImageIO start a thread for each core
  options.collect = "pixels";
  options.collect_to = pixels;
  const fs::path seen_program = handling.contained ? fs::path(inside) / "bin/photonproof" : whole_program;
  const fs::path seen_image = handling.contained ? image_inside : fs::canonical(file);
  return run_sandboxed(
      {seen_program.string(), "decode-image", seen_image.string(), "pixels", "--format", name_of(declaration.format),
       "--width", std::to_string(declaration.width), "--height", std::to_string(declaration.height)},
      options);
}

// The message of the decoder's InputError about "the image".
std::string decoders_complaint(const SandboxOutcome& outcome) {
  constexpr std::string_view start = "the image: error: ";
  const std::string message = last_line(outcome.process.standard_error);
  if (message.starts_with(start)) return printable(message.substr(start.size()));
  return "cannot be decoded: the decoder " + outcome.sentence() + (message.empty() ? "" : ": " + printable(message));
}

Image read_pixels(const fs::path& file, int width, int height) {
  Image image(width, height);
  std::ifstream in(file, std::ios::binary);
  const auto bytes = static_cast<std::streamsize>(image.rgb.size() * sizeof(float));
  in.read(reinterpret_cast<char*>(image.rgb.data()), bytes);
  if (in.gcount() != bytes || in.peek() != std::ifstream::traits_type::eof())
    throw InputError(file.string(), "has not as many numbers as the image");
  return image;
}

std::string what_is_not_finite(const Image& image) {
  std::size_t count = 0, first = 0;
  for (std::size_t pixel = 0; pixel < image.pixels(); ++pixel) {
    const float* rgb = &image.rgb[3 * pixel];
    if (std::isfinite(rgb[0]) && std::isfinite(rgb[1]) && std::isfinite(rgb[2])) continue;
    if (count++ == 0) first = pixel;
  }
  if (count == 0) return {};
  const auto width = static_cast<std::size_t>(image.width);
  const std::string place = "(" + std::to_string(first % width) + ", " + std::to_string(first / width) + ")";
  if (count == 1) return "has a pixel that is not finite (NaN or infinite), " + place;
  return "has " + std::to_string(count) + " pixels that are not finite (NaN or infinite), the first is " + place;
}

double linear_of(double value, const Transfer& transfer) {
  switch (transfer.kind) {
    case Transfer::Kind::linear:
      break;
    case Transfer::Kind::srgb:  // an odd function, so that values below black stay there
      return std::copysign(
          std::abs(value) <= 0.04045 ? std::abs(value) / 12.92 : std::pow((std::abs(value) + 0.055) / 1.055, 2.4),
          value);
    case Transfer::Kind::gamma:
      return std::copysign(std::pow(std::abs(value), transfer.gamma), value);
  }
  return value;
}

}  // namespace

void undo_declaration(Image& image, const ImageDeclaration& declaration) {
  for (float& value : image.rgb)
    value = static_cast<float>(linear_of(static_cast<double>(value), declaration.transfer) / declaration.scale);
  if (!declaration.bottom_up) return;
  const auto row = 3 * static_cast<std::ptrdiff_t>(image.width);
  for (std::ptrdiff_t low = 0, high = image.height - 1; low < high; ++low, --high)
    std::swap_ranges(image.rgb.begin() + low * row, image.rgb.begin() + (low + 1) * row,
                     image.rgb.begin() + high * row);
}

SubmittedImage read_submitted_image(const fs::path& file, const std::string& shown_name,
                                    const ImageDeclaration& declaration, const fs::path& program,
                                    const Handling& handling) {
  const auto refused = [&shown_name](const std::string& why) { return SubmittedImage{{}, shown_name + " " + why}; };
  if (const std::string wrong = what_is_wrong_with_file(file); !wrong.empty()) return refused(wrong);
  if (const std::string wrong = what_is_wrong_with_start(file, declaration.format); !wrong.empty())
    return refused(wrong);
  const ScratchFolder scratch("decode");
  const fs::path pixels = scratch.path() / "pixels";
  const SandboxOutcome outcome = decode_in_sandbox(file, declaration, program, pixels, handling);
  if (outcome.process.end == ProcessOutcome::End::not_started)
    throw InputError(program.string(), "cannot decode images: " + outcome.sentence());
  if (!outcome.ok() || !outcome.collected) return refused(decoders_complaint(outcome));
  SubmittedImage result{read_pixels(pixels, declaration.width, declaration.height), {}};
  if (const std::string wrong = what_is_not_finite(*result.image); !wrong.empty()) return refused(wrong);
  undo_declaration(*result.image, declaration);
  return result;
}

}  // namespace photonproof::inline harness_submissions
