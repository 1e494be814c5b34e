#include "reference/store/reference_store.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "scenes/description/scene_hash.h"
#include "scenes/files/test_folder.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline reference_store {
namespace {

namespace fs = std::filesystem;

const std::string scene_text = R"(<scene version="3.0.0">
  <integrator type="path"/>
  <sensor type="perspective"><film type="hdrfilm"><rfilter type="box"/></film></sensor>
  <emitter type="constant"><rgb name="radiance" value="1"/></emitter>
  <shape type="obj"><string name="filename" value="a.obj"/></shape>
</scene>
)";

class ReferenceStore : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    setenv("PHOTONPROOF_CACHE", (folder_ / "cache").c_str(), 1);
    put("scene.xml", scene_text);
    put("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  }
  fs::path scene() const { return folder_ / "scene.xml"; }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  Provenance provenance() const {
    Provenance p;
    p.scene_hash = scene_hash(parse_scene_file(scene().string()));
    p.estimator = "path";
    p.samples = 1024;
    p.seeds = {1, 2};
    p.date = utc_now();
    return p;
  }
  static Rendering image(float value = 0.3f, int width = 5, int height = 4) {
    Rendering r{Image(width, height), Image(width, height), {}};
    for (std::size_t i = 0; i < r.mean.rgb.size(); ++i) {
      r.mean.rgb[i] = value + 0.01f * static_cast<float>(i);
      r.variance->rgb[i] = 1e-6f;
    }
    return r;
  }
  Provenance commit(const Rendering& rendering, const std::string& reason = "") const {
    return commit_reference(scene(), rendering, provenance(), reason);
  }
  std::string load_error(int width = 5, int height = 4) const {
    return input_error_of([&] { load_reference(scene(), width, height); });
  }
  std::string rebuild() const { return "photonproof reference " + path("scene.xml") + " --size 5x4 --commit"; }
};

TEST(RelativeStandardError, weighs_as_relmse_does) {
  // A variance of 1e-4 of values 0.1: sqrt(1e-4/(0.1^2 + 0.01)) = 0.0707107.
  Rendering rendering{Image(4, 2), Image(4, 2), {}};
  std::fill(rendering.mean.rgb.begin(), rendering.mean.rgb.end(), 0.1f);
  std::fill(rendering.variance->rgb.begin(), rendering.variance->rgb.end(), 1e-4f);
  EXPECT_NEAR(relative_standard_error(rendering), 0.0707107, 1e-6);
}

// A film of 10x8 whose crop is scaled to 2x2 from (1, 1) of 5x4.
TEST_F(ReferenceStore, reference_of_a_scene_with_a_crop_is_the_crop_also_where_the_file_stores_the_film) {
  std::string text = scene_text;
  text.insert(text.find("<rfilter"),
              "<integer name='width' value='10'/><integer name='height' value='8'/>"
              "<integer name='crop_offset_x' value='2'/><integer name='crop_offset_y' value='2'/>"
              "<integer name='crop_width' value='4'/><integer name='crop_height' value='4'/>");
  put("scene.xml", text);
  commit(image());
  const Rendering film = read_rendering(path("reference-5x4.exr"));
  const Rendering cut = load_reference(scene(), 5, 4).rendering;
  EXPECT_EQ(cut.place, (ImagePlace{1, 1, 5, 4}));
  ASSERT_EQ(std::pair(cut.mean.width, cut.mean.height), std::pair(2, 2));
  ASSERT_EQ(std::pair(cut.variance->width, cut.variance->height), std::pair(2, 2));
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 2; ++x) EXPECT_EQ(cut.mean.pixel(x, y)[2], film.mean.pixel(1 + x, 1 + y)[2]);
  // The crop alone in the file is the same reference.
  commit(cut, "the crop is enough");
  const Rendering again = load_reference(scene(), 5, 4).rendering;
  EXPECT_EQ(again.place, cut.place);
  EXPECT_EQ(again.mean.rgb, cut.mean.rgb);
}

TEST_F(ReferenceStore, committed_reference_comes_back_within_half_floats) {
  const Provenance written = commit(image());
  const StoredReference stored = load_reference(scene(), 5, 4);
  EXPECT_EQ(stored.provenance, written);
  EXPECT_EQ(stored.file, folder_ / "reference-5x4.exr");
  const Rendering original = image();
  for (std::size_t i = 0; i < original.mean.rgb.size(); ++i) {
    const float x = original.mean.rgb[i];
    // Neighbouring halves are at most 2^-10 x apart, and a draw between them has at most (2^-11 x)^2 variance.
    EXPECT_LE(std::abs(stored.rendering.mean.rgb[i] - x), x * 0x1p-10f);
    EXPECT_GE(stored.rendering.variance->rgb[i], 1e-6f * (1 - 0x1p-11f));
    EXPECT_LE(stored.rendering.variance->rgb[i], (1e-6f + x * x * 0x1p-22f) * (1 + 0x1p-11f));
  }
}

