// photonproof render as a user and a machine that fails treat it: kill -9 and --resume, Ctrl-C, crops, options that
// make no sense. Images are compared as bytes of the EXR, metadata included.

#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <csignal>

#include "harness/cells/test_program.h"
#include "scenes/base/process.h"
#include "scenes/files/test_folder.h"
#include "scenes/images/image.h"
#include "scenes/images/image_file.h"

namespace photonproof::inline harness_verbs_render {
namespace {

const std::string library = PHOTONPROOF_SOURCE_DIR "/scenes/library/";

class RenderVerb : public FolderTest {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::vector<std::string> argv(const std::string& output, const std::vector<std::string>& more) const {
    std::vector<std::string> all{PHOTONPROOF_BINARY, "render", scene_, "-o", path(output)};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  ProcessOutcome render(const std::string& output, const std::vector<std::string>& more) const {
    return run_process(argv(output, more), {.wall_limit_seconds = 120});
  }
  /// Sends the signal `seconds` after the program has written `checkpoints` of them.
  int signalled(int signal_number, int checkpoints, double seconds, const std::string& output,
                const std::vector<std::string>& more) const {
    const pid_t pid = start_program(argv(output, more), path("stderr"));
    return signal_after(pid, signal_number, checkpoints, seconds, [&] {
      std::error_code none_yet;
      return std::filesystem::last_write_time(path(output + ".checkpoint"), none_yet);
    });
  }
  /// Kills the render over and over, at other moments and thread counts, until it ends by itself; the number of kills.
  int kill_until_done(const std::string& output, const std::vector<std::string>& options) const {
    for (int kills = 0; kills < 200; ++kills) {
      std::vector<std::string> now = options;
      now.insert(now.end(), {"--checkpoint", "0.03", "--threads", std::to_string(1 + kills % 3)});
      if (has(output + ".checkpoint")) now.emplace_back("--resume");
      // A golden-ratio sequence of moments between two checkpoints, while one is written included.
      const double moment = 0.04 * std::fmod(0.618 * kills, 1.0);
      const int status = signalled(SIGKILL, 1 + kills % 4, moment, output, now);
      if (!WIFEXITED(status)) continue;
      EXPECT_EQ(WEXITSTATUS(status), 0) << get("stderr");
      return kills;
    }
    ADD_FAILURE() << "never done";
    return 0;
  }

  std::string scene_ = library + "cornell-spheres/scene.xml";
};

TEST_F(RenderVerb, folder_of_the_output_is_made) {
  const ProcessOutcome outcome = render("new/deep/out.exr", {"--size", "4x4", "--spp", "1", "--quiet"});
  EXPECT_TRUE(outcome.ok());
  EXPECT_EQ(outcome.standard_error, "");
  EXPECT_TRUE(has("new/deep/out.exr"));
}

TEST_F(RenderVerb, killed_and_resumed_gives_the_bytes_of_a_render_never_stopped) {
  const std::vector<std::vector<std::string>> renders{
      {"--integrator", "path", "--size", "96x96", "--spp", "200", "--seed", "3"},
      {"--integrator", "photonmapper", "--size", "96x96", "--spp", "32", "--photons", "5e5", "--seed", "3"},
      {"--integrator", "direct", "--size", "96x96", "--spp", "800", "--crop", "11", "20", "75", "60"}};
  for (const std::vector<std::string>& options : renders) {
    const ProcessOutcome whole = render("whole.exr", options);
    ASSERT_TRUE(whole.ok()) << whole.standard_error;
    const int kills = kill_until_done("killed.exr", options);
    std::printf("%s: %d kills\n", options[1].c_str(), kills);
    std::fflush(stdout);  // else every child prints it again
    EXPECT_GE(kills, 2) << options[1] << ": nothing was tested";
    EXPECT_EQ(get("killed.exr"), get("whole.exr")) << options[1];
    EXPECT_FALSE(has("killed.exr.checkpoint"));
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
      EXPECT_EQ(entry.path().filename().string().find(".partial-"), std::string::npos) << entry.path();
  }
}

TEST_F(RenderVerb, interrupted_writes_what_there_is_and_can_be_resumed) {
  const std::vector<std::string> options{"--size", "96x96", "--spp", "600"};
  ASSERT_TRUE(render("whole.exr", options).ok());
  std::vector<std::string> often = options;
  often.insert(often.end(), {"--checkpoint", "0.03"});
  const int status = signalled(SIGINT, 2, 0.01, "a.exr", often);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_NE(get("stderr").find("--resume goes on from there"), std::string::npos) << get("stderr");
  EXPECT_EQ(read_image(path("a.exr")).width, 96);
  ASSERT_TRUE(has("a.exr.checkpoint"));

  const ProcessOutcome anew = render("a.exr", options);
  EXPECT_EQ(anew.exit_code, 2);
  EXPECT_EQ(anew.standard_error,
            path("a.exr.checkpoint") +
                ": error: an unfinished render left this checkpoint: go on from it with --resume, or delete it\n");
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), options.begin(), options.end());
    return render("a.exr", more);
  };
  EXPECT_EQ(with({"--resume", "--seed", "9"}).standard_error,
            path("a.exr.checkpoint") +
                ": error: the checkpoint is not one of this render: its seed is 0, this render's is 9\n");
  EXPECT_NE(with({"--resume", "-D", "size=33"}).standard_error.find("its scene's content is "), std::string::npos);

