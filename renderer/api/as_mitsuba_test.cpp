// Each departure of Mitsuba 3.9.1 by an image: as it is, the mean is the closed form; as Mitsuba, it is Mitsuba's. The
// latter are means of 16 images of 8192 samples by llvm_ad_rgb on 2026-11-28. Their standard errors are below 0.02 %.
// Scenes and closed forms are those of harness/oracles/mitsuba_departures.py, which derives the forms.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/api/render_scene.h"
#include "scenes/files/test_folder.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline renderer_api {
namespace {

constexpr const char* white = "<emitter type='constant'><float name='radiance' value='1'/></emitter>";
constexpr const char* mirror = "<bsdf type='conductor'><string name='material' value='none'/></bsdf>";

std::string grey(double albedo) {
  return "<bsdf type='diffuse'><float name='reflectance' value='" + std::to_string(albedo) + "'/></bsdf>";
}
std::string wall(const std::string& bsdf) {
  return "<shape type='rectangle'><transform name='to_world'><scale value='4'/></transform>" + bsdf + "</shape>";
}
std::string direct(int emitter_samples, int bsdf_samples) {
  return "<integrator type='direct'><integer name='emitter_samples' value='" + std::to_string(emitter_samples) +
         "'/><integer name='bsdf_samples' value='" + std::to_string(bsdf_samples) + "'/></integrator>";
}
/// An orthographic camera at +z that sees the square from -half to half.
std::string view(double half, double height = 5, const std::string& film = "<rfilter type='box'/>", int width = 8) {
  const std::string scale = std::to_string(half), from = std::to_string(height);
  return "<sensor type='orthographic'><transform name='to_world'><scale x='" + scale + "' y='" + scale +
         "'/><lookat origin='0,0," + from + "' target='0,0,0' up='0,1,0'/></transform><film type='hdrfilm'><integer " +
         "name='width' value='" + std::to_string(width) + "'/><integer name='height' value='8'/>" + film +
         "</film></sensor>";
}

struct Image {
  double mean;
  std::vector<std::string> losses;
  std::map<std::string, std::string> metadata;
};

class Departures : public FolderTest {
 protected:
  Image render(const std::string& content, bool as_mitsuba, std::int64_t spp) const {
    put("scene.xml", "<scene version='3.0.0'>" + content + "</scene>");
    ParseOptions options;
    options.as_mitsuba = as_mitsuba;
    const SceneDescription scene = parse_scene_file((folder_ / "scene.xml").string(), options);
    const Rendered rendered = render_scene(scene, {.budget = {.spp = spp}});
    double sum = 0;
    for (std::size_t i = 1; i < rendered.image.mean.rgb.size(); i += 3)
      sum += static_cast<double>(rendered.image.mean.rgb[i]);
    return {3 * sum / static_cast<double>(rendered.image.mean.rgb.size()),
            rendered.stats.losses,
            {rendered.image.metadata.begin(), rendered.image.metadata.end()}};
  }
  /// Both means are right within 0.2 %, and the second image says what it is.
  void expect(const std::string& content, double closed_form, double of_mitsuba, const std::string& note,
              std::int64_t spp = 4096) const {
    EXPECT_NEAR(render(content, false, spp).mean, closed_form, 0.002 * closed_form);
    const Image followed = render(content, true, spp);
    EXPECT_NEAR(followed.mean, of_mitsuba, 0.002 * of_mitsuba + 1e-9);
    EXPECT_THAT(followed.losses, testing::Contains(testing::HasSubstr("the image follows Mitsuba 3.9.1")));
    EXPECT_THAT(followed.losses, testing::Contains(testing::HasSubstr(note)));
    EXPECT_EQ(followed.metadata.at("photonproof:as_mitsuba"), "3.9.1");
  }
};

TEST_F(Departures, a_checkerboard_as_a_number) {
  expect(view(1) + white +
             wall("<bsdf type='blendbsdf'><texture name='weight' type='checkerboard'><float name='color0' "
                  "value='.25'/><float name='color1' value='.75'/><transform name='to_uv'><scale value='.4'/>"
                  "</transform></texture>" +
                  grey(0.2) + grey(0.8) + "</bsdf>"),
         0.35, 0.65, "swaps its colours");
}

// The sheet has 1/16 of the view. By the matrix its width shrinks by cos 60 and its height grows by 4 - 3 cos 60.
TEST_F(Departures, the_axis_of_a_rotation) {
  expect(view(1) +
             "<shape type='rectangle'><transform name='to_world'><scale value='.25'/><rotate y='2' angle='60'/>"
             "</transform><emitter type='area'><float name='radiance' value='1'/></emitter></shape>",
         0.03125, 0.078125, "not normalised");
}

TEST_F(Departures, samples_of_lights_without_size) {
  const std::string before = view(0.02) + wall(grey(0.5)),
                    placed =
                        "<transform name='to_world'><lookat origin='0,0,5' target='0,0,0' up='0,1,0'/></transform>";
  const std::string lights[] = {
      "<emitter type='directional'><vector name='direction' value='0,0,-1'/><float name='irradiance' "
      "value='2'/></emitter>",
      "<emitter type='point'><point name='position' value='0,0,3'/><float name='intensity' value='18'/></emitter>",
      "<emitter type='spot'>" + placed +
          "<float name='intensity' value='50'/><float name='cutoff_angle' value='40'/></emitter>",
      "<emitter type='projector'>" + placed +
          "<float name='scale' value='15.91549431'/><float name='fov' value='60'/></emitter>"};
  for (const std::string& light : lights) {
    SCOPED_TRACE(light);
    expect(direct(4, 1) + before + light, std::numbers::inv_pi, 1.273347, "4 times as bright", 64);
    expect(direct(1, 1) + before + light, std::numbers::inv_pi, std::numbers::inv_pi, "the image follows", 64);
    expect("<integrator type='path'/>" + before + light, std::numbers::inv_pi, std::numbers::inv_pi,
           "the image follows", 64);
  }
}

TEST_F(Departures, direct_without_samples_of_directions) {
  expect(direct(1, 0) + view(1) + white + wall(mirror), 1, 0, "without samples of directions");
  const std::string holes = "<bsdf type='mask'><float name='opacity' value='.95'/>" + grey(0.6) + "</bsdf>";
  // 0.95 of albedo 0.6, and 0.05 of the sky behind.
  expect(direct(1, 0) + view(1) + white + wall(holes), 0.62, 0.57, "nothing behind this");
}

TEST_F(Departures, mirrors_in_blends) {
  expect(view(1) + white +
             wall("<bsdf type='blendbsdf'><float name='weight' value='.8'/>" + grey(0.5) + mirror + "</bsdf>"),
         0.9, 0.870457, "weighted against the other");
  const std::string glass =
      "<bsdf type='dielectric'><float name='int_ior' value='1.5'/><float name='ext_ior' value='1'/></bsdf>";
  expect(view(1) + white +
             wall("<bsdf type='blendbsdf'><float name='weight' value='.3'/>" + glass + grey(0.5) + "</bsdf>"),
         0.7 * (0.04 + 0.96 / 2.25) + 0.3 * 0.5, 0.465869, "weighted against the other");
}

// Seen at a cosine of 0.5, the diffuse part has the value 0.5 * 0.5 / pi and the density 0.5 / pi; Mitsuba's mean is
// 0.884620 +- 0.000112.
TEST_F(Departures, mirrors_in_blends_from_the_side) {
  const std::string camera =
      "<sensor type='orthographic'><transform name='to_world'><scale x='.5' y='.5'/><lookat origin='0,4.330127,2.5' "
      "target='0,0,0' up='0,1,0'/></transform><film type='hdrfilm'><integer name='width' value='8'/><integer "
      "name='height' value='8'/><rfilter type='box'/></film></sensor>";
  const double density = 0.5 * std::numbers::inv_pi;
  expect(camera + white +
             wall("<bsdf type='blendbsdf'><float name='weight' value='.8'/>" + grey(0.5) + mirror + "</bsdf>"),
         0.9, 0.8 * (0.8 + 0.2 * 0.5 * density) / (0.8 + 0.2 * density) + 0.1, "weighted against the other");
}

// The normals' z falls from 0.8 on the left to -0.4 on the right: rays see light on two thirds of the face. Mitsuba's
// mean is 0.666826 +- 0.000109.
TEST_F(Departures, meshes_are_seen_on_the_side_of_their_vertex_normals) {
  const std::string left = " 0.6 0 0.8\n", right = " 0.9165151 0 -0.4\n";
  put("turning.ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty float "
      "nx\n"
      "property float ny\nproperty float nz\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
      "-1 -1 0" +
          left + "1 -1 0" + right + "1 1 0" + right + "-1 1 0" + left + "3 0 1 2\n3 0 2 3\n");
  expect(view(1) +
             "<shape type='ply'><string name='filename' value='turning.ply'/><emitter type='area'><float "
             "name='radiance' value='1'/></emitter></shape>",
         1, 2.0 / 3, "interpolated normals");
}

TEST_F(Departures, meshes_that_emit_by_their_vertex_normals) {
  const std::string lean = " 0.8660254 0 0.5\n";
  put("leaning.ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty float "
      "nx\n"
      "property float ny\nproperty float nz\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
      "-1 -1 0" +
          lean + "1 -1 0" + lean + "1 1 0" + lean + "-1 1 0" + lean + "3 0 1 2\n3 0 2 3\n");
  const double a = 0.15, corner = a / std::sqrt(1 + a * a);
  expect("<integrator type='path'><integer name='max_depth' value='2'/></integrator>" + view(0.02, 1.9) +
             wall(grey(0.5)) +
             "<shape type='ply'><string name='filename' value='leaning.ply'/><transform name='to_world'><scale "
             "value='.3'/><rotate x='1' angle='180'/><translate z='2'/></transform>" +
             grey(0) + "<emitter type='area'><float name='radiance' value='10'/></emitter></shape>",
         10 * 0.5 * std::numbers::inv_pi * 4 * corner * std::atan(corner), 0.069539, "interpolated normals");
}

TEST_F(Departures, mirrored_meshes_without_normals) {
  put("flat.ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n"
      "property list uchar int vertex_indices\nend_header\n-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n3 0 1 2\n3 0 2 3\n");
  expect(view(1) + white +
             "<shape type='ply'><string name='filename' value='flat.ply'/><transform name='to_world'><scale x='-4' "
             "y='4'/></transform>" +
             grey(0.5) + "</shape>",
         0.5, 0, "inside out");
}

TEST_F(Departures, the_coat_of_plastic) {
  const double fresnel = 1.4 * 1.4 / (3.4 * 3.4);
  expect(view(1) + white +
             wall("<bsdf type='plastic'><float name='int_ior' value='2.4'/><float name='ext_ior' value='1'/></bsdf>"),
         fresnel + (1 - fresnel) * 0.5, 0.596140, "by a fit");
}

// The sheet covers 7 of 16 columns, and of an eighth the part from 0.1375 on.
TEST_F(Departures, a_tent_of_half_a_pixel) {
  expect(view(1, 5, "<rfilter type='tent'><float name='radius' value='.5'/></rfilter>", 16) +
             "<shape type='rectangle'><transform name='to_world'><scale y='4'/><translate x='1.0171875'/></transform>"
             "<emitter type='area'><float name='radiance' value='1'/></emitter></shape>",
         (8 - 0.5 * 0.275 * 0.275) / 16, 0.491445, "is a box");
}

TEST_F(Departures, the_environment_in_channel_a) {
  const std::string scene = view(1, 5, "<rfilter type='box'/><string name='pixel_format' value='rgba'/>") + white +
                            "<shape type='sphere'><float name='radius' value='.3'/></shape>";
  const auto corner = [&](const std::string& integrator, bool as_mitsuba) {
    put("scene.xml", "<scene version='3.0.0'>" + integrator + scene + "</scene>");
    ParseOptions options;
    options.as_mitsuba = as_mitsuba;
    return render_scene(parse_scene_file((folder_ / "scene.xml").string(), options), {.budget = {.spp = 4}})
        .image.alpha.front();
  };
  put("scene.xml", "<scene version='3.0.0'>" + scene + "</scene>");
  ParseOptions followed;
  followed.as_mitsuba = true;
  EXPECT_THAT(
      render_scene(parse_scene_file((folder_ / "scene.xml").string(), followed), {.budget = {.spp = 1}}).stats.losses,
      testing::Contains(testing::HasSubstr("the environment counts in channel A")));
  const std::string hidden = "<integrator type='path'><boolean name='hide_emitters' value='true'/></integrator>";
  EXPECT_EQ(corner("<integrator type='path'/>", false), 0);
  EXPECT_EQ(corner("<integrator type='path'/>", true), 1);
  EXPECT_EQ(corner("<integrator type='volpath'/>", true), 1);
  EXPECT_EQ(corner("<integrator type='direct'/>", true), 0);
  EXPECT_EQ(corner(hidden, true), 0);
}

}  // namespace
}  // namespace photonproof::inline renderer_api
