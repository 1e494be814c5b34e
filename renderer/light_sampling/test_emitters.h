// From a scene's text to one pixel, for tests of emitters. These tests do not depend on the representation of lights.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "renderer/integrators/test_scenes.h"
#include "scenes/files/test_folder.h"
#include "scenes/images/image.h"
#include "scenes/parser/parser.h"

namespace photonproof::test {

class EmitterScene : public FolderTest {
 protected:
  /// Colour of a pixel, 0.01 degrees wide, that looks from `eye` to `target` in a scene with this content.
  RgbD seen(const std::string& content, const Vec3d& eye, const Vec3d& target, std::int64_t spp = 4) const {
    const Vec3d along = normalize(target - eye), up = std::abs(along.y) < 0.9 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0};
    const std::string text =
        "<scene version='3.0.0'><integrator type='path'><integer name='max_depth' value='2'/>"
        "</integrator><sensor type='perspective'><float name='fov' value='0.01'/>"
        "<transform name='to_world'>" +
        look_at(eye, target, up) +
        "</transform><film type='hdrfilm'><integer name='width' value='1'/>"
        "<integer name='height' value='1'/><rfilter type='box'/></film></sensor>" +
        content + "</scene>";
    const Image image =
        render(parse_scene_text(text, (folder_ / "scene.xml").string()), "path", job_with(spp)).image.mean;
    return {image.pixel(0, 0)[0], image.pixel(0, 0)[1], image.pixel(0, 0)[2]};
  }

  /// Irradiance by an emitter on a small surface at p with the normal n: the radiance of white paint there, times pi.
  RgbD irradiance(const std::string& emitter, const Vec3d& p, const Vec3d& n, std::int64_t spp = 4) const {
    const Vec3d normal = normalize(n), up = std::abs(normal.y) < 0.9 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0};
    const std::string paint = "<shape type='rectangle'><transform name='to_world'><scale value='0.02'/>" +
                              look_at(p, p + normal, up) +
                              "</transform><bsdf type='diffuse'><float name='reflectance' value='1'/></bsdf></shape>";
    return seen(emitter + paint, p + normal * 0.1 + normalize(cross(normal, up)) * 0.05, p, spp) * std::numbers::pi;
  }

  void put_picture(const std::string& name, const Image& image) const {
    Rendering picture;
    picture.mean = image;
    write_exr((folder_ / name).string(), picture);
  }
  /// Writes two by two texels of the colours (1, 2, 3), (4, 5, 6) and so on.
  void put_four_texels(const std::string& name) const {
    Image image(2, 2);
    for (std::size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = static_cast<float>(i + 1);
    put_picture(name, image);
  }

  static std::string vector(const Vec3d& v) {
    return std::to_string(v.x) + ", " + std::to_string(v.y) + ", " + std::to_string(v.z);
  }
  static std::string look_at(const Vec3d& eye, const Vec3d& target, const Vec3d& up) {
    return "<lookat origin='" + vector(eye) + "' target='" + vector(target) + "' up='" + vector(up) + "'/>";
  }
};

inline void expect_rgb(const RgbD& found, const RgbD& expected, double part = 1e-4) {
  const double tolerance = part * std::max({expected.x, expected.y, expected.z});
  EXPECT_NEAR(found.x, expected.x, tolerance);
  EXPECT_NEAR(found.y, expected.y, tolerance);
  EXPECT_NEAR(found.z, expected.z, tolerance);
}

}  // namespace photonproof::test
