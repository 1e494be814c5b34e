#include "harness/suites/assignment_fuzz.h"

#include "scenes/text/test_corpus.h"

namespace photonproof {
namespace {

TEST(assignment_fuzz, corpus_gives_messages_or_assignments) {
  check_corpus("harness/assignment_corpus", 4, check_assignment);
}

}  // namespace
}  // namespace photonproof