  const ProcessOutcome resumed = with({"--resume", "--json"});
  EXPECT_TRUE(resumed.ok()) << resumed.standard_error;
  EXPECT_NE(resumed.standard_output.find("\"resumed_from_samples\""), std::string::npos);
  EXPECT_EQ(get("a.exr"), get("whole.exr"));

  const ProcessOutcome again = with({"--resume", "--quiet"});  // complete: there is none, so it begins anew
  EXPECT_TRUE(again.ok());
  EXPECT_EQ(again.standard_error,
            path("a.exr.checkpoint") + ": warning: no such checkpoint, the render starts from the beginning\n");
  EXPECT_EQ(get("a.exr"), get("whole.exr"));
}

TEST_F(RenderVerb, damaged_checkpoint_is_refused_and_left_alone) {
  put("a.exr.checkpoint", "my notes");
  const ProcessOutcome outcome = render("a.exr", {"--size", "8x8", "--resume"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.standard_error, path("a.exr.checkpoint") + ": error: is not a checkpoint of a render\n");
  EXPECT_EQ(get("a.exr.checkpoint"), "my notes");
  EXPECT_TRUE(render("a.exr", {"--size", "8x8", "--checkpoint", "0"}).ok());  // which touches none
  EXPECT_EQ(get("a.exr.checkpoint"), "my notes");
}

// The photon mapper's own radii follow from what its passes show, of a crop from the crop; sppm's from photons alone.
TEST_F(RenderVerb, crop_has_the_bits_of_the_whole_image) {
  for (const std::vector<std::string>& method :
       {std::vector<std::string>{"path"}, {"sppm"}, {"photonmapper", "--view", "photons"}}) {
    std::vector<std::string> options{"--size", "50x40", "--spp", "4", "--integrator"};
    options.insert(options.end(), method.begin(), method.end());
    ASSERT_TRUE(render("whole.exr", options).ok());
    std::vector<std::string> cropped = options;
    cropped.insert(cropped.end(), {"--crop", "13", "5", "30", "20"});
    ASSERT_TRUE(render("part.exr", cropped).ok());
    const Image whole = read_image(path("whole.exr"));
    const Image part = read_rendering(path("part.exr"), "", ImageWindow::stored).mean;
    ASSERT_EQ(part.width, 30);
    ASSERT_EQ(part.height, 20);
    for (int y = 0; y < 20; ++y)
      for (int x = 0; x < 30; ++x)
        for (int c = 0; c < 3; ++c)
          ASSERT_EQ(part.pixel(x, y)[c], whole.pixel(x + 13, y + 5)[c]) << method[0] << " " << x << " " << y;
  }
}

TEST_F(RenderVerb, whole_numbers_may_be_written_with_an_exponent) {
  ASSERT_TRUE(render("a.exr", {"--size", "8x8", "--spp", "1e1"}).ok());
  EXPECT_NE(get("a.stats.json").find("\"samples_per_pixel\": 10.0"), std::string::npos);
  for (const char* spp : {"1.5", "0", "-3", "many", "1e99", "nan"}) {
    const ProcessOutcome outcome = render("a.exr", {"--spp", spp});
    EXPECT_EQ(outcome.exit_code, 2) << spp;
    EXPECT_NE(outcome.standard_error.find("'" + std::string(spp) + "' is not a whole number from 1 to 4294967296"),
              std::string::npos)
        << outcome.standard_error;
  }
}

TEST_F(RenderVerb, what_does_not_fit_in_memory_is_one_error_that_says_what_to_change) {
  const auto limited = [&](const char* kilobytes, const std::vector<std::string>& options) {
    std::vector<std::string> words{"/bin/sh", "-c", "ulimit -v $0; exec \"$@\"", kilobytes};
    for (const std::string& word : argv("a.exr", options)) words.push_back(word);
    return run_process(words, {.wall_limit_seconds = 120});
  };
  // A film's pixel is 64 bytes, once more in a checkpoint: 128 x 2^28 bytes are 32768 MB.
  const ProcessOutcome film = limited("8000000", {"--size", "16384x16384", "--spp", "1"});
  EXPECT_EQ(film.exit_code, 2);
  EXPECT_NE(film.standard_error.find(": error: an image of 16384x16384 pixels takes 32768 MB of memory, but only "),
            std::string::npos)
      << film.standard_error;
  // 2^24 cells have 2^25 triangles: 12 bytes of indices each and 2^24 vertices of 12 bytes are over half a gigabyte.
  put("field.xml",
      "<scene version='3.0.0'><integrator type='path'/><sensor type='perspective'/><emitter type='constant'/><shape "
      "type='heightfield'><integer "
      "name='columns' value='4096'/><integer name='rows' value='4096'/></shape></scene>");
  scene_ = path("field.xml");
  const ProcessOutcome field = limited("900000", {"--size", "8x8", "--threads", "1"});
  EXPECT_EQ(field.exit_code, 2);
  EXPECT_EQ(field.standard_error,
            "photonproof: out of memory: make the image, the meshes or the number of photons smaller\n");
}

TEST_F(RenderVerb, a_value_that_is_rendered_as_another_is_said_and_kept_in_the_stats) {
  put("metal.xml",
      "<scene version='3.0.0'><integrator type='path'/><sensor type='perspective'/><emitter type='constant'/>\n"
      "<bsdf type='roughconductor' id='m'><float name='alpha' value='1e-9'/></bsdf>\n"
      "<shape type='sphere'><ref id='m'/></shape></scene>");
  scene_ = path("metal.xml");
  const std::string place = scene_ + ":2:1", text = "alpha 1e-09 is rendered as 0.0001";
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{"--size", "4x4", "--spp", "1", "--quiet"}, {"--size", "4x4", "--plan"}})
    EXPECT_EQ(render("a.exr", options).standard_error, place + ": warning: " + text + "\n");
  EXPECT_NE(get("a.stats.json").find("\"losses\": [\n    \"" + place + ": " + text + "\"\n  ]"), std::string::npos)
      << get("a.stats.json");
}

