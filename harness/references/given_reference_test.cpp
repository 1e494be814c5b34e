// References of files: their mean, variance and provenance, by hand.
#include "harness/references/given_reference.h"

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/pixels/display.h"
#include "harness/references/suite_scene.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_references {
namespace {

namespace fs = std::filesystem;

class GivenReference : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    put("ball.scene", "anything");
    scene_.name = "ball";
    scene_.path = folder_ / "ball.scene";
    scene_.given_path = "ball.scene";
    scene_.width = 4;
    scene_.height = 3;
    scene_.reader = SceneReader::engine;
    scene_.suite_file = folder_ / "s.toml";
  }

  fs::path image(const std::string& name, float value, std::optional<float> variance = {}) const {
    Rendering rendering;
    rendering.mean = Image(4, 3);
    for (float& v : rendering.mean.rgb) v = value;
    if (variance) {
      rendering.variance = Image(4, 3);
      for (float& v : rendering.variance->rgb) v = *variance;
    }
    write_exr((folder_ / name).string(), rendering);
    return folder_ / name;
  }

  SuiteScene scene_;
};

TEST_F(GivenReference, one_image_is_kept_to_the_bit_and_its_noise_is_unknown) {
  const MadeReference made = reference_from_files(scene_, {{image("golden.exr", 0.3f)}});
  EXPECT_EQ(made.rendering.mean.rgb[0], 0.3f);
  EXPECT_TRUE(has_unknown_noise(made.provenance));
  EXPECT_EQ(made.provenance.given->files, (std::vector<std::string>{"golden.exr"}));
  EXPECT_EQ(made.provenance.given->checksums.at(0).size(), 16u);
  store_reference_of(scene_, made, "");
  const StoredReference stored = reference_of(scene_);
  EXPECT_EQ(stored.rendering.mean.rgb[35], 0.3f);
  EXPECT_EQ(stored.file, folder_ / "references" / "ball" / "reference-4x3.exr");
  EXPECT_EQ(input_error_of([&] { store_reference_of(scene_, made, ""); }), "no error");  // the same one
}

// Values 1, 2 and 6 have mean 3 and variance ((4 + 1 + 9) / 2) / 3 of the mean.
TEST_F(GivenReference, several_images_give_mean_and_variance) {
  const MadeReference made =
      reference_from_files(scene_, {{image("1.exr", 1), image("2.exr", 2, 0.5f), image("6.exr", 6)}});
  EXPECT_FLOAT_EQ(made.rendering.mean.rgb[7], 3);
  EXPECT_FLOAT_EQ(made.rendering.variance->rgb[7], 7.0f / 3);
  EXPECT_EQ(made.provenance.given->noise, noise_of_images);
  EXPECT_EQ(freedom_of(made.provenance), 2);
}

TEST_F(GivenReference, a_variance_comes_from_its_own_image_or_from_the_layer) {
  const MadeReference layer = reference_from_files(scene_, {{image("a.exr", 1, 0.25f)}});
  EXPECT_EQ(layer.rendering.variance->rgb[0], 0.25f);
  EXPECT_EQ(layer.provenance.given->noise, stated_noise);
  const MadeReference own = reference_from_files(scene_, {{image("b.exr", 1)}, image("v.exr", 0.125f)});
  EXPECT_EQ(own.rendering.variance->rgb[0], 0.125f);
  EXPECT_EQ(own.provenance.given->noise, stated_noise);
  EXPECT_EQ(freedom_of(own.provenance), 31);
}

// Byte 128 is 128/255 = 0.50196 as a number.
TEST_F(GivenReference, a_png_is_decoded_by_the_declared_function) {
  const Image grey = [] {
    Image image(4, 3);
    for (float& v : image.rgb) v = static_cast<float>(decode_srgb(128 / 255.0));
    return image;
  }();
  const std::string png = (folder_ / "g.png").string();
  write_png(png, grey);
  const auto value = [&](const std::string& transfer) {
    return double{reference_from_files(scene_, {{png}, {}, transfer}).rendering.mean.rgb[0]};
  };
  EXPECT_NEAR(value(""), decode_srgb(128 / 255.0), 1e-6);
  EXPECT_NEAR(value("srgb"), decode_srgb(128 / 255.0), 1e-6);
  EXPECT_NEAR(value("linear"), 128 / 255.0, 1e-6);
  EXPECT_NEAR(value("gamma22"), std::pow(128 / 255.0, 2.2), 1e-6);
  EXPECT_EQ(reference_from_files(scene_, {{png}}).provenance.given->transfer, "srgb");
}

TEST_F(GivenReference, another_size_is_told_with_the_keys_that_fit) {
  const std::string file = image("golden.exr", 1).string();
  scene_.width = 5;
  EXPECT_EQ(
      input_error_of([&] { reference_from_files(scene_, {{file}}); }),
      file + ": error: is 4x3 pixels, scene 'ball' of the suite 5x3: write width = 4 and height = 3 in its [[scene]]");
}

TEST_F(GivenReference, a_changed_scene_makes_the_reference_out_of_date) {
  store_reference_of(scene_, reference_from_files(scene_, {{image("golden.exr", 1)}}), "");
  put("ball.scene", "another");
  EXPECT_NE(input_error_of([&] { reference_of(scene_); }).find("is out of date"), std::string::npos);
}

TEST_F(GivenReference, a_folders_content_is_all_of_its_files) {
  fs::create_directories(folder_ / "room" / "textures");
  put("room/a.usd", "1");
  put("room/textures/t.png", "2");
  scene_.path = folder_ / "room";
  const std::string hash = content_of(scene_).hash;
  put("room/.hidden", "3");
  EXPECT_EQ(content_of(scene_).hash, hash);
  put("room/textures/t.png", "4");
  EXPECT_NE(content_of(scene_).hash, hash);
}

TEST_F(GivenReference, an_xml_that_does_not_parse_says_how_to_leave_it_to_the_engine) {
  scene_.reader = SceneReader::photonproof;
  const std::string message = input_error_of([&] { content_of(scene_); });
  EXPECT_NE(message.find("; if only the engine is to read this file, write reads = \"engine\" in [[scene]] 'ball' of " +
                         (folder_ / "s.toml").string()),
            std::string::npos)
      << message;
}

TEST_F(GivenReference, engine_that_denoises_makes_none) {
  Engine engine;
  engine.name = "smooth";
  engine.command = {"true", "{scene}", "{output}", "{seed}"};
  engine.denoises = true;
  EXPECT_EQ(input_error_of([&] {
              reference_by_engine({}, scene_, {engine, {"spp", 4}, 2}, {});
            }),
            "smooth: error: denoises its images, whose errors no number of them averages out");
}

}  // namespace
}  // namespace photonproof::inline harness_references