TEST_F(ReferenceStore, standard_error_is_stated_of_what_is_stored) {
  // One value everywhere: sqrt(v / (m^2 + 0.01)) with m = 0.5, v = 1e-6 is 1e-3 / sqrt(0.26) = 0.00196116.
  Rendering r = image();
  std::fill(r.mean.rgb.begin(), r.mean.rgb.end(), 0.5f);
  EXPECT_NEAR(commit(r).standard_error, 0.00196116, 0.00196116 * 0x1p-11);
}

TEST_F(ReferenceStore, missing_reference_is_an_error_that_says_how_to_make_it) {
  EXPECT_EQ(load_error(), path("scene.xml") +
                              ": error: has no reference of 5x4 pixels, neither reference-5x4.exr beside it nor in the "
                              "cache " +
                              path("cache") + "; make it with: photonproof reference " + path("scene.xml") +
                              " --size 5x4");
}

TEST_F(ReferenceStore, cache_serves_what_is_not_beside_the_scene) {
  const fs::path folder = cached_reference_folder(provenance().scene_hash, 5, 4);
  fs::create_directories(folder);
  write_reference(folder / "reference.exr", image(), provenance(), ReferenceSamples::floats);
  const StoredReference stored = load_reference(scene(), 5, 4);
  EXPECT_EQ(stored.rendering.mean.rgb, image().mean.rgb);  // floats as they were
  EXPECT_EQ(stored.rendering.variance->rgb, image().variance->rgb);
  put("scene.xml", scene_text + "<!-- moved -->");  // of other content, so the cache has none
  EXPECT_NE(load_error().find("has no reference of 5x4 pixels"), std::string::npos);
}

TEST_F(ReferenceStore, changed_scene_makes_the_reference_out_of_date_whatever_the_cache_has) {
  commit(image());
  const std::string before = provenance().scene_hash;
  put("scene.xml", scene_text + "<!-- moved -->");
  const std::string after = provenance().scene_hash;
  const fs::path folder = cached_reference_folder(after, 5, 4);
  fs::create_directories(folder);
  write_reference(folder / "reference.exr", image(), provenance(), ReferenceSamples::floats);
  EXPECT_EQ(load_error(), path("reference-5x4.exr") + ": error: is out of date: the scene's content is now " + after +
                              ", this reference is of " + before + "; make it again with: " + rebuild());
}

TEST_F(ReferenceStore, changed_mesh_makes_the_reference_out_of_date) {
  commit(image());
  put("a.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n");
  EXPECT_NE(load_error().find("is out of date"), std::string::npos) << load_error();
}

TEST_F(ReferenceStore, truncated_image_is_an_error) {
  commit(image());
  const std::string bytes = get("reference-5x4.exr");
  for (const double share : {0.0, 0.3, 0.9, 0.99}) {
    put("reference-5x4.exr", bytes.substr(0, static_cast<std::size_t>(share * static_cast<double>(bytes.size()))));
    const std::string error = load_error();
    EXPECT_EQ(error.find(path("reference-5x4.exr") + ": error: "), 0u) << error;
    EXPECT_NE(error.find("; make it again with: " + rebuild()), std::string::npos) << error;
  }
}

TEST_F(ReferenceStore, image_that_is_not_the_one_of_the_provenance_is_an_error) {
  commit(image());
  write_exr(path("reference-5x4.exr"), image(0.31f), ExrColour::half);
  EXPECT_EQ(load_error(),
            path("reference-5x4.exr") +
                ": error: does not hold the pixels its provenance is of; make it again with: " + rebuild());
  // Nor may the variance alone be another.
  commit(image());
  Rendering tampered = read_rendering(path("reference-5x4.exr"));
  tampered.variance->rgb[7] *= 2;
  write_exr(path("reference-5x4.exr"), tampered, ExrColour::half);
  EXPECT_NE(load_error().find("does not hold the pixels"), std::string::npos);
}

TEST_F(ReferenceStore, half_of_the_pair_is_an_error) {
  commit(image());
  fs::remove(folder_ / "reference-5x4.json");
  EXPECT_EQ(load_error(), path("reference-5x4.json") + ": error: no such file; make it again with: " + rebuild());
  fs::remove(folder_ / "reference-5x4.exr");
  commit(image());
  fs::remove(folder_ / "reference-5x4.exr");
  EXPECT_EQ(load_error(), path("reference-5x4.exr") + ": error: no such file; make it again with: " + rebuild());
}