TEST_F(RenderVerb, options_that_make_no_sense_are_refused) {
  const auto refusal = [&](const std::vector<std::string>& options) { return render("a.exr", options).standard_error; };
  EXPECT_EQ(refusal({"--integrator", "path", "--photons", "1000"}),
            "--photons: error: does nothing with integrator 'path', which stores no photons\n");
  EXPECT_EQ(refusal({"--plan", "--integrator", "path", "--photons", "1000"}),
            "--photons: error: does nothing with integrator 'path', which stores no photons\n");
  EXPECT_EQ(refusal({"--plan", "--resume"}), "--resume: error: does nothing with --plan, which renders nothing\n");
  for (const char* plan : {"--plan", "--quiet"})
    EXPECT_EQ(refusal({plan, "--size", "50x40", "--crop", "30", "0", "21", "40"}),
              "--crop: error: 30 0 21 40 is no part of the image of 50x40 pixels\n");
  EXPECT_FALSE(has("a.exr"));
  const std::string help = run_process({PHOTONPROOF_BINARY, "render", "--help"}).standard_output;
  EXPECT_NE(help.find("sobol, independent"), std::string::npos) << help;
}

TEST_F(RenderVerb, view_is_named_in_image_stats_and_plan_and_resumed_as_itself) {
  const std::vector<std::string> options{"--integrator", "photonmapper", "--size", "96x96", "--spp", "600"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), options.begin(), options.end());
    return more;
  };
  const int status = signalled(SIGINT, 1, 0, "a.exr", with({"--view", "caustics", "--checkpoint", "0.03"}));
  ASSERT_TRUE(WIFEXITED(status));
  ASSERT_EQ(WEXITSTATUS(status), 130) << get("stderr");
  EXPECT_NE(get("a.exr").find(" --integrator photonmapper --view caustics --seed 0"), std::string::npos);
  EXPECT_NE(get("a.stats.json").find("\"view\": \"caustics\""), std::string::npos) << get("a.stats.json");
  EXPECT_EQ(render("a.exr", with({"--resume"})).standard_error,
            path("a.exr.checkpoint") +
                ": error: the checkpoint is not one of this render: its view is caustics, this render's is whole\n");

  const std::string plan = render("b.exr", with({"--plan", "--view", "caustics"})).standard_output;
  EXPECT_NE(plan.find("global-map          the global photon map: the view does not show it"), std::string::npos)
      << plan;
  EXPECT_NE(render("b.exr", with({"--plan", "--json"})).standard_output.find("\"view\": \"whole\""), std::string::npos);
  EXPECT_EQ(render("b.exr", {"--integrator", "path", "--view", "caustics"}).standard_error,
            "--view: error: does nothing with integrator 'path', which makes no photon maps\n");
  EXPECT_EQ(render("b.exr", with({"--view", "caustic"})).exit_code, 2);
  EXPECT_FALSE(has("b.exr"));
}

