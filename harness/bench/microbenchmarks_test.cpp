#include "harness/bench/microbenchmarks.h"

#include <gtest/gtest.h>

#include "scenes/base/input_error.h"

namespace photonproof::inline harness_bench {
namespace {

const MicrobenchmarkFile empty{"none.json", ""};
const MicrobenchmarkFile photons{"photons.json", R"({
  "context": {"date": "2026-01-01", "executable": "bin/bench/photon_bench", "num_cpus": 2},
  "benchmarks": [
    {"name": "look_up/ours/10", "family_index": 0, "run_name": "look_up/ours/10", "run_type": "iteration",
     "repetitions": 3, "cpu_time": 999.0, "time_unit": "us"},
    {"name": "look_up/ours/10_median", "family_index": 0, "run_name": "look_up/ours/10", "run_type": "aggregate",
     "repetitions": 3, "aggregate_name": "median", "cpu_time": 250.0, "time_unit": "us",
     "items_per_second": 4e6},
    {"name": "look_up/nanoflann/10_median", "family_index": 1, "run_name": "look_up/nanoflann/10",
     "run_type": "aggregate", "repetitions": 3, "aggregate_name": "median", "cpu_time": 2.0, "time_unit": "ms"},
    {"name": "look_up/ours_all_threads/10_median", "family_index": 2, "run_name": "look_up/ours_all_threads/10",
     "run_type": "aggregate", "repetitions": 3, "aggregate_name": "median", "cpu_time": 0.1, "time_unit": "ms"}]})"};
const MicrobenchmarkFile film{"film.json", R"({
  "context": {"date": "2026-01-02", "executable": "bin/bench/film_bench", "num_cpus": 2},
  "benchmarks": [{"name": "film", "family_index": 0, "run_name": "film", "run_type": "iteration", "repetitions": 1,
                  "cpu_time": 3.0, "time_unit": "ns"}]})"};

std::string error_of(const std::vector<MicrobenchmarkFile>& files) {
  try {
    merge_microbenchmarks(files);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(microbenchmarks, table_has_medians_and_how_many_times_as_fast_as_the_peer) {
  // 2 ms of nanoflann are 8 times 250 us. A benchmark on all threads is not compared by one thread's time.
  EXPECT_EQ(microbenchmark_table(merge_microbenchmarks({photons, empty, film})),
            "look_up/ours/10                    250 us         4 M/s    8.00 x nanoflann\n"
            "look_up/nanoflann/10                 2 ms\n"
            "look_up/ours_all_threads/10        0.1 ms\n"
            "film                                 3 ns\n");
}

TEST(microbenchmarks, a_peer_is_taken_at_its_best) {
  // Sorted, nanoflann takes 0.5 ms instead of 2, so ours is 2 times as fast, not 8. Its own rows are not compared.
  MicrobenchmarkFile both = photons;
  both.text.insert(both.text.rfind(']'), R"(,
    {"name": "look_up/nanoflann_sorted/10_median", "family_index": 3, "run_name": "look_up/nanoflann_sorted/10",
     "run_type": "aggregate", "repetitions": 3, "aggregate_name": "median", "cpu_time": 0.5, "time_unit": "ms"})");
  const std::string table = microbenchmark_table(merge_microbenchmarks({both}));
  EXPECT_NE(table.find("2.00 x nanoflann\n"), std::string::npos) << table;
  EXPECT_EQ(table.find(" x nanoflann"), table.rfind(" x nanoflann")) << table;
}

TEST(microbenchmarks, merged_document_keeps_the_context_and_every_run_in_families_of_its_own) {
  const std::string merged = merge_microbenchmarks({photons, film});
  EXPECT_NE(merged.find(R"("date": "2026-01-01")"), std::string::npos);
  EXPECT_NE(merged.find(R"("executable": "photon_bench film_bench")"), std::string::npos);
  EXPECT_NE(merged.find(R"("cpu_time": 999.0)"), std::string::npos);
  EXPECT_NE(merged.find(R"("family_index": 3)"), std::string::npos);
  EXPECT_EQ(merge_microbenchmarks({{"merged.json", merged}}).size(), merged.size());
}

TEST(microbenchmarks, nothing_to_merge_and_other_documents_are_errors) {
  EXPECT_EQ(error_of({empty}), "--bench: error: no benchmark has a name that matches");
  EXPECT_EQ(error_of({{"x.json", "{}"}}), "x.json: error: not what a Google Benchmark program writes");
  EXPECT_EQ(error_of({{"x.json", "{\"context\""}}), "x.json: error: not what a Google Benchmark program writes");
}

}  // namespace
}  // namespace photonproof::inline harness_bench
