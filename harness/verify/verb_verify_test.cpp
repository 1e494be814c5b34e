#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <future>
#include <iterator>
#include <utility>

#include "harness/cells/test_program.h"
#include "harness/verify/test_verify_folder.h"
#include "reference/store/reference_store.h"

namespace photonproof::inline harness_verify {
namespace {

namespace fs = std::filesystem;

class VerbVerify : public VerifyTest {
 protected:
  const std::string sound = PHOTONPROOF_BINARY;
  const std::vector<std::string> exact{"--engine", "path", "--engine", "bdpt", "--engine", "volpath"};

  void SetUp() override {
    VerifyTest::SetUp();
    put_scene(walls(diffuse("0.5")) + light());
    setenv("PHOTONPROOF_CACHE", path("cache").c_str(), 1);
  }
  void TearDown() override {
    unsetenv("PHOTONPROOF_CACHE");
    VerifyTest::TearDown();
  }
  std::vector<std::string> with_row(const std::string& text) const {
    put("rows.toml", text);
    std::vector<std::string> options = exact;
    options.insert(options.end(), {"--engines", path("rows.toml"), "--engine", "other"});
    return options;
  }
  std::string status_of_other() const {
    for (const VerifyPicture& picture : verified().pictures)
      if (picture.engine == "other") return picture.status + ": " + picture.detail;
    return "";
  }
};

TEST_F(VerbVerify, engines_that_agree_end_with_0_and_say_what_they_would_have_seen) {
  const ProcessOutcome outcome = verify(exact);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.standard_output << outcome.standard_error;
  const VerifyScene scene = verified();
  EXPECT_EQ(scene.verdict, "agree");
  ASSERT_EQ(scene.pairs.size(), 3u);
  for (const VerifyPair& pair : scene.pairs) {
    EXPECT_EQ(pair.verdict, "agree");
    EXPECT_LT(pair.would_see.value(), 0.03);
  }
  EXPECT_TRUE(has("out/verify.html"));
}

TEST_F(VerbVerify, engines_get_the_scene_without_its_answers) {
  put("expect.toml", "purpose = 'a test'\nexposure = 0.0\n");
  put("reference-32x32.exr", "an answer");
  put("texture.txt", "needed");
  put("list.sh", "ls \"$(dirname \"$1\")\" >\"$2/seen.txt\"; exit 1\n");
  const ProcessOutcome outcome = verify(with_row(
      row("other", "'sh', '" + path("list.sh") + "', '{scene}', '" + folder_.string() + "', '{output}', '{seed}'")));
  ASSERT_TRUE(has("seen.txt")) << outcome.standard_error;
  EXPECT_EQ(get("seen.txt"), "list.sh\nrows.toml\nscene.xml\ntexture.txt\n");
}

// Every pixel is 2; with the black around the crop the mean is 0.5.
TEST_F(VerbVerify, picture_of_a_scene_with_a_crop_is_the_crop_alone) {
  put_scene(rectangle(R"(<scale value="9"/>)", glow("2")));
  std::string text = get("scene.xml");
  text.insert(text.find("<rfilter"),
              "<integer name='crop_offset_x' value='6'/><integer name='crop_offset_y' value='6'/>"
              "<integer name='crop_width' value='12'/><integer name='crop_height' value='12'/>");
  put("scene.xml", text);
  const ProcessOutcome outcome = verify({"--engine", "path", "--engine", "bdpt"});
  const VerifyScene scene = verified();
  EXPECT_EQ(std::pair(scene.width, scene.height), std::pair(12, 12)) << outcome.standard_error;
  ASSERT_EQ(scene.pictures.size(), 2u);
  for (const VerifyPicture& picture : scene.pictures)
    for (const double mean : picture.mean) EXPECT_NEAR(mean, 2, 1e-3) << picture.engine << picture.detail;
}

TEST_F(VerbVerify, goes_on_from_what_is_drawn) {
  verify(exact);
  const auto count = [&] {
    const fs::directory_iterator cells(folder_ / "out/cells");
    return std::distance(begin(cells), end(cells));
  };
  const auto before = count();
  const ProcessOutcome again = verify(exact);
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_EQ(count(), before);
  EXPECT_GE(before, 3);
}

TEST_F(VerbVerify, ends_where_one_picture_takes_longer_than_it_has) {
  const ProcessOutcome outcome =
      run_process({sound, "verify", path("scene.xml"), "-o", path("out"), "--size", "24x24", "--seconds", "0.01",
                   "--power", "0.0001", "--no-probes", "--engine", "path", "--engine", "bdpt"},
                  {.wall_limit_seconds = 60});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.standard_error;
  EXPECT_EQ(verified().verdict, "inconclusive");
}

TEST_F(VerbVerify, one_engine_alone_is_inconclusive) {
  EXPECT_EQ(verify({"--engine", "path"}).exit_code, 3);
  EXPECT_EQ(verified().sentence, "only path renders this scene: no other way to compare");
}

TEST_F(VerbVerify, two_that_differ_are_both_named) {
  put("rows.toml", row("odd", render_command("'" PLANTED_ENGINE "', 'flipped-normal', '" + sound + "'", "path")));
  EXPECT_EQ(verify({"--engines", path("rows.toml"), "--engine", "odd", "--engine", "bdpt"}).exit_code, 1);
  const VerifyScene scene = verified();
  EXPECT_EQ(scene.verdict, "cannot tell which");
  EXPECT_EQ(scene.sentence.rfind("bdpt and odd differ; which is wrong is unknown", 0), 0u) << scene.sentence;
  ASSERT_EQ(scene.faults.size(), 1u);
  // The fault may be described from either engine's side. The pass is the same, but the cause may be reversed.
  EXPECT_FALSE(scene.faults[0].pass.empty());
}

// Under a sky of 1 a wall of albedo 0.5 shows 0.5.
TEST_F(VerbVerify, closed_form_decides_between_two) {
  put_scene(rectangle(R"(<scale value="4"/>)", diffuse("0.5")) +
            R"(<emitter type="constant"><rgb name="radiance" value="1"/></emitter>)");
  const auto expect = [&](const char* mean) {
    put("expect.toml", std::string("purpose = 'test'\nexposure = 0\n[analytic]\nformula = 'L = 0.5'\nmean = ") + mean);
  };
  expect("[0.5, 0.5, 0.5]\n");
  EXPECT_EQ(verify({"--engine", "path", "--engine", "volpath"}).exit_code, 0);
  EXPECT_EQ(verified().pairs.size(), 3u);
  expect("[0.51, 0.5, 0.5]\n");
  EXPECT_EQ(verify({"--engine", "path", "--engine", "volpath"}).exit_code, 1);
  EXPECT_NE(verified().sentence.find("red only against the closed form"), std::string::npos) << verified().sentence;
}

TEST_F(VerbVerify, light_tracing_is_no_witness_of_a_plane_without_end_under_a_sky) {
  put_scene(R"(<shape type="plane">)" + diffuse("0.5") + R"(</shape>)" +
            R"(<emitter type="constant"><rgb name="radiance" value="1"/></emitter>)");
  EXPECT_EQ(verify({"--engine", "path", "--engine", "volpath", "--engine", "ptracer"}).exit_code, 0);
  ASSERT_EQ(verified().pictures.size(), 3u);
  EXPECT_EQ(verified().pictures[1].status, "unsupported");
  EXPECT_NE(verified().pictures[1].detail.find("a plane without end"), std::string::npos);
}

TEST_F(VerbVerify, camera_paths_are_set_aside_where_they_cannot_show_a_caustic) {
  put_scene(walls(diffuse("0.5")) + glass_ball() + point_light());
  verify({"--engine", "path", "--engine", "volpath", "--engine", "bdpt"});
  const VerifyScene scene = verified();
  EXPECT_EQ(scene.verdict, "inconclusive") << scene.sentence;
  EXPECT_EQ(scene.sentence, "only bdpt renders this scene: no other way to compare");
  for (const VerifyPicture& picture : scene.pictures)
    EXPECT_EQ(picture.status, picture.engine == "bdpt" ? "ok" : "unsupported") << picture.engine;
  EXPECT_TRUE(scene.pairs.empty());
}

TEST_F(VerbVerify, who_may_be_off_by_half_witnesses_nothing) {
  const auto verdict = [&](const std::string& bias) {
    put("expect.toml",
        "purpose = 'test'\nexposure = 0\n[[tolerance]]\nengine = 'photonmapper'\nmetric = 'bias'\nvalue = " + bias +
            "\nreason = 'declared'\n");
    verify({"--engine", "volpath", "--engine", "photonmapper"});
    return verified().pairs.at(0).verdict;
  };
  EXPECT_EQ(verdict("0.02"), "agree");
  EXPECT_EQ(verdict("0.5"), "undecided");
}

/// The kept reference differs from the scene's light by 5 %, although its content is the scene's.
TEST_F(VerbVerify, stored_reference_that_is_off_to_one_side_is_stale) {
  const ProcessOutcome made = run_process(
      {sound, "reference", path("scene.xml"), "--size", "24x24", "--standard-error", "0.02", "--commit", "--quiet"});
  ASSERT_TRUE(made.ok()) << made.standard_error;
  EXPECT_EQ(verify(exact).exit_code, 0);
  EXPECT_EQ(verified().pairs.size(), 6u);
  const fs::path file = committed_reference_path(folder_ / "scene.xml", 24, 24);
  const Provenance provenance = parse_provenance(read_file(provenance_path(file)), "reference");
  Rendering old = read_rendering(file.string());
  for (float& v : old.mean.rgb) v *= 0.95f;
  write_reference(file, old, provenance, ReferenceSamples::halves);
  EXPECT_EQ(verify(exact).exit_code, 1);
  const VerifyScene scene = verified();
  EXPECT_EQ(scene.verdict, "stale reference");
  EXPECT_EQ(scene.sentence.rfind("stale reference: it differs by -", 0), 0u) << scene.sentence;
  EXPECT_TRUE(scene.faults.empty());
}

TEST_F(VerbVerify, missing_program_ends_with_2_and_the_others_are_compared) {
  const auto options = with_row(row("other", render_command("'no-such-renderer'", "path")));
  const ProcessOutcome outcome = verify(options);
  EXPECT_EQ(outcome.exit_code, 2) << outcome.standard_output;
  EXPECT_EQ(status_of_other().rfind("not_started: ", 0), 0u) << status_of_other();
  EXPECT_EQ(verified().pairs.size(), 3u);
}

TEST_F(VerbVerify, engine_that_is_killed_is_named_and_drawn_again_next_time) {
  const auto options =
      with_row(row("other", "'sh', '-c', 'test -e " + path("healed") + " || kill -KILL $$; exec " + sound +
                                " render \"$@\"', 'sh', '{scene}', '--integrator', 'path', '-o', "
                                "'{output}', '--size', '{width}x{height}', '--seed', '{seed}', "
                                "'--sampler', 'independent', '{budget}'"));
  EXPECT_EQ(verify(options).exit_code, 1);
  EXPECT_EQ(verified().verdict, "failed");
  EXPECT_EQ(status_of_other(), "crash: killed by SIGKILL");
  put("healed", "");
  EXPECT_EQ(verify(options).exit_code, 0);
  EXPECT_EQ(verified().verdict, "agree");
}

TEST_F(VerbVerify, image_that_is_cut_short_is_named) {
  const auto options = with_row(row("other", "'sh', '-c', 'printf v/1 >$0', '{output}', '{scene}', '{budget}'"));
  EXPECT_EQ(verify(options).exit_code, 1);
  EXPECT_EQ(verified().verdict, "failed");
  EXPECT_EQ(status_of_other().rfind("bad_image: wrote an image that cannot be read", 0), 0u) << status_of_other();
}

TEST_F(VerbVerify, folder_that_cannot_be_written_is_one_error) {
  put("out", "a file");
  const ProcessOutcome outcome = verify(exact);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.standard_error.find("out"), std::string::npos) << outcome.standard_error;
}

TEST_F(VerbVerify, full_disk_is_one_error_and_nothing_half_written_counts) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const auto options =
      with_row(row("other", "'sh', '-c', 'cat $1 >/dev/full && cp $1 $0', '{output}', '{scene}', '{budget}'"));
  EXPECT_EQ(verify(options).exit_code, 1);
  EXPECT_NE(status_of_other().find("No space left"), std::string::npos) << status_of_other();
}

