// Results of several Google Benchmark programs as one: its JSON merged, and a table of the medians.
#pragma once

#include <string>
#include <vector>

namespace photonproof::inline harness_bench {

struct MicrobenchmarkFile {
  std::string path;
  std::string text;  ///< as --benchmark_out writes it; empty when the filter matched nothing in that program
};

/// One document of the same format: the first program's context, whose `executable` names all of them, and every
/// benchmark, its family_index made unique. Throws InputError for a file that is not such a document, and when no file
/// has a benchmark.
std::string merge_microbenchmarks(const std::vector<MicrobenchmarkFile>& files);

/// A line for each benchmark of a merged document, in the order of their definitions: the median of its repetitions'
/// CPU time and, where it counts items, how many a second. A benchmark called
/// TASK/nanoflann/ARGUMENTS (or nanoflann_sorted, embree_alone, embree_packets) is a peer: others of its task and
/// arguments say how many times as fast as its quickest way they are.
std::string microbenchmark_table(const std::string& merged);

}  // namespace photonproof::inline harness_bench