// OpenImageIO and libpng read what is written here. Of sRGB's curve, 12.92 v for dark values and the power 1/2.4 for
// others, the test has a formula of its own.
TEST_F(RenderVerb, writes_the_same_image_as_pfm_and_as_png) {
  const std::vector<std::string> options{"--size", "7x5", "--spp", "2", "--quiet"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), options.begin(), options.end());
    return more;
  };
  ASSERT_TRUE(render("a.exr", options).ok());
  ASSERT_TRUE(render("a.pfm", options).ok());
  ASSERT_TRUE(render("a.png", options).ok());
  ASSERT_TRUE(render("dark.png", with({"--exposure", "-1.5"})).ok());
  const Image exr = read_image(path("a.exr"));
  EXPECT_EQ(open_other_format(path("a.pfm"))->header().channels, (std::vector<std::string>{"R", "G", "B"}));
  std::vector<float> pfm(exr.rgb.size());
  open_other_format(path("a.pfm"))->read(0, 5, 0, 3, pfm.data());
  EXPECT_EQ(pfm, exr.rgb);
  for (const auto& [name, stops] : {std::pair<const char*, double>{"a.png", 0}, {"dark.png", -1.5}}) {
    const Image png = read_texture_image(path(name), true);
    ASSERT_EQ(png.rgb.size(), exr.rgb.size());
    for (std::size_t i = 0; i < exr.rgb.size(); ++i) {
      const double v = std::min(double{exr.rgb[i]} * std::pow(2.0, stops), 1.0);
      const double encoded = v < 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 5.0 / 12) - 0.055;
      EXPECT_NEAR(double{png.rgb[i]} * 255, encoded * 255, 0.501) << name << " " << i;
    }
  }
}

