#include "renderer/sensor/checkpoint_fuzz.h"

#include "scenes/base/test_corpus.h"

namespace photonproof::inline renderer_sensor {
namespace {

TEST(checkpoint_fuzz, corpus_gives_messages_or_states_that_are_written_as_they_were) {
  check_corpus("checkpoint_corpus", 24, check_checkpoint);
}

}  // namespace
}  // namespace photonproof::inline renderer_sensor
