// Merges the JSON of several Google Benchmark programs and prints a table of the medians.
#pragma once

#include <string>
#include <vector>

namespace photonproof::inline harness_bench {

struct MicrobenchmarkFile {
  std::string path;
  std::string text;  ///< as --benchmark_out writes it; empty when the filter matched nothing in that program
};

/// Merges the documents into one of the same format, with a unique family_index for every benchmark. The context is
/// that of the first program, and its `executable` names all of them. Throws InputError for a file that is not such a
/// document, and when no file has a benchmark.
std::string merge_microbenchmarks(const std::vector<MicrobenchmarkFile>& files);

/// One line for each benchmark of a merged document, in the order of their definitions. It has the median CPU time of
/// the repetitions and, if items are counted, how many a second. A benchmark called TASK/nanoflann/ARGUMENTS (or
/// nanoflann_sorted, embree_alone, embree_packets) is a peer. Others of its task and arguments show how many times as
/// fast as the peer's quickest way they are.
std::string microbenchmark_table(const std::string& merged);

}  // namespace photonproof::inline harness_bench