TEST_F(RenderVerb, stats_do_not_go_to_the_checkpoint) {
  const std::string file = path("a.png.checkpoint");
  const ProcessOutcome outcome = render("a.png", {"--size", "4x4", "--spp", "1", "--stats", file});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.standard_error, file + ": error: the stats cannot go to the checkpoint's own file\n");
  EXPECT_FALSE(has("a.png"));
}

TEST_F(RenderVerb, formats_that_it_does_not_write_are_one_sentence) {
  const auto message = [&](const std::string& output, const std::vector<std::string>& more) {
    const ProcessOutcome outcome = render(output, more);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_FALSE(has(output));
    return outcome.standard_error;
  };
  EXPECT_EQ(message("a.jpg", {}), "--output: error: '" + path("a.jpg") +
                                      "' does not name a format, expected NAME.exr, NAME.pfm or NAME.png\n");
  EXPECT_EQ(message("a.exr", {"--exposure", "1"}),
            "--exposure: error: is for a PNG, but " + path("a.exr") + " has the radiance itself\n");
}

TEST_F(RenderVerb, scene_whose_name_is_no_utf8_has_its_stats) {
  const std::string named = path("sc\xFFne.xml");
  std::filesystem::copy_file(scene_, named);
  const ProcessOutcome outcome =
      run_process({PHOTONPROOF_BINARY, "render", named, "-o", path("a.exr"), "--size", "4x4", "--spp", "1", "--json"},
                  {.wall_limit_seconds = 120});
  EXPECT_TRUE(outcome.ok()) << outcome.standard_error;
  EXPECT_NE(get("a.stats.json").find("sc\xEF\xBF\xBDne.xml"), std::string::npos);
}

TEST_F(RenderVerb, name_that_is_too_long_is_one_sentence_before_anything_is_rendered) {
  // With .exr, 255 bytes: the image could be written, its stats could not.
  for (const std::size_t length : {251u, 252u, 300u}) {
    const ProcessOutcome outcome = render(std::string(length, 'n') + ".exr", {"--size", "4x4", "--spp", "1"});
    EXPECT_EQ(outcome.exit_code, 2) << length;
    EXPECT_TRUE(outcome.standard_error.ends_with(": error: cannot be written: File name too long\n"))
        << outcome.standard_error;
  }
}

TEST_F(RenderVerb, image_that_the_scene_uses_is_not_rendered_over) {
  Rendering rendering;
  rendering.mean = Image(2, 2);
  rendering.mean.rgb.assign(rendering.mean.rgb.size(), 1.0f);
  write_exr(path("sky.exr"), rendering);
  put("scene.xml",
      "<scene version='3.0.0'><sensor type='perspective'><film type='hdrfilm'><rfilter type='box'/></film>"
      "</sensor><emitter type='envmap'><string name='filename' value='sky.exr'/></emitter></scene>");
  scene_ = path("scene.xml");
  const std::string before = get("sky.exr");
  const ProcessOutcome outcome = render("sky.exr", {"--size", "4x4", "--spp", "1"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.standard_error,
            path("sky.exr") + ": error: is a file that the scene uses, which it would replace\n");
  EXPECT_EQ(get("sky.exr"), before);
}

TEST_F(RenderVerb, checkpoint_of_a_render_at_work_is_not_called_unfinished) {
  const pid_t pid =
      start_program(argv("a.exr", {"--size", "64x64", "--seconds", "60", "--checkpoint", "0.05"}), path("stderr"));
  for (int i = 0; i < 2000 && !has("a.exr.checkpoint"); ++i) usleep(10000);
  for (const char* option : {"--quiet", "--resume"}) {
    const ProcessOutcome outcome = render("a.exr", {"--size", "64x64", "--spp", "1", option});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.standard_error.find("the render that writes this checkpoint is still at work"), std::string::npos)
        << outcome.standard_error;
  }
  kill(pid, SIGKILL);
  int status = 0;
  waitpid(pid, &status, 0);
  const ProcessOutcome outcome = render("a.exr", {"--size", "64x64", "--spp", "1"});
  EXPECT_NE(outcome.standard_error.find("an unfinished render left this checkpoint"), std::string::npos);
}

}  // namespace
}  // namespace photonproof::inline harness_verbs_render
