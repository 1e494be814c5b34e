#include "scenes/parser/include_fuzz.h"

#include "scenes/base/test_corpus.h"

namespace photonproof::inline scenes_parser {
namespace {

TEST(include_fuzz, corpus_gives_messages_or_scenes_that_survive_writing) {
  check_corpus("include_corpus", 65, check_include);
}

}  // namespace
}  // namespace photonproof::inline scenes_parser
