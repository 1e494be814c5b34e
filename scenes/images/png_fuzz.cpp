// Fuzzes the reader of PNG files. Built with libFuzzer (preset fuzz), and run over png_corpus/ by image_fuzz_test.cpp.
#include "scenes/images/png_fuzz.h"

#include "scenes/base/test_fuzz.h"
#include "scenes/images/png_file.h"
#include "scenes/images/test_image_promises.h"

namespace photonproof::inline scenes_images {

std::string check_png(std::string_view bytes) {
  static const FuzzFolder folder;
  const std::string file = folder.put("image.png", bytes).string();
  return is_png(file) ? problem_with_image(file) : "";  // others are another library's to read
}

}  // namespace photonproof::inline scenes_images

#ifdef PHOTONPROOF_FUZZER
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return photonproof::fuzz_input(photonproof::check_png, data, size);
}
#endif
