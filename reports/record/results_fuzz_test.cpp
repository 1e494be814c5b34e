#include "reports/record/results_fuzz.h"

#include "scenes/base/test_corpus.h"

namespace photonproof::inline reports_record {
namespace {

TEST(results_fuzz, corpus_gives_messages_or_records_that_are_written_as_they_were) {
  check_corpus("results_corpus", 190, check_results);
}

}  // namespace
}  // namespace photonproof::inline reports_record
