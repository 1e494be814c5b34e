// Beams: light that leaves a flat shape along its normal, against closed forms, by every integrator.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/api/render_scene.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline renderer_api {
namespace {

using std::numbers::pi;

/// An orthographic camera at z = 2 that sees the square [-1,1]^2 of the plane z = 0 in 4 x 4 pixels.
constexpr const char* camera =
    "<sensor type='orthographic'><transform name='to_world'><lookat origin='0,0,2' target='0,0,0' up='0,1,0'/>"
    "</transform><film type='hdrfilm'><integer name='width' value='4'/><integer name='height' value='4'/>"
    "<rfilter type='box'/></film></sensor>";

std::string floor(const std::string& place = "") {
  return "<shape type='rectangle'><transform name='to_world'><scale value='8'/>" + place +
         "</transform><bsdf type='diffuse'><float name='reflectance' value='0.5'/></bsdf></shape>";
}
std::string beam(const std::string& shape, const std::string& place) {
  return "<shape type='" + shape + "'><transform name='to_world'>" + place +
         "</transform><bsdf type='null'/><emitter type='directionalarea'><rgb name='radiance' value='4,8,6'/></emitter>"
         "</shape>";
}
/// To z = 3, from where the front shines down.
const std::string above = "<rotate y='1' angle='180'/><translate z='3'/>";

Image rendered(const std::string& content, const std::string& integrator, std::int64_t spp) {
  const SceneDescription scene =
      parse_scene_text("<scene version='3.0.0'>" + std::string(camera) + content + "</scene>", "test.xml");
  RenderRequest request{.budget = {.spp = spp}};
  request.integrator = integrator;
  return render_scene(scene, request).image.mean;
}

double mean_of(const Image& image, std::size_t channel) {
  double sum = 0;
  for (std::size_t i = channel; i < image.rgb.size(); i += 3) sum += double{image.rgb[i]};
  return 3 * sum / static_cast<double>(image.rgb.size());
}

TEST(beams, light_the_foot_of_their_shape_alone) {
  // The floor's radiance is albedo E / pi where the beam falls, on the quarter x > 0, y > 0 of the view.
  const std::string scene =
      beam("rectangle", "<scale value='0.5'/>" + above + "<translate x='0.5' y='0.5'/>") + floor();
  for (const char* integrator : {"path", "volpath", "direct", "whitted"}) {
    const Image image = rendered(scene, integrator, 64);
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 4; ++x) {
        const bool lit = x >= 2 && y < 2;
        EXPECT_NEAR(image.pixel(x, y)[0], lit ? 2 / pi : 0, 1e-5) << integrator << x << y;
        EXPECT_NEAR(image.pixel(x, y)[1], lit ? 4 / pi : 0, 1e-5) << integrator << x << y;
      }
  }
}

TEST(beams, carry_their_flux_to_every_integrator) {
  // The floor is tilted by 60 degrees, so that its irradiance is half of the beam's. The view is along the beam and
  // sees its section, a disk of area pi/4 in the area 4.
  const std::string scene = beam("disk", "<scale value='0.5'/>" + above) + floor("<rotate x='1' angle='60'/>");
  const double right = 0.5 * 4 * 0.5 / pi * (pi / 4) / 4;
  for (const char* integrator : {"path", "volpath", "bdpt", "ptracer", "photonmapper"}) {
    const Image image = rendered(scene, integrator, integrator == std::string("photonmapper") ? 256 : 16384);
    EXPECT_NEAR(mean_of(image, 0), right, 0.01 * right) << integrator;
    EXPECT_NEAR(mean_of(image, 2), 1.5 * right, 0.015 * right) << integrator;
  }
}

TEST(beams, light_by_a_mirror_what_photons_find) {
  // A mirror at 45 degrees turns the horizontal beam down: the whole section 1 x 1 falls on the floor.
  const std::string mirror =
      "<shape type='rectangle'><transform name='to_world'><rotate y='1' angle='-45'/><translate z='3'/></transform>"
      "<bsdf type='twosided'><bsdf type='conductor'><string name='material' value='none'/></bsdf></bsdf></shape>";
  const std::string scene =
      beam("rectangle", "<scale value='0.5'/><rotate y='1' angle='-90'/><translate x='3' z='3'/>") + mirror + floor();
  const double right = 0.5 * 4 / pi / 4;
  for (const char* integrator : {"ptracer", "bdpt", "photonmapper"}) {
    const SceneDescription described =
        parse_scene_text("<scene version='3.0.0'>" + std::string(camera) + scene + "</scene>", "test.xml");
    RenderRequest request{.budget = {.spp = integrator == std::string("photonmapper") ? 64 : 16384}};
    request.integrator = integrator;
    EXPECT_NEAR(mean_of(render_scene(described, request).image.mean, 0), right, 0.02 * right) << integrator;
  }
}

TEST(beams, are_dimmed_by_the_fog_between_and_no_more) {
  // The fog around everything absorbs 0.2 a unit. From the shape at z = 3 to the floor light crosses 3, to the
  // camera 5.
  const std::string fog =
      "<medium type='homogeneous' id='fog'><float name='sigma_t' value='0.2'/><float name='albedo' value='0'/></medium>"
      "<shape type='sphere'><float name='radius' value='30'/><bsdf type='null'/><ref id='fog' "
      "name='interior'/></shape>";
  const std::string in_fog =
      std::string(camera).replace(std::string(camera).find("<film"), 0, "<ref name='medium' id='fog'/>");
  for (const char* integrator : {"volpath", "bdpt", "ptracer"}) {
    const SceneDescription scene =
        parse_scene_text("<scene version='3.0.0'>" + in_fog + fog + beam("rectangle", "<scale value='2'/>" + above) +
                             floor() + "</scene>",
                         "test.xml");
    RenderRequest request{.budget = {.spp = 4096}};
    request.integrator = integrator;
    const double right = 0.5 * 4 / pi * std::exp(-0.2 * 5);
    EXPECT_NEAR(mean_of(render_scene(scene, request).image.mean, 0), right, 0.01 * right) << integrator;
  }
}

TEST(beams, are_not_seen_themselves) {
  const std::string scene =
      "<shape type='rectangle'><bsdf type='diffuse'><float name='reflectance' value='0'/></bsdf>"
      "<emitter type='directionalarea'/></shape>";
  for (const char* integrator : {"path", "volpath", "bdpt", "ptracer", "photonmapper"})
    EXPECT_EQ(mean_of(rendered(scene, integrator, 16), 0), 0) << integrator;
}

TEST(beams, leave_from_the_front_alone) {
  // The shape at z = 3 faces up.
  const std::string scene = beam("disk", "<translate z='3'/>") + floor();
  for (const char* integrator : {"path", "volpath", "bdpt", "ptracer", "photonmapper"})
    EXPECT_EQ(mean_of(rendered(scene, integrator, 16), 0), 0) << integrator;
  const std::string fog =
      "<shape type='sphere'><bsdf type='null'/><medium type='homogeneous' name='interior'/></shape>";
  EXPECT_EQ(mean_of(rendered(beam("disk", "<translate z='3'/>") + fog, "volpath", 16), 0), 0);
  EXPECT_GT(mean_of(rendered(beam("disk", above) + fog, "volpath", 16), 0), 0);
}

}  // namespace
}  // namespace photonproof::inline renderer_api
