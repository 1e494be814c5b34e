// Tests predictions of variants against our own engine, with mistakes that must be found.

#include "harness/variants/variant.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <variant>

#include "scenes/files/test_folder.h"
#include "scenes/parser/parser.h"
#include "scenes/xml/writer.h"

namespace photonproof::inline harness_variants {
namespace {

SceneDescription library_scene(const std::string& name) {
  SceneDescription scene = parse_scene_file(PHOTONPROOF_SOURCE_DIR "/scenes/library/" + name + "/scene.xml");
  scene.sensor.film.width = scene.sensor.film.height = 48;
  return scene;
}

const OwnEngine engine{.program = PHOTONPROOF_BINARY};

TEST(Variants, of_one_seed_are_the_same_and_of_another_are_not) {
  const SceneDescription base = library_scene("course-1");
  for (const std::string& kind : variant_kinds()) {
    const std::string once = write_scene(make_variant(kind, 7, base, 48, 48).scene);
    EXPECT_EQ(once, write_scene(make_variant(kind, 7, base, 48, 48).scene)) << kind;
    EXPECT_NE(once, write_scene(base)) << kind;
    if (kind == "mirror") continue;  // there is one
    bool differs = false;
    for (const std::uint64_t seed : {8, 9, 10, 11})
      differs = differs || once != write_scene(make_variant(kind, seed, base, 48, 48).scene);
    EXPECT_TRUE(differs) << kind;
  }
}

TEST(Variants, show_what_is_predicted_of_library_scenes) {
  for (const char* name : {"course-1", "cornell-spheres", "course-2"}) {
    const SceneDescription base = library_scene(name);
    for (const std::string& kind : variant_kinds())
      for (const bool axis_aligned : {false, true}) {
        if (axis_aligned && kind != "rigid-move" && kind != "crop") continue;
        if (name == std::string("course-2") && kind != "mirror" && kind != "rigid-move" && kind != "superposition")
          continue;
        const VariantOptions options{axis_aligned};
        const PredictionCheck check{.longer_side = 36, .spp = name == std::string("course-2") ? 64 : 128};
        EXPECT_EQ(check_prediction(make_variant(kind, 5, base, 48, 48, options), base, engine, options, check), "")
            << name << " " << kind << " " << axis_aligned;
      }
  }
}

TEST(Variants, are_refused_where_the_engine_shows_something_else) {
  const SceneDescription base = library_scene("cornell-spheres");
  Variant variant = make_variant("mirror", 1, base, 48, 48);
  EXPECT_EQ(check_prediction(variant, base, engine), "");
  variant.predicted = variant.predicted_variance = [](const Image& image) { return image; };  // not mirrored
  const std::string why = check_prediction(variant, base, engine);
  EXPECT_THAT(why, testing::StartsWith("our own engine does not show what is predicted of mirror"));
}

TEST(Variants, along_the_axes_turn_by_quarters) {
  const SceneDescription base = library_scene("course-1");
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    const Variant variant = make_variant("rigid-move", seed, base, 48, 48, {.axis_aligned = true});
    for (const ShapeDescription& shape : variant.scene.shapes)
      for (const Vec3d& side : {Vec3d(1, 0, 0), Vec3d(0, 1, 0)}) {
        const Vec3d edge = shape.to_world.vector(side);
        const double longest = std::max({std::abs(edge.x), std::abs(edge.y), std::abs(edge.z)});
        EXPECT_NEAR(longest, length(edge), 1e-9);
      }
  }
}

TEST(Variants, say_which_scene_does_not_allow_them) {
  SceneDescription dark = library_scene("course-1");
  for (ShapeDescription& shape : dark.shapes) shape.radiance.reset();
  EXPECT_EQ(input_error_of([&] { make_variant("superposition", 1, dark, 48, 48); }),
            "superposition: error: the scene has no rectangle or point that shines evenly");
  EXPECT_EQ(input_error_of([&] { make_variant("resolution", 1, dark, 47, 47); }),
            "resolution: error: the image's width and height are not both divisible by 2, 3 or 4");
  EXPECT_EQ(input_error_of([&] { make_variant("mirrored", 1, dark, 48, 48); }),
            "variant: error: there is no kind 'mirrored', expected one of mirror, rigid-move, light-scale, "
            "colour-permutation, superposition, object-order, resolution, crop, more-spheres");
}

TEST(Variants, of_a_clamped_base_are_right_once_clamped) {
  // White stays white: the factor is more than 1, so the variant hides what the clamp hid.
  const Variant variant = make_variant("light-scale", 3, library_scene("course-1"), 48, 48);
  Image base(1, 1);
  base.rgb = {0.25f, 1, 1};
  const Image image = variant.predicted(base);
  EXPECT_GT(image.rgb[0], 0.25f * 1.2f);
  EXPECT_GE(image.rgb[1], 1);
}

}  // namespace
}  // namespace photonproof::inline harness_variants
