// Fuzzes the reader of suites. Built with libFuzzer (preset fuzz), and run over suite_corpus/ by suite_fuzz_test.cpp.
#include "harness/suites/suite_fuzz.h"

#include "harness/suites/suite.h"
#include "scenes/base/test_fuzz.h"

namespace photonproof::inline harness_suites {

std::string check_suite(std::string_view bytes) {
  static const FuzzFolder folder;
  folder.put("scene.xml", "<scene version=\"3.0.0\"/>");
  const std::filesystem::path file = folder.put("suite.toml", bytes);
  try {
    const Suite suite = read_suite(file);
    for (const Cell& cell : suite.cells)
      if (cell.label().empty()) return "a cell without a label";
  } catch (const InputError& error) {
    return problem_with_message(error);
  }
  return {};
}

}  // namespace photonproof::inline harness_suites

#ifdef PHOTONPROOF_FUZZER
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return photonproof::fuzz_input(photonproof::check_suite, data, size);
}
#endif
