#include "scenes/base/test_corpus.h"
#include "scenes/images/exr_fuzz.h"
#include "scenes/images/png_fuzz.h"

namespace photonproof::inline scenes_images {
namespace {

TEST(image_fuzz, exr_corpus_gives_messages_or_rows_that_stay) { check_corpus("exr_corpus", 44, check_exr); }

TEST(image_fuzz, png_corpus_gives_messages_or_rows_that_stay) { check_corpus("png_corpus", 19, check_png); }

}  // namespace
}  // namespace photonproof::inline scenes_images
