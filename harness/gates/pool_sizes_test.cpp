#include "harness/gates/pool_sizes.h"

#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_gates {
namespace {

TEST(PoolSizes, are_the_first_that_is_named_for_a_stream_or_the_usual_one) {
  const PoolSizes sizes = read_pool_sizes("--pool", {"photonmapper=160", "400", "roughness/path=20", "path=30"}, 64);
  EXPECT_EQ(sizes.of("cornell/photonmapper/spp=16"), 160);
  EXPECT_EQ(sizes.of("roughness/path/spp=256"), 20);
  EXPECT_EQ(sizes.of("cornell/path/spp=16"), 30);
  EXPECT_EQ(sizes.of("mist/volpath/spp=64"), 30);  // matches a part of the name
  EXPECT_EQ(sizes.of("cornell/bdpt/spp=16"), 400);
  EXPECT_EQ(read_pool_sizes("--pool", {"spp=16=5"}, 64).of("cornell/bdpt/spp=16"), 5);
  EXPECT_EQ(read_pool_sizes("--pool", {}, 64).of("cornell/bdpt/spp=16"), 64);
}

TEST(PoolSizes, refuse_what_is_no_number_of_images) {
  for (const char* text : {"", "many", "path=", "=4", "1", "path=1", "4.5", "2000000", "4 "}) {
    const std::string error = input_error_of([&] { read_pool_sizes("--pool", {text}, 64); });
    EXPECT_NE(error.find("--pool: error: is '" + std::string(text) + "', expected a number of images"),
              std::string::npos)
        << error;
  }
}

}  // namespace
}  // namespace photonproof::inline harness_gates
