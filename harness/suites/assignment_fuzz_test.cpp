#include "harness/suites/assignment_fuzz.h"

#include "scenes/base/test_corpus.h"

namespace photonproof::inline harness_suites {
namespace {

TEST(assignment_fuzz, corpus_gives_messages_or_assignments) {
  check_corpus("assignment_corpus", 150, check_assignment);
}

}  // namespace
}  // namespace photonproof::inline harness_suites
