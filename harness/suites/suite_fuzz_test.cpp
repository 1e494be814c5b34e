#include "harness/suites/suite_fuzz.h"

#include "scenes/base/test_corpus.h"

namespace photonproof::inline harness_suites {
namespace {

TEST(suite_fuzz, corpus_gives_messages_or_suites) { check_corpus("suite_corpus", 230, check_suite); }

}  // namespace
}  // namespace photonproof::inline harness_suites
