#include "harness/suites/assignment_fuzz.h"

#include "scenes/text/test_corpus.h"

namespace photonproof {
namespace {

TEST(assignment_fuzz, corpus_gives_messages_or_assignments) {
  check_corpus("assignment_corpus", 150, check_assignment);
}

}  // namespace
}  // namespace photonproof
