// photonproof reference as a user and a machine that fails treat it.

#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>

#include "harness/cells/test_program.h"
#include "reference/store/reference_store.h"
#include "scenes/base/process.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_verbs {
namespace {

namespace fs = std::filesystem;

const std::string library = PHOTONPROOF_SOURCE_DIR "/scenes/library/";

class ReferenceVerb : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    use_cache("cache");
    copy_scene("cornell");
  }
  /// A copy, so that what --commit writes goes to the test's folder.
  void copy_scene(const std::string& name) {
    fs::copy_file(library + name + "/scene.xml", folder_ / "scene.xml", fs::copy_options::overwrite_existing);
    fs::copy_file(library + name + "/expect.toml", folder_ / "expect.toml", fs::copy_options::overwrite_existing);
  }
  void use_cache(const std::string& name) const { setenv("PHOTONPROOF_CACHE", path(name).c_str(), 1); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::vector<std::string> argv(const std::vector<std::string>& more) const {
    std::vector<std::string> all{PHOTONPROOF_BINARY, "reference", path("scene.xml")};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  ProcessOutcome reference(const std::vector<std::string>& more) const {
    return run_process(argv(more), {.wall_limit_seconds = 600});
  }
  /// Sends the signal `seconds` after the program has kept `batches` more (or as many trial batches).
  int signalled(int signal_number, int batches, double seconds, const std::vector<std::string>& more) const {
    const pid_t pid = start_program(argv(more), path("stderr"));
    return signal_after(pid, signal_number, batches, seconds, [this] { return newest_kept(); });
  }
  fs::file_time_type newest_kept() const {
    fs::file_time_type newest = fs::file_time_type::min();
    std::error_code gone;
    fs::recursive_directory_iterator at(std::getenv("PHOTONPROOF_CACHE"), gone), end;
    for (; at != end; at.increment(gone)) {
      const std::string name = at->path().filename().string();
      if (name != "batches" && name != "cell.json") continue;
      const auto time = at->last_write_time(gone);
      if (!gone) newest = std::max(newest, time);
    }
    return newest;
  }
};

TEST_F(ReferenceVerb, that_is_committed_has_two_parents_and_the_power_of_their_test) {
  const ProcessOutcome made = reference({"--size", "32x32", "--standard-error", "0.02", "--commit"});
  ASSERT_TRUE(made.ok()) << made.standard_error;
  EXPECT_NE(made.standard_output.find("second estimator: bdpt, "), std::string::npos) << made.standard_output;
  const fs::path file = committed_reference_path(folder_ / "scene.xml", 32, 32);
  const Provenance provenance = parse_provenance(read_file(provenance_path(file)), "reference");
  EXPECT_EQ(provenance.estimator, "path");
  ASSERT_TRUE(provenance.witness.has_value());
  EXPECT_EQ(provenance.witness->estimator, "bdpt");
  EXPECT_LT(provenance.witness->would_see.value(), 0.03);
}

TEST_F(ReferenceVerb, folder_of_the_output_is_made) {
  const ProcessOutcome made =
      reference({"--size", "4x4", "--standard-error", "0.2", "--quiet", "-o", path("new/deep/out.exr")});
  EXPECT_TRUE(made.ok());
  EXPECT_EQ(made.standard_error, "");
  EXPECT_TRUE(has("new/deep/out.exr"));
}

TEST_F(ReferenceVerb, without_a_witness_has_one_parent) {
  ASSERT_TRUE(reference({"--size", "8x8", "--standard-error", "0.1", "--commit", "--no-witness"}).ok());
  const fs::path file = committed_reference_path(folder_ / "scene.xml", 8, 8);
  EXPECT_FALSE(parse_provenance(read_file(provenance_path(file)), "reference").witness);
}

TEST_F(ReferenceVerb, killed_and_run_again_gives_the_pixels_of_a_run_never_stopped) {
  const std::vector<std::string> options{"--size", "8x8", "--standard-error", "0.1", "--integrator", "bdpt"};
  const auto with_output = [&](const std::string& name) {
    std::vector<std::string> all = options;
    all.insert(all.end(), {"-o", path(name)});
    return all;
  };
  const ProcessOutcome whole = reference(with_output("whole.exr"));
  ASSERT_TRUE(whole.ok()) << whole.standard_error;
  use_cache("other");
  int kills = 0;
  for (; kills < 100; ++kills) {
    // A golden-ratio sequence of moments: in the trial, in a batch, between two, at another number of threads.
    const double moment = 0.3 * std::fmod(0.618 * kills, 1.0);
    std::vector<std::string> now = with_output("killed.exr");
    now.insert(now.end(), {"--threads", std::to_string(1 + kills % 2)});
    const int status = signalled(SIGKILL, 1 + 3 * kills, moment, now);
    if (!WIFEXITED(status)) continue;
    ASSERT_EQ(WEXITSTATUS(status), 0) << get("stderr");
    break;
  }
  std::printf("%d kills\n", kills);
  EXPECT_GE(kills, 2) << "nothing was tested";
  EXPECT_TRUE(get("killed.exr") == get("whole.exr"));
  const Rendering a = read_rendering(path("killed.exr")), b = read_rendering(path("whole.exr"));
  EXPECT_TRUE(a.mean.rgb == b.mean.rgb);
  EXPECT_TRUE(a.variance->rgb == b.variance->rgb);
}

TEST_F(ReferenceVerb, interrupted_keeps_what_is_finished_and_goes_on) {
  const std::vector<std::string> options{"--size", "32x32", "--standard-error", "0.0005"};
  const int status = signalled(SIGINT, 2, 0.1, options);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_EQ(get("stderr").find("interrupted: kept "), 0u) << get("stderr");
  EXPECT_NE(get("stderr").find("the same command continues"), std::string::npos);
}

TEST_F(ReferenceVerb, reference_of_a_scene_with_a_crop_is_that_part_of_the_film) {
  // In the furnace every pixel is 2. Were the black around the crop counted, the standard error of a quarter of the
  // pixels would be stated as half of what it is.
  copy_scene("furnace");
  std::string scene = get("scene.xml");
  scene.insert(scene.find("</film>"),
               "<integer name='crop_offset_x' value='12'/><integer name='crop_offset_y' value='8'/>"
               "<integer name='crop_width' value='24'/><integer name='crop_height' value='16'/>");
  put("scene.xml", scene);
  const ProcessOutcome outcome = reference({"--standard-error", "0.02", "-o", path("out.exr")});
  ASSERT_TRUE(outcome.ok()) << outcome.standard_error;
  const Rendering r = read_rendering(path("out.exr"), "", ImageWindow::stored);
  ASSERT_EQ(r.mean.width, 24);
  ASSERT_EQ(r.mean.height, 16);
  ASSERT_TRUE(r.place.has_value());
  EXPECT_EQ(r.place->x, 12);
  EXPECT_EQ(r.place->y, 8);
  double sum = 0;
  for (const float v : r.mean.rgb) sum += (v - 2.0) * (v - 2.0) / (2.0 * 2.0 + 0.01);
  const double actual = std::sqrt(sum / static_cast<double>(r.mean.rgb.size()));
  // 384 pixels with 31 degrees of freedom each: a deviation of 7.3 % of the square.
  EXPECT_NEAR(actual / relative_standard_error(r), 1, 0.15);
  const Provenance stated = parse_provenance(get("out.json"), "out.json");
  EXPECT_EQ(stated.width, r.place->width);
  EXPECT_EQ(stated.standard_error, relative_standard_error(r));
  // Reading it for comparison gives the part that is rendered, in its place.
  const Rendering read = load_reference(folder_ / "scene.xml", stated.width, stated.height).rendering;
  EXPECT_EQ(read.mean.rgb, r.mean.rgb);
  EXPECT_EQ(read.place, r.place);
  // The cache's is used again.
  EXPECT_TRUE(reference({"--standard-error", "0.02", "-o", path("again.exr")}).ok());
  EXPECT_EQ(get("again.exr"), get("out.exr"));
}

TEST_F(ReferenceVerb, standard_error_that_it_states_is_the_error_it_has) {
  // In the furnace every pixel is 2, so the relative error of 4096 pixels (grey: three channels are one) is known. Its
  // mean square over the stated one is 1. Its deviation is sqrt((2 + 2/31) / 4096) = 2.2 %. The 2 stands for the
  // pixels' errors, 2/31 for their variances out of 32 batches. 4 deviations of the square are 4.5 % of the root.
  copy_scene("furnace");
  const ProcessOutcome outcome = reference({"--size", "64x64", "--standard-error", "0.01", "-o", path("out.exr")});
  ASSERT_TRUE(outcome.ok()) << outcome.standard_error;
  const Rendering r = read_rendering(path("out.exr"));
  double sum = 0;
  for (const float v : r.mean.rgb) sum += (v - 2.0) * (v - 2.0) / (2.0 * 2.0 + 0.01);
  const double actual = std::sqrt(sum / static_cast<double>(r.mean.rgb.size()));
  EXPECT_NEAR(actual / relative_standard_error(r), 1, 0.045);
  EXPECT_LE(relative_standard_error(r), 0.01);
}

// A progressive photon mapper states both parts of its error, and the truth is within three times of both. The test
// detects a bias that is not estimated, or one that is stated where there is none.
TEST_F(ReferenceVerb, of_the_photon_mapper_states_its_bias_beside_its_standard_error) {
  const ProcessOutcome made = reference(
      {"--size", "64x64", "--standard-error", "0.03", "--integrator", "photonmapper", "-o", path("photons.exr")});
  ASSERT_TRUE(made.ok()) << made.standard_error;
  const Provenance stated = parse_provenance(get("photons.json"), "photons.json");
  EXPECT_EQ(stated.estimator, "photonmapper");
  EXPECT_GT(stated.bias, 0.001);
  EXPECT_LT(stated.bias, 0.045);
  ASSERT_TRUE(
      reference({"--size", "64x64", "--standard-error", "0.01", "--integrator", "path", "-o", path("path.exr")}).ok());
  EXPECT_EQ(parse_provenance(get("path.json"), "path.json").bias, 0);
  const Image truth = read_image(path("path.exr")), image = read_image(path("photons.exr"));
  double sum = 0;
  for (std::size_t i = 0; i < truth.rgb.size(); ++i) {
    const double difference = double{image.rgb[i]} - double{truth.rgb[i]};
    sum += difference * difference / (double{truth.rgb[i]} * double{truth.rgb[i]} + 0.01);
  }
  const double error = std::sqrt(sum / static_cast<double>(truth.rgb.size()));
  std::printf("stated: bias %.4f, standard error %.4f; from path tracing %.4f\n", stated.bias, stated.standard_error,
              error);
  EXPECT_LT(error, 3 * std::hypot(stated.bias, stated.standard_error, 0.01));
}

TEST_F(ReferenceVerb, what_the_cache_has_is_not_rendered_again_and_serves_the_committed_one) {
  const ProcessOutcome first = reference({"--size", "8x8", "--standard-error", "0.05"});
  ASSERT_TRUE(first.ok()) << first.standard_error;
  const StoredReference cached = load_reference(folder_ / "scene.xml", 8, 8);
  EXPECT_EQ(cached.provenance.estimator, "path");
  EXPECT_GE(cached.provenance.seeds.size(), 32u);

  const ProcessOutcome second = reference({"--size", "8x8", "--standard-error", "0.05", "--commit"});
  ASSERT_TRUE(second.ok()) << second.standard_error;
  const StoredReference committed = load_reference(folder_ / "scene.xml", 8, 8);
  EXPECT_EQ(committed.file, folder_ / "reference-8x8.exr");
  EXPECT_EQ(committed.provenance.seeds, cached.provenance.seeds);
  EXPECT_EQ(committed.provenance.date, cached.provenance.date);

  // More certain than the cache's: the batches there are go on being used, and a reason is asked for.
  const double asked = 0.7 * cached.provenance.standard_error;
  const std::vector<std::string> options{"--size", "8x8", "--standard-error", std::to_string(asked), "--commit"};
  const ProcessOutcome third = reference(options);
  EXPECT_EQ(third.exit_code, 2);
  EXPECT_NE(third.standard_error.find("say why it is replaced with --reason TEXT"), std::string::npos);
  std::vector<std::string> with_reason = options;
  with_reason.insert(with_reason.end(), {"--reason", "more certain"});
  ASSERT_TRUE(reference(with_reason).ok());
  const StoredReference better = load_reference(folder_ / "scene.xml", 8, 8);
  EXPECT_EQ(std::vector(better.provenance.seeds.begin(), better.provenance.seeds.begin() + 32),
            std::vector(cached.provenance.seeds.begin(), cached.provenance.seeds.begin() + 32));
  EXPECT_GT(better.provenance.seeds.size(), 32u);
  // Half floats add at most 2^-11 of the value.
  EXPECT_LT(better.provenance.standard_error, asked + 0x1p-11);
}

TEST_F(ReferenceVerb, what_is_committed_is_not_rendered_again_unless_it_is_too_uncertain_or_not_wanted) {
  ASSERT_TRUE(reference({"--size", "8x8", "--standard-error", "0.05", "--commit"}).ok());
  const StoredReference committed = load_reference(folder_ / "scene.xml", 8, 8);
  const fs::path cached = cached_reference_folder(committed.provenance.scene_hash, 8, 8);
  const auto renders = [&](std::vector<std::string> more) {
    fs::remove_all(cached);
    more.insert(more.end(), {"--size", "8x8", "-o", path("out.exr")});
    EXPECT_TRUE(reference(more).ok());
    return fs::exists(cached / "reference.exr");
  };
  EXPECT_FALSE(renders({"--standard-error", "0.06"}));
  EXPECT_EQ(read_image(path("out.exr")).rgb, committed.rendering.mean.rgb);
  EXPECT_TRUE(renders({"--standard-error", std::to_string(0.8 * committed.provenance.standard_error)}));
  EXPECT_TRUE(renders({"--standard-error", "0.06", "--fresh"}));
  EXPECT_TRUE(renders({"--standard-error", "0.06", "--integrator", "bdpt"}));
}

// In the furnace L = emission / (1 - albedo): 2 as the scene is, 3 / (1 - 0.75) = 12 with these definitions. The mean
// of the image's 64 grey pixels is certain to the standard error asked for over 8; five of those are 3.2 %.
TEST_F(ReferenceVerb, definitions_make_another_reference_with_a_place_of_its_own) {
  copy_scene("furnace");
  const auto made = [&](const std::vector<std::string>& definitions) {
    std::vector<std::string> options{"--size", "8x8", "--standard-error", "0.05", "-o", path("out.exr")};
    options.insert(options.end(), definitions.begin(), definitions.end());
    const ProcessOutcome outcome = reference(options);
    EXPECT_TRUE(outcome.ok()) << outcome.standard_error;
    return parse_provenance(get("out.json"), "out.json");
  };
  const auto mean = [&] {
    const Image image = read_image(path("out.exr"));
    double sum = 0;
    for (const float value : image.rgb) sum += double{value};
    return sum / static_cast<double>(image.rgb.size());
  };
  const Provenance plain = made({});
  EXPECT_NEAR(mean() / 2, 1, 0.032);
  EXPECT_TRUE(plain.definitions.empty());
  const Provenance defined = made({"-D", "emission=3", "-D", "albedo=0.75"});
  EXPECT_NEAR(mean() / 12, 1, 0.032);
  EXPECT_EQ(defined.definitions, (std::vector<std::string>{"albedo=0.75", "emission=3"}));
  EXPECT_NE(defined.scene_hash, plain.scene_hash);
  // Both are kept, whatever the order of the definitions: nothing is rendered again. The scene's own reference is the
  // one without.
  const fs::path cached = cached_reference_folder(defined.scene_hash, 8, 8) / "reference.exr";
  const fs::file_time_type written = fs::last_write_time(cached);
  fs::remove(path("out.exr"));
  EXPECT_EQ(made({"-D", "albedo=0.75", "-D", "emission=3"}), defined);
  EXPECT_NEAR(mean() / 12, 1, 0.032);
  EXPECT_EQ(fs::last_write_time(cached), written);
  EXPECT_EQ(load_reference(folder_ / "scene.xml", 8, 8).provenance, plain);
}

TEST_F(ReferenceVerb, definitions_are_refused_where_they_cannot_hold) {
  copy_scene("furnace");
  const ProcessOutcome committed = reference({"-D", "albedo=0.75", "--size", "8x8", "--commit"});
  EXPECT_EQ(committed.exit_code, 2);
  EXPECT_EQ(committed.standard_error,
            "--commit: error: is for the scene as it is, without -D; the cache keeps this reference, or -o FILE\n");
  EXPECT_EQ(reference({"--as-mitsuba", "--size", "8x8", "--commit"}).standard_error,
            "--commit: error: is for the scene as it is, without --as-mitsuba; the cache keeps this reference, or -o "
            "FILE\n");
  EXPECT_FALSE(has("reference-8x8.exr"));
  EXPECT_EQ(reference({"-D", "albedo"}).standard_error,
            "-D: error: 'albedo' is not a definition, expected name=value\n");
  EXPECT_EQ(reference({"-D", "albdo=0.75"}).exit_code, 2);
}

TEST_F(ReferenceVerb, time_that_is_over_is_said_and_never_passes_for_done) {
  const ProcessOutcome few = reference({"--size", "32x32", "--standard-error", "1e-4", "--seconds", "0.01"});
  EXPECT_EQ(few.exit_code, 1);
  EXPECT_EQ(few.standard_error.find("time ran out: kept "), 0u) << few.standard_error;
  EXPECT_NE(input_error_of([&] { load_reference(folder_ / "scene.xml", 32, 32); }).find("has no reference"),
            std::string::npos);
}

TEST_F(ReferenceVerb, bad_options_are_refused) {
  EXPECT_EQ(reference({"--integrator", "sppm"}).exit_code, 2);
  EXPECT_EQ(reference({"--standard-error", "nan"}).exit_code, 2);
  EXPECT_EQ(reference({"--reason", "why"}).standard_error, "--reason: error: is for --commit\n");
  EXPECT_EQ(reference({"-o", "a.png"}).standard_error,
            "--output: error: 'a.png' is not the name of an EXR, expected NAME.exr\n");
  copy_scene("fog");
  const ProcessOutcome fog = reference({"--integrator", "path", "--size", "8x8"});
  EXPECT_EQ(fog.exit_code, 2);
  EXPECT_NE(fog.standard_error.find("volpath"), std::string::npos) << fog.standard_error;
}

TEST_F(ReferenceVerb, what_cannot_be_committed_is_refused_before_it_is_rendered) {
  const ProcessOutcome large = reference({"--size", "257x256", "--commit"});
  EXPECT_EQ(large.exit_code, 2);
  EXPECT_NE(large.standard_error.find("a reference of 257x256 pixels is too large to be committed"), std::string::npos)
      << large.standard_error;
  const ProcessOutcome over = reference({"--size", "8x8", "-o", path("reference-8x8.exr")});
  EXPECT_EQ(over.exit_code, 2);
  EXPECT_NE(over.standard_error.find("is the scene's committed reference, which it would replace"), std::string::npos)
      << over.standard_error;
  EXPECT_FALSE(has("cache"));  // nothing was rendered
}

}  // namespace
}  // namespace photonproof::inline harness_verbs
