// Fuzzes the reader of assignments. Built with libFuzzer (preset fuzz), and run over assignment_corpus/ by
// assignment_fuzz_test.cpp.
#include "harness/suites/assignment_fuzz.h"

#include "harness/grading/assignment.h"
#include "scenes/base/test_fuzz.h"

namespace photonproof::inline harness_suites {

std::string check_assignment(std::string_view bytes) {
  static const FuzzFolder folder;
  folder.put("scene.xml", "<scene version=\"3.0.0\"/>");
  const std::filesystem::path file = folder.put("assignment.toml", bytes);
  try {
    const Assignment assignment = read_assignment(file);
    for (const AssignmentScene& scene : assignment.scenes)
      if (scene.width <= 0 || scene.height <= 0) return "a scene without pixels";
  } catch (const InputError& error) {
    return problem_with_message(error);
  }
  return {};
}

}  // namespace photonproof::inline harness_suites

#ifdef PHOTONPROOF_FUZZER
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return photonproof::fuzz_input(photonproof::check_assignment, data, size);
}
#endif
