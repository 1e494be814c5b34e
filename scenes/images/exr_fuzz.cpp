// Fuzzes the reader of EXR files. Built with libFuzzer (preset fuzz), and run over exr_corpus/ by image_fuzz_test.cpp.
#include "scenes/images/exr_fuzz.h"

#include "scenes/base/test_fuzz.h"
#include "scenes/images/exr_file.h"
#include "scenes/images/test_image_promises.h"

namespace photonproof::inline scenes_images {

std::string check_exr(std::string_view bytes) {
  static const FuzzFolder folder;
  const std::string file = folder.put("image.exr", bytes).string();
  return is_exr(file) ? problem_with_image(file) : "";  // others are another library's to read
}

}  // namespace photonproof::inline scenes_images

#ifdef PHOTONPROOF_FUZZER
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return photonproof::fuzz_input(photonproof::check_exr, data, size);
}
#endif
