// The path tracer on three scenes with stored references by bdpt. Right images of 2 to 8 seeds are judged as by the
// gates and as by bench. PHOTONPROOF_NULL_IMAGES=400 renders more images than ctest does; the table goes to
// reports/published/null.md.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <span>

#include "harness/bench/correctness.h"
#include "harness/gates/gate_images.h"
#include "harness/gates/gate_look.h"
#include "harness/suites/engines.h"
#include "scenes/files/scratch_folder.h"

namespace photonproof::inline harness_bench {
namespace {

namespace fs = std::filesystem;

constexpr double alpha = 0.05;

std::size_t asked_images() {
  const char* asked = std::getenv("PHOTONPROOF_NULL_IMAGES");
  return asked != nullptr ? static_cast<std::size_t>(std::atoi(asked)) : 16;
}

/// One scene of the library at 64 x 64, the path tracer at 16 samples a pixel.
GateSuite suite_of(const std::string& scene) {
  GateSuite suite;
  suite.engines = builtin_engines();
  suite.limits.seconds = 60;
  suite.limits.threads = 1;
  SuiteScene row;
  row.name = scene;
  row.path = fs::path(PHOTONPROOF_SOURCE_DIR) / "scenes/library" / scene / "scene.xml";
  row.width = row.height = 64;
  suite.scenes.push_back(row);
  Gate gate;
  gate.scene = scene;
  gate.engine = "path";
  gate.budget = {"spp", 16};
  gate.metric = agreement_metric;
  gate.bound = right_within;
  gate.block_bound = right_within_in_a_block;
  gate.alpha = alpha;
  gate.looks = 1;
  suite.gates.push_back(gate);
  return suite;
}

std::vector<Image> drawn_images(const GateSuite& suite, const StoredReference& reference, std::size_t count) {
  DrawOptions options;
  options.program = PHOTONPROOF_BINARY;
  const ScratchFolder folder("null-scenes-test");
  options.folder = folder.path();
  options.processes = 2;
  ImageStream stream(suite, suite.gates[0], {reference.provenance.scene_hash, "null"}, reference.provenance.seeds,
                     options);
  EXPECT_TRUE(stream.draw(count));
  EXPECT_EQ(stream.failed(), nullptr);
  std::vector<Image> images;
  for (const auto& drawn : stream.drawn()) images.push_back(drawn->image);
  return images;
}

struct NullCount {
  int runs = 0, failed = 0, passed = 0, biased = 0;
};

/// Verdicts on disjoint groups of `seeds` images.
NullCount judged(const GateSuite& suite, const StoredReference& reference, std::span<const Image> images,
                 std::size_t seeds) {
  NullCount count;
  const Gate& gate = suite.gates[0];
  for (std::size_t first = 0; first + seeds <= images.size(); first += seeds) {
    const auto group = images.subspan(first, seeds);
    ++count.runs;
    const CorrectnessRecord record =
        judge_correctness({&reference, "", nullptr}, suite.engine(gate.engine), gate.budget, group);
    count.biased += record.verdict == Correctness::biased ? 1 : 0;
    if (seeds < std::size_t{least_images}) {
      EXPECT_EQ(record.verdict, Correctness::unknown);
      continue;
    }
    std::vector<const Image*> pointers;
    for (const Image& image : group) pointers.push_back(&image);
    const auto verdict = look_at(gate, reference, {}, pointers).verdict;
    count.failed += verdict == GateVerdict::fail ? 1 : 0;
    count.passed += verdict == GateVerdict::pass ? 1 : 0;
  }
  return count;
}

TEST(null_scenes, a_right_engine_fails_no_more_often_than_alpha_by_any_number_of_seeds) {
  std::printf("| scene | 2 seeds | 3 | 4 | 5 | 6 | 7 | 8 |\n|---|--:|--:|--:|--:|--:|--:|--:|\n");
  for (const char* scene : {"cornell", "course-1", "cornell-spheres"}) {
    const GateSuite suite = suite_of(scene);
    const StoredReference reference = load_reference(suite.scenes[0].path, 64, 64);
    const std::vector<Image> images = drawn_images(suite, reference, asked_images());
    std::string row = std::string("| ") + scene + " |";
    for (std::size_t seeds = 2; seeds <= 8; ++seeds) {
      const NullCount count = judged(suite, reference, images, seeds);
      row += seeds < std::size_t{least_images}
                 ? " unknown |"
                 : " " + std::to_string(count.failed) + " / " + std::to_string(count.passed) + " of " +
                       std::to_string(count.runs) + " |";
      EXPECT_LE(count.failed, count.runs * alpha + 3 * std::sqrt(count.runs * alpha * (1 - alpha)))
          << scene << ", " << seeds << " seeds";
      EXPECT_EQ(count.biased, 0) << scene << ", " << seeds << " seeds";  // at correctness_alpha
    }
    std::printf("%s\n", row.c_str());
  }
}

}  // namespace
}  // namespace photonproof::inline harness_bench
