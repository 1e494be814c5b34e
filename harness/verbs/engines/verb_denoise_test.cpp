// photonproof render --denoise as a user meets it: files, stats, exit codes and messages, by the fake library
// (renderer/denoising/test_fake_oidn.cpp). Images are compared as bytes.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "scenes/base/process.h"
#include "scenes/files/test_folder.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_verbs_engines {
namespace {

using testing::HasSubstr;

const std::string fake = std::string("PHOTONPROOF_OIDN=") + PHOTONPROOF_FAKE_OIDN + "/whole";

class DenoiseVerb : public FolderTest {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  ProcessOutcome run(const std::vector<std::string>& variables, const std::vector<std::string>& arguments) const {
    std::vector<std::string> words{"env", "-u", "PHOTONPROOF_OIDN"};
    words.insert(words.end(), variables.begin(), variables.end());
    words.emplace_back(PHOTONPROOF_BINARY);
    words.insert(words.end(), arguments.begin(), arguments.end());
    return run_process(words, {.wall_limit_seconds = 120});
  }
  ProcessOutcome render(const std::vector<std::string>& variables, const std::vector<std::string>& more) const {
    std::vector<std::string> words{"render", PHOTONPROOF_SOURCE_DIR "/scenes/library/cornell/scene.xml",
                                   "-o",     path("a.exr"),
                                   "--size", "16x16",
                                   "--spp",  "4"};
    words.insert(words.end(), more.begin(), more.end());
    return run(variables, words);
  }
  nlohmann::json stats() const { return nlohmann::json::parse(get("a.stats.json")); }
};

TEST_F(DenoiseVerb, image_loses_its_variance_and_the_stats_say_by_what) {
  ASSERT_TRUE(render({fake}, {}).ok());
  EXPECT_TRUE(stats().at("denoised").is_null());
  const Rendering plain = read_rendering(path("a.exr"));
  ASSERT_TRUE(plain.variance);

  const ProcessOutcome outcome = render({fake}, {"--denoise"});
  ASSERT_TRUE(outcome.ok()) << outcome.standard_error;
  EXPECT_THAT(outcome.standard_output, HasSubstr("denoised by Open Image Denoise 2.3.4 in "));
  const Rendering filtered = read_rendering(path("a.exr"));
  EXPECT_FALSE(filtered.variance);
  EXPECT_NE(filtered.mean.rgb, plain.mean.rgb);
  EXPECT_THAT(get("a.exr"), HasSubstr("Open Image Denoise 2.3.4, biased"));
  EXPECT_THAT(get("a.exr"), HasSubstr("--spp 4 --denoise"));
  const nlohmann::json denoised = stats().at("denoised");
  EXPECT_EQ(denoised.at("library"), "Open Image Denoise");
  EXPECT_EQ(denoised.at("version"), "2.3.4");
  EXPECT_EQ(denoised.at("biased"), true);
  EXPECT_GT(denoised.at("seconds"), 0);
  EXPECT_EQ(stats().at("phases").at("denoise"), denoised.at("seconds"));
  EXPECT_EQ(denoised.at("guides").at("images"), nlohmann::json({"albedo", "normal"}));
}

TEST_F(DenoiseVerb, bytes_do_not_depend_on_threads) {
  ASSERT_TRUE(render({fake}, {"--denoise", "--threads", "1"}).ok());
  const std::string one = get("a.exr");
  for (const char* threads : {"2", "7"}) {
    ASSERT_TRUE(render({fake, "FAKE_OIDN_RECORD=" + path("calls")}, {"--denoise", "--threads", threads}).ok());
    EXPECT_EQ(get("a.exr"), one) << threads;
    EXPECT_THAT(get("calls"), HasSubstr("numThreads " + std::string(threads) + "\n"));
  }
}

TEST_F(DenoiseVerb, missing_library_is_one_error_before_anything_is_rendered) {
  const std::string nowhere = "PHOTONPROOF_OIDN=" + folder_.string();
  for (const char* how : {"--quiet", "--plan"}) {
    const ProcessOutcome outcome = render({nowhere}, {"--denoise", how});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.standard_error,
              "--denoise: error: there is no libOpenImageDenoise.so.2 in '" + folder_.string() +
                  "'; `harness/setup/denoiser.sh` installs it and prints the folder for PHOTONPROOF_OIDN, and some "
                  "systems have a package libopenimagedenoise\n");
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
  EXPECT_TRUE(render({nowhere}, {}).ok());  // which needs none
}

TEST_F(DenoiseVerb, failure_writes_the_image_as_it_was_rendered) {
  ASSERT_TRUE(render({}, {}).ok());
  const std::string plain = get("a.exr");
  const ProcessOutcome outcome = render({fake, "FAKE_OIDN=memory"}, {"--denoise"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.standard_error, path("a.exr") + ": not denoised: Open Image Denoise: out of memory\n");
  EXPECT_EQ(get("a.exr"), plain);
  EXPECT_TRUE(stats().at("denoised").is_null());
  EXPECT_EQ(stats().at("interrupted"), false);
}

TEST_F(DenoiseVerb, plan_names_it) {
  const ProcessOutcome outcome = render({fake}, {"--denoise", "--plan"});
  EXPECT_TRUE(outcome.ok());
  EXPECT_THAT(outcome.standard_output,
              HasSubstr("Open Image Denoise 2.3.4, guided by albedo and normals: biased, without a variance layer\n"));
  EXPECT_EQ(render({}, {"--plan"}).standard_output.find("denoiser"), std::string::npos);
}

TEST_F(DenoiseVerb, memory_that_it_needs_is_checked_with_the_film_s) {
  const auto megabytes = [&](const char* option) {
    const std::string limited = "ulimit -v 8000000; exec " PHOTONPROOF_BINARY " render " PHOTONPROOF_SOURCE_DIR
                                "/scenes/library/cornell/scene.xml --size 16384x16384 --spp 1 -o " +
                                path("b.exr") + " " + option;
    const std::string text =
        run_process({"env", fake, "sh", "-c", limited}, {.wall_limit_seconds = 120}).standard_error;
    const std::string before = "pixels takes ";
    const std::size_t at = text.find(before);
    EXPECT_NE(at, std::string::npos) << text;
    return at == std::string::npos ? 0 : std::stol(text.substr(at + before.size()));
  };
  // 2^28 pixels: guides, input and output are 48 bytes each. The library takes 16 MB, and 580 bytes for each of the
  // 2160^2 pixels of its largest tile: 2580 MB.
  EXPECT_EQ(megabytes("--denoise"), megabytes("--quiet") + 48 * 256 + 16 + 2580);
}

TEST_F(DenoiseVerb, version_of_the_library_is_printed_for_engines) {
  const ProcessOutcome found = run({fake}, {"denoiser"});
  EXPECT_EQ(found.exit_code, 0);
  EXPECT_EQ(found.standard_output, "Open Image Denoise 2.3.4\n");
  const ProcessOutcome missing = run({"PHOTONPROOF_OIDN=" + path("none")}, {"denoiser"});
  EXPECT_EQ(missing.exit_code, 3);
  EXPECT_THAT(missing.standard_error, HasSubstr("--denoise: error: there is no file '"));
}

// The whole way of an [[engine]] row: command, version, title, the image's mark, and a gate of one image.
TEST_F(DenoiseVerb, engine_that_denoises_is_measured_and_marked) {
  put("s.toml", R"(name = 's'
title = 'Denoised'
[[engine]]
name = 'smooth'
title = 'path tracer'
command = ['{photonproof}', 'render', '{scene}', '-o', '{output}', '--stats', '{stats}', '--size', '{width}x{height}',
  '--seed', '{seed}', '--threads', '{threads}', '{budget}']
versions = [['{photonproof}', '--version']]
budgets = ['spp']
trust = 'biased'
denoise = true
[[scene]]
name = 'cornell'
path = ')" PHOTONPROOF_SOURCE_DIR R"(/scenes/library/cornell/scene.xml'
width = 16
height = 16
reference = {engine = 'path', budget = 'spp=16', seed = 9}
[[run]]
engine = 'smooth'
budgets = ['spp=4']
seeds = [1]
)");
  const ProcessOutcome outcome = run({fake}, {"bench", path("s.toml"), "-o", path("out")});
  ASSERT_TRUE(outcome.ok()) << outcome.standard_error;
  const std::string results = get("out/results.json");
  EXPECT_THAT(results, HasSubstr("path tracer (denoised, biased)"));
  EXPECT_THAT(results, HasSubstr(" + Open Image Denoise 2.3.4"));
  EXPECT_THAT(results, HasSubstr("denoised by Open Image Denoise 2.3.4, which is biased"));
  EXPECT_THAT(get("out/report.html"), HasSubstr("path tracer (denoised, biased)"));
  const ProcessOutcome without = run({"PHOTONPROOF_OIDN=" + path("none")}, {"bench", path("s.toml"), "-o", path("w")});
  EXPECT_THAT(get("w/results.json"), HasSubstr("\"unsupported\"")) << without.standard_error;
}

}  // namespace
}  // namespace photonproof::inline harness_verbs_engines
