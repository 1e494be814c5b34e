// The corpus of the fuzzer of pbrt scenes as an ordinary test, so that every build checks past findings.
#include "scenes/pbrt/pbrt_fuzz.h"

#include "scenes/base/test_corpus.h"

namespace photonproof::inline scenes_pbrt {
namespace {

TEST(pbrt_fuzz, corpus_gives_messages_or_scenes) { check_corpus("pbrt_corpus", 20, check_pbrt); }

}  // namespace
}  // namespace photonproof::inline scenes_pbrt