TEST_F(VerbVerify, second_run_in_a_folder_is_refused_while_the_first_is_at_work) {
  const auto options = with_row(row("other", "'sh', '-c', 'sleep 4', '{output}', '{scene}', '{budget}'"));
  const std::string program = "(\"$0\" verify " + path("scene.xml") + " --engines " + path("rows.toml") +
                              " --engine other --engine path --no-probes --size 8x8 -o " + path("out") +
                              " >/dev/null 2>&1 & sleep 1; \"$0\" verify " + path("scene.xml") +
                              " --engine path --no-probes --size 8x8 -o " + path("out") + ")";
  const ProcessOutcome outcome = run_process({"sh", "-c", program, sound}, {.wall_limit_seconds = 60});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.standard_error.find("wait for it or choose another folder"), std::string::npos)
      << outcome.standard_error;
}

TEST_F(VerbVerify, two_runs_on_one_cache_of_probes_agree_and_a_third_takes_what_they_found) {
  put_scene(walls(diffuse("0.5")) + point_light());
  const auto run = [&](const std::string& out) {
    return run_process({sound, "verify", path("scene.xml"), "-o", path(out), "--size", "24x24", "--seconds", "3",
                        "--engine", "path", "--engine", "bdpt"},
                       {.wall_limit_seconds = 200});
  };
  auto first = std::async(std::launch::async, [&] { return run("out1"); });
  const ProcessOutcome second = run("out2");
  EXPECT_EQ(first.get().exit_code, 0);
  EXPECT_EQ(second.exit_code, 0) << second.standard_output << second.standard_error;
  EXPECT_TRUE(has("out1/probes"));
  EXPECT_EQ(run("out3").exit_code, 0);
  EXPECT_FALSE(has("out3/probes"));
  const auto probes = [&](const std::string& out) { return read_verify_record(path(out + "/verify.json")).probes; };
  const auto of_second = probes("out2"), of_third = probes("out3");
  ASSERT_GE(of_third.size(), 4u);  // a light, a material and a camera by two engines
  ASSERT_EQ(of_third.size(), of_second.size());
  for (std::size_t i = 0; i < of_third.size(); ++i) EXPECT_EQ(of_third[i].gain, of_second[i].gain);
}

