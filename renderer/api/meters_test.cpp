// Sensors that measure, and batches of cameras, against closed forms, by every integrator that does them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/api/render_scene.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline renderer_api {
namespace {

using std::numbers::pi;

constexpr const char* film =
    "<film type='hdrfilm'><integer name='width' value='1'/><integer name='height' value='1'/></film>";
constexpr const char* black = "<bsdf type='diffuse'><float name='reflectance' value='0'/></bsdf>";

std::string lamp(const std::string& type, const std::string& place, double radiance) {
  return "<shape type='" + type + "'><transform name='to_world'>" + place + "</transform>" + black +
         "<emitter type='area'><float name='radiance' value='" + std::to_string(radiance) + "'/></emitter></shape>";
}
std::string sensor(const std::string& type, const std::string& content) {
  return "<sensor type='" + type + "'>" + content + film + "</sensor>";
}

/// The mean of the green channel.
double rendered(const std::string& content, const std::string& integrator, std::int64_t spp = 262144) {
  const SceneDescription scene = parse_scene_text("<scene version='3.0.0'>" + content + "</scene>", "test.xml");
  RenderRequest request{.budget = {.spp = spp}};
  request.integrator = integrator;
  const std::vector<float> rgb = render_scene(scene, request).image.mean.rgb;
  double sum = 0;
  for (std::size_t i = 1; i < rgb.size(); i += 3) sum += double{rgb[i]};
  return 3 * sum / static_cast<double>(rgb.size());
}

const std::vector<std::string> integrators = {"path", "direct", "volpath", "whitted", "photonmapper"};

/// The mean by every integrator is right within 0.5 %.
void expect(const std::string& content, double right) {
  for (const std::string& integrator : integrators)
    EXPECT_NEAR(rendered(content, integrator), right, 0.005 * right) << integrator;
}

TEST(radiancemeter, sees_what_its_ray_meets) {
  // The ray meets the nearer lamp 0.05 within its edge at x = 1; without it, the farther one.
  const std::string meter = sensor(
      "radiancemeter", "<point name='origin' x='0.95' y='0.3' z='5'/><vector name='direction' x='0' y='0' z='-2'/>");
  const std::string far = lamp("rectangle", "<scale value='3'/><translate z='-1'/>", 7);
  expect(meter + lamp("rectangle", "", 2) + far, 2);
  expect(meter + lamp("rectangle", "<translate x='-0.1'/>", 2) + far, 7);
}

TEST(distant, sees_a_point_an_area_or_all_shapes_from_afar) {
  const std::string down = "<vector name='direction' x='0' y='0' z='-1'/>",
                    square = lamp("rectangle", "<scale value='0.5'/>", 2);
  expect(sensor("distant", down + "<point name='target' x='0.49' y='0.49' z='-0.3'/>") + square, 2);
  EXPECT_EQ(rendered(sensor("distant", down + "<point name='target' x='0.51' y='0' z='-0.3'/>") + square, "path", 64),
            0);
  // The lamp covers a quarter of the area 4 of the square, and 1 of the area pi of the disk of radius 1. Tilted by 60
  // degrees about y, the square is half as wide.
  const auto aimed = [&](const std::string& shape, const std::string& place) {
    return sensor("distant", down + "<shape type='" + shape + "' name='target'><transform name='to_world'>" + place +
                                 "</transform></shape>");
  };
  expect(aimed("rectangle", "") + square, 2.0 / 4);
  expect(aimed("disk", "") + square, 2 / pi);
  expect(aimed("rectangle", "<rotate y='1' angle='60'/>") + square, 2.0 / 2);
  expect(aimed("disk", "<scale x='2' y='1'/>") + square, 2 / (2 * pi));
  // The ball around the lamp alone has the radius sqrt(1/2), and its disc the area pi/2.
  // A lamp of radius 1 above hides a part of area pi. The box is then [-1,1] x [-1,1] x [0,4], the disc's radius
  // sqrt(6).
  expect(sensor("distant", down) + square, 2 / (pi / 2));
  expect(sensor("distant", down) + lamp("rectangle", "", 2) + lamp("sphere", "<translate z='3'/>", 5),
         (5 * pi + 2 * (4 - pi)) / (6 * pi));
}

TEST(irradiancemeter, integrates_radiance_over_its_front) {
  // A ball of radiance L and radius r at the distance d of a small area is seen as E = pi L (r/d)^2 cos.
  const std::string ball = lamp("sphere", "<scale value='1.6'/><translate z='2'/>", 4);
  const auto meter = [&](const std::string& shape, const std::string& place, const std::string& content = "") {
    return "<shape type='" + shape + "'><transform name='to_world'>" + place + "</transform>" + content + black +
           sensor("irradiancemeter", "") + "</shape>";
  };
  const std::string small = "<scale value='0.001'/>", flip = "<boolean name='flip_normals' value='true'/>";
  const double right = pi * 4 * 0.64;
  expect(meter("disk", small) + ball, right);
  expect(meter("rectangle", small + "<rotate y='1' angle='30'/>") + ball, right * std::sqrt(0.75));
  expect(meter("rectangle", small + "<rotate y='1' angle='180'/>", flip) + ball, right);
  expect(meter("rectangle", "<scale x='-0.001' y='0.001' z='0.001'/>") + ball, right);  // mirrored
  EXPECT_EQ(rendered(meter("disk", small, flip) + ball, "path", 256), 0);
  // In a uniform sky every point has pi L, whatever the size.
  const std::string sky = "<emitter type='constant'><float name='radiance' value='0.25'/></emitter>";
  for (const char* shape : {"rectangle", "disk"})
    for (const std::string& integrator : integrators)
      EXPECT_NEAR(rendered(meter(shape, "<scale x='300' y='20'/>") + sky, integrator, 1024), pi / 4, 1e-5)
          << integrator;
}

TEST(irradiancemeter, gives_the_error_of_the_irradiance) {
  const std::string content = "<shape type='disk'>" + std::string(black) + sensor("irradiancemeter", "") + "</shape>" +
                              lamp("sphere", "<scale value='0.5'/><translate z='2'/>", 4);
  const SceneDescription scene = parse_scene_text("<scene version='3.0.0'>" + content + "</scene>", "test.xml");
  const Rendering image = render_scene(scene, {.budget = {.spp = 4096}}).image;
  ASSERT_TRUE(image.variance);
  // A direction meets the ball or not, so that the samples x of the radiance have the mean square 4 E[x]. The variance
  // of pi times their mean is pi^2 (4 E[x] - E[x]^2) / n, at 4096 samples within a third.
  const double mean = double{image.mean.rgb[0]} / pi, variance = pi * pi * (4 * mean - mean * mean) / 4096;
  EXPECT_NEAR(double{image.variance->rgb[0]}, variance, variance / 3);
}

TEST(batch, shows_each_camera_on_its_columns) {
  const auto camera = [](const char* type, const std::string& from) {
    return "<sensor type='" + std::string(type) + "'><transform name='to_world'><lookat origin='" + from +
           ",5' target='" + from + ",0' up='0,1,0'/></transform></sensor>";
  };
  const std::string two =
      "<film type='hdrfilm'><integer name='width' value='4'/><integer name='height' value='2'/>"
      "<rfilter type='box'/></film>";
  const std::string lamps =
      lamp("rectangle", "<scale value='10'/>", 2) + lamp("rectangle", "<scale value='10'/><translate x='50'/>", 5);
  const SceneDescription scene =
      parse_scene_text("<scene version='3.0.0'><sensor type='batch'>" + camera("perspective", "0,0") +
                           camera("orthographic", "50,0") + two + "</sensor>" + lamps + "</scene>",
                       "test.xml");
  for (const std::string& integrator : integrators) {
    RenderRequest request{.budget = {.spp = 16}};
    request.integrator = integrator;
    const Image image = render_scene(scene, request).image.mean;
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 4; ++x) EXPECT_FLOAT_EQ(image.pixel(x, y)[0], x < 2 ? 2 : 5) << integrator << x << y;
  }
}