TEST_F(ReferenceStore, image_of_another_size_is_an_error) {
  commit(image());
  fs::rename(folder_ / "reference-5x4.exr", folder_ / "reference-6x4.exr");
  fs::rename(folder_ / "reference-5x4.json", folder_ / "reference-6x4.json");
  EXPECT_NE(load_error(6, 4).find("is 5x4 and its provenance of 5x4, expected 6x4; make it again with: "),
            std::string::npos)
      << load_error(6, 4);
}

TEST_F(ReferenceStore, stored_value_that_is_not_finite_is_an_error) {
  Provenance p = commit(image());
  Rendering broken = read_rendering(path("reference-5x4.exr"));
  broken.mean.pixel(3, 2)[1] = std::numeric_limits<float>::quiet_NaN();
  write_exr(path("reference-5x4.exr"), broken, ExrColour::half);
  EXPECT_EQ(load_error(),
            path("reference-5x4.exr") + ": error: pixel (3, 2) G is not finite; make it again with: " + rebuild());
}

TEST_F(ReferenceStore, what_cannot_be_a_reference_is_not_written) {
  const auto error_of = [&](const Rendering& r) { return input_error_of([&] { commit(r); }); };
  const std::string file = path("reference-5x4.exr") + ": error: ";
  Rendering r = image();
  r.mean.pixel(1, 0)[2] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(error_of(r), file + "pixel (1, 0) B is not finite");
  r = image();
  r.variance->pixel(4, 3)[0] = -1;
  EXPECT_EQ(error_of(r), file + "the variance of pixel (4, 3) R is negative");
  r = image();
  r.variance.reset();
  EXPECT_EQ(error_of(r), file + "has no variance");
  r = image();
  r.mean.pixel(2, 1)[0] = 65536;
  EXPECT_EQ(error_of(r), file +
                             "pixel (2, 1) R is 65536.000000, more than a half float can be (65504): keep this "
                             "reference in the cache");
  EXPECT_EQ(error_of(image(0.3f, 257, 256)), path("scene.xml") +
                                                 ": error: a reference of 257x256 pixels is too large to be committed "
                                                 "(256x256 at most): keep it in the cache");
  EXPECT_FALSE(has("reference-5x4.exr"));
  EXPECT_FALSE(has("reference-5x4.json"));
}

TEST_F(ReferenceStore, good_reference_is_replaced_with_a_reason_only_and_both_are_remembered) {
  const Provenance first = commit(image());
  Provenance better = provenance();
  better.seeds = {3, 4, 5};
  EXPECT_EQ(input_error_of([&] { commit_reference(scene(), image(0.4f), better, ""); }),
            path("reference-5x4.exr") +
                ": error: is a good reference of this scene: say why it is replaced with --reason TEXT");
  commit_reference(scene(), image(0.4f), better, "the light is brighter");
  const StoredReference stored = load_reference(scene(), 5, 4);
  ASSERT_EQ(stored.provenance.acceptances.size(), 1u);
  EXPECT_EQ(stored.provenance.acceptances[0].reason, "the light is brighter");
  EXPECT_EQ(stored.provenance.acceptances[0].before, facts(first));
  EXPECT_EQ(stored.provenance.acceptances[0].after, facts(stored.provenance));

  put("scene.xml", scene_text + "<!-- moved -->");
  commit(image(0.5f));  // the old one is out of date, so no reason is needed
  const Provenance third = load_reference(scene(), 5, 4).provenance;
  ASSERT_EQ(third.acceptances.size(), 2u);
  EXPECT_EQ(third.acceptances[1].reason, "the scene has changed");
}

TEST_F(ReferenceStore, committing_the_same_reference_again_changes_nothing) {
  const Provenance p = provenance();
  commit_reference(scene(), image(), p, "");
  const std::string before = get("reference-5x4.json");
  commit_reference(scene(), image(), p, "");
  EXPECT_EQ(get("reference-5x4.json"), before);
}

TEST_F(ReferenceStore, cache_is_where_the_environment_says) {
  EXPECT_EQ(cache_folder(), folder_ / "cache");
  unsetenv("PHOTONPROOF_CACHE");
  setenv("XDG_CACHE_HOME", "/x", 1);
  EXPECT_EQ(cache_folder(), "/x/photonproof");
  unsetenv("XDG_CACHE_HOME");
  setenv("HOME", "/h", 1);
  EXPECT_EQ(cache_folder(), "/h/.cache/photonproof");
}

TEST_F(ReferenceStore, command_can_be_pasted) {
  EXPECT_EQ(reference_command("my scenes/it's.xml", 8, 4, false),
            "photonproof reference 'my scenes/it'\\''s.xml' --size 8x4");
}

}  // namespace
}  // namespace photonproof::inline reference_store
