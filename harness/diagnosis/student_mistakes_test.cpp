// Mistakes that students have made, in pictures made without the renders of the diagnosis itself.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include "harness/diagnosis/pictures/comparison.h"
#include "harness/diagnosis/test_defects.h"
#include "scenes/base/splitmix.h"

namespace photonproof::inline harness_diagnosis {
namespace {

class StudentMistakes : public testing::Test {
 protected:
  static constexpr int side_ = 72;

  static const SceneKnowledge& known() {
    static const SceneKnowledge knowledge = test_knowledge("course-1", side_);
    return knowledge;
  }
  static Image rendered(const SceneDescription& scene, std::uint64_t seed) {
    OwnRender render{.width = side_, .height = side_, .spp = 48, .seed = seed};
    render.integrator = "photonmapper";
    return test_render(scene, render);
  }
  static Image right() { return rendered(test_scene("course-1"), 21); }
  static Image with(const std::function<void(SceneDescription&)>& change) {
    SceneDescription scene = test_scene("course-1");
    change(scene);
    return rendered(scene, 22);
  }
  /// Light that goes directly from lights to walls, by path tracing.
  static Image direct(const SceneDescription& from) {
    SceneDescription scene = from;
    PathDescription path;
    path.max_depth = 2;
    scene.integrator.method = path;
    OwnRender render{.width = side_, .height = side_, .spp = 256, .seed = 23};
    render.integrator = "";
    return test_render(scene, render);
  }
  /// The right picture, except that direct light on walls is the changed scene's.
  static Image with_direct_of(const std::function<void(SceneDescription&)>& change) {
    SceneDescription scene = test_scene("course-1");
    const Image before = direct(scene);
    change(scene);
    const Image after = direct(scene);
    Image image = right();
    for (std::size_t i = 0; i < image.rgb.size(); ++i)
      if (!sees(i / 3, "lamp") && !sees(i / 3, "sphere"))
        image.rgb[i] = std::max(0.0f, image.rgb[i] + after.rgb[i] - before.rgb[i]);
    return image;
  }
  static bool sees(std::size_t pixel, const std::string& what) {
    const std::uint16_t mark = known().seen[pixel];
    return mark > 0 && known().landmarks[mark - 1u].name.ends_with(what);
  }
  static void set_material(SceneDescription& scene, const std::string& id, decltype(BsdfDescription::model) model) {
    for (BsdfDescription& bsdf : scene.bsdfs)
      if (bsdf.id == id) bsdf.model = std::move(model);
  }
  static const DielectricDescription& glass_of(const SceneDescription& scene) {
    for (const BsdfDescription& bsdf : scene.bsdfs)
      if (const auto* glass = std::get_if<DielectricDescription>(&bsdf.model)) return *glass;
    throw std::runtime_error("no glass");
  }
  static void expect_first(const Image& image, const std::string& kind, const std::string& part) {
    const std::vector<Finding> findings = diagnose(as_bytes(image), known());
    ASSERT_FALSE(findings.empty()) << kind;
    EXPECT_EQ(findings.size(), 1u) << text_of(findings);
    // The diagnosis may leave a mistake unnamed but must never give it a wrong name.
    if (findings.front().kind == "differs" && kind != "differs") return;
    EXPECT_EQ(findings.front().kind, kind) << text_of(findings);
    EXPECT_THAT(findings.front().sentence, testing::HasSubstr(part)) << text_of(findings);
  }
};

TEST_F(StudentMistakes, rows_of_another_length_slant_the_image) {
  const Image image = right();
  // Row y begins at y * 71, and so first shows y pixels of the row above: each row is further right.
  for (const auto& [length, first, words] : {std::tuple(side_ - 1, 0, "1 pixel further right than the one above"),
                                             std::tuple(side_ + 2, 0, "2 pixels further left than the one above"),
                                             std::tuple(side_ - 1, side_ - 1, "1 pixel further right")}) {
    Image slanted(side_, side_);
    for (int y = 0; y < side_; ++y)
      for (int x = 0; x < side_; ++x) {
        const int at = first * side_ + (y - first) * length + x;
        if (at >= 0 && at < side_ * side_)
          std::copy_n(&image.rgb[3 * static_cast<std::size_t>(at)], 3, slanted.pixel(x, y));
      }
    expect_first(slanted, "slanted", words);
  }
}

TEST_F(StudentMistakes, an_angle_that_is_not_halved_shows_the_room_in_a_black_frame) {
  const Image image = right();
  Image wide(side_, side_);
  for (int y = 0; y < side_; ++y)
    for (int x = 0; x < side_; ++x) {
      const double u = 36 + (x + 0.5 - 36) / 0.4, v = 36 + (y + 0.5 - 36) / 0.4;
      if (u >= 0 && v >= 0 && u < side_ && v < side_)
        std::copy_n(image.pixel(static_cast<int>(u), static_cast<int>(v)), 3, wide.pixel(x, y));
    }
  expect_first(wide, "field-of-view", "too wide");
}

TEST_F(StudentMistakes, glass_without_fresnel_reflects_nothing) {
  expect_first(with([](SceneDescription& scene) {
                 DielectricDescription glass = glass_of(scene);
                 glass.specular_reflectance = RgbD(0.0);
                 glass.specular_transmittance = RgbD(0.95);  // all goes through, except for the glass's colour
                 set_material(scene, "glass", glass);
               }),
               "glass-without-reflection", "the glass sphere reflects nothing");
}

TEST_F(StudentMistakes, a_light_that_is_drawn_from_in_one_quarter_is_told_from_hard_shadows) {
  expect_first(
      with_direct_of([](SceneDescription& scene) {
        for (ShapeDescription& shape : scene.shapes)
          if (shape.radiance) {
            shape.to_world = shape.to_world * Transform::translate({-0.5, 0.5, 0}) * Transform::scale({0.5, 0.5, 1});
            shape.radiance = std::get<RgbD>(*shape.radiance) * 4.0;
          }
      }),
      "lamp-part", "a quarter of the lamp");
}

TEST_F(StudentMistakes, shadow_rays_that_pass_one_body_are_told_from_those_that_pass_all) {
  const auto without_sphere = [](bool glass_too) {
    return [glass_too](SceneDescription& scene) {
      std::erase_if(scene.shapes, [&](const ShapeDescription& shape) {
        const auto* sphere = std::get_if<SphereDescription>(&shape.geometry);
        return sphere != nullptr && (sphere->center.x < 0 || glass_too);
      });
    };
  };
  expect_first(with_direct_of(without_sphere(false)), "shadow-missing", "the mirror sphere casts no shadow");
  expect_first(with_direct_of(without_sphere(true)), "shadows-missing", "shadows missing");
}

TEST_F(StudentMistakes, one_material_for_all_walls_is_no_mistake_of_channels) {
  expect_first(with([](SceneDescription& scene) {
                 std::optional<BsdfIndex> first;
                 for (ShapeDescription& shape : scene.shapes) {
                   if (!std::holds_alternative<RectangleDescription>(shape.geometry) || shape.radiance) continue;
                   if (!first) first = shape.bsdf;
                   shape.bsdf = *first;
                 }
               }),
               "materials-shared", "all walls have one colour");
}

TEST_F(StudentMistakes, all_that_is_missing_is_one_sentence) {
  Image image = with([](SceneDescription& scene) {
    std::erase_if(scene.shapes, [](const ShapeDescription& shape) {
      return std::holds_alternative<SphereDescription>(shape.geometry);
    });
  });
  const std::vector<Finding> findings = diagnose(as_bytes(image), known());
  ASSERT_FALSE(findings.empty());
  EXPECT_THAT(findings.front().sentence,
              testing::AnyOf("the mirror sphere and the glass sphere are missing", testing::HasSubstr("not explained")))
      << text_of(findings);
}

TEST_F(StudentMistakes, what_nothing_explains_is_shown_and_not_named) {
  Image image = right();
  // Colours that nothing in the room has, in squares of 4 x 4 pixels.
  for (std::size_t i = 0; i < image.pixels(); ++i)
    if (sees(i, "mirror sphere"))
      for (std::size_t c = 0; c < 3; ++c)
        image.rgb[3 * i + c] = static_cast<float>(splitmix64(c, i % side_ / 4 + 1000 * (i / side_ / 4)) % 1000) / 1000;
  expect_first(image, "differs", "differs here, not explained");
  EXPECT_THAT(diagnose(as_bytes(image), known()).front().sentence, testing::HasSubstr("mirror sphere"));
}

TEST_F(StudentMistakes, two_mistakes_at_once_are_not_taken_for_one) {
  Image image = with([](SceneDescription& scene) { set_material(scene, "mirror", DiffuseDescription{RgbD(0.7)}); });
  for (std::size_t i = 0; i < image.pixels(); ++i)
    if (sees(i, "left wall"))
      for (std::size_t c = 0; c < 3; ++c) image.rgb[3 * i + c] *= 0.5f;
  expect_first(image, "differs", "differs here, not explained");
}

TEST_F(StudentMistakes, guesses_that_know_nothing_explain_nothing) {
  const Image image = as_bytes(right());
  const Comparison comparison(image, 1.0f, 0.08, {});
  Image unknown = image;
  for (float& v : unknown.rgb) v = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(comparison.total(image), 0);
  EXPECT_EQ(comparison.total(unknown), Comparison::unexplained);
  // Where nothing counts, nothing is left to explain.
  EXPECT_EQ(Comparison(image, 1.0f, 0.08, std::vector<std::uint8_t>(image.pixels(), 1)).total(unknown), 0);
}

}  // namespace
}  // namespace photonproof::inline harness_diagnosis