TEST_F(VerbVerify, ctrl_c_ends_it_with_130_and_keeps_what_is_drawn) {
  const auto options = with_row(row("other", "'sh', '-c', 'sleep 60', '{output}', '{scene}', '{budget}'"));
  std::vector<std::string> argv{sound, "verify", path("scene.xml"), "-o", path("out"), "--no-probes", "--size", "8x8"};
  argv.insert(argv.end(), options.begin(), options.end());
  const auto cells = [&] {
    std::error_code none;
    const fs::directory_iterator found(folder_ / "out/cells", none);
    return none ? std::ptrdiff_t{0} : std::distance(begin(found), end(found));
  };
  const pid_t pid = start_program(argv, path("stderr"));
  const int status = signal_after(pid, SIGINT, 4, 0.1, cells);  // the fourth is the one that sleeps
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_TRUE(read_verify_record(path("out/verify.json")).interrupted);
  EXPECT_GE(cells(), 3);
}

TEST_F(VerbVerify, unknown_engine_is_one_error) {
  const ProcessOutcome outcome = verify({"--engine", "pth"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.standard_error.find("did you mean 'path'?"), std::string::npos) << outcome.standard_error;
}

TEST_F(VerbVerify, engine_that_denoises_is_refused_only_where_it_is_chosen) {
  put_scene(walls(diffuse(".5")));
  put("rows.toml", row("smooth", render_command("'{photonproof}'", "path"), "biased") + "denoise = true\n");
  const ProcessOutcome all = verify({"--engines", path("rows.toml")});
  EXPECT_EQ(all.exit_code, 2);
  EXPECT_EQ(all.standard_error,
            path("rows.toml") + ": error: engine 'smooth' denoises; verify compares estimates alone\n");
  EXPECT_NE(verify({"--engines", path("rows.toml"), "--engine", "path", "--engine", "bdpt"}).exit_code, 2);
}

}  // namespace
}  // namespace photonproof::inline harness_verify