TEST(meters, are_refused_by_integrators_that_connect_to_cameras) {
  const std::string scene =
      sensor("radiancemeter", "<point name='origin' x='0' y='0' z='5'/><vector name='direction' x='0' y='0' z='-1'/>") +
      lamp("rectangle", "", 2);
  for (const std::string integrator : {"bdpt", "ptracer"}) {
    try {
      rendered(scene, integrator, 1);
      ADD_FAILURE() << integrator;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what())
                    .find("integrator '" + integrator + "' does not do sensors other than single cameras: use 'path'"),
                std::string::npos)
          << error.what();
    }
  }
}

TEST(batch, is_refused_where_its_cameras_may_be_in_different_media) {
  const std::string camera = "<sensor type='perspective'/>", lit = lamp("rectangle", "", 2);
  const std::string fog =
      "<shape type='sphere'><bsdf type='null'/><medium type='homogeneous' name='interior'/></shape>";
  const std::string glass =
      "<shape type='sphere'><bsdf type='dielectric'><integer name='priority' value='1'/></bsdf></shape>";
  for (const std::string& content : {fog, glass}) {
    try {
      rendered("<sensor type='batch'>" + camera + camera + "</sensor>" + lit + content, "volpath", 1);
      ADD_FAILURE();
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("a batch cannot be in a scene with media or priorities of dielectrics"),
                std::string::npos)
          << error.what();
    }
  }
}

TEST(meters, are_refused_where_photons_are_to_be_seen) {
  const SceneDescription scene = parse_scene_text(
      "<scene version='3.0.0'>" + sensor("distant", "") + lamp("rectangle", "", 2) + "</scene>", "test.xml");
  RenderRequest request{.budget = {.spp = 1}};
  request.integrator = "photonmapper";
  request.view = Aov::photons;
  EXPECT_THROW(render_scene(scene, request), InputError);
}

}  // namespace
}  // namespace photonproof::inline renderer_api
