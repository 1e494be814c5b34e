#include "scenes/parser/include_fuzz.h"

#include "scenes/text/test_corpus.h"

namespace photonproof {
namespace {

TEST(include_fuzz, corpus_gives_messages_or_scenes_that_survive_writing) {
  check_corpus("include_corpus", 65, check_include);
}

}  // namespace
}  // namespace photonproof
