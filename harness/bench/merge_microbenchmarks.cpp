// merge_microbenchmarks OUT IN...: for ./run --bench; see microbenchmarks.h. Prints the table.

#include <cstdio>
#include <exception>
#include <vector>

#include "harness/bench/microbenchmarks.h"
#include "scenes/files/atomic_file.h"

int main(int argc, char** argv) try {
  using namespace photonproof;
  if (argc < 3) {
    std::fputs("usage: merge_microbenchmarks OUT IN...\n", stderr);
    return 2;
  }
  std::vector<MicrobenchmarkFile> files;
  for (int i = 2; i < argc; ++i) files.push_back({argv[i], read_file(argv[i])});
  const std::string merged = merge_microbenchmarks(files);
  write_file_atomically(argv[1], merged);
  std::fputs(microbenchmark_table(merged).c_str(), stdout);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
