// Fuzzes the reading of results.json and of cell.json. Built with libFuzzer (preset fuzz), and run over results_corpus/
// by results_fuzz_test.cpp.
#include "reports/record/results_fuzz.h"

#include "reports/record/results.h"
#include "scenes/base/test_fuzz.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline reports_record {
namespace {

/// A record that was read is written, read again and written with the same text.
template <class Read, class Write>
std::string problem_with_record(const FuzzFolder& folder, const std::string& file, Read read, Write write) {
  const std::string first = (folder.path() / "first.json").string(), second = (folder.path() / "second.json").string();
  try {
    write(first, read(file));
  } catch (const InputError& error) {
    return problem_with_message(error);
  }
  try {
    write(second, read(first));
  } catch (const InputError& error) {
    return "what was written is refused: " + error.summary();
  }
  return read_file(first) == read_file(second) ? "" : "writing twice differs:\n" + read_file(first);
}

}  // namespace

std::string check_results(std::string_view bytes) {
  static const FuzzFolder folder;
  const std::string file = folder.put("results.json", bytes).string();
  std::string problem = problem_with_record(folder, file, read_results, write_results);
  return problem.empty() ? problem_with_record(folder, file, read_result, write_result) : problem;
}

}  // namespace photonproof::inline reports_record

#ifdef PHOTONPROOF_FUZZER
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return photonproof::fuzz_input(photonproof::check_results, data, size);
}
#endif
