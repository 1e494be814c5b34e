// POV-Ray's image of lights that are thinner than its pixels.

#include <gtest/gtest.h>

#include "reference/povray/povray_engine.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline reference_povray {
namespace {

/// A light of albedo 0 and radiance 100 that faces an eye 10 away, 1 by `height` pixels of a 16 x 16 image. At this
/// field of view a pixel is 0.1 wide there. The light lies between two rows of pixel corners, and between two columns.
SceneDescription light(double height) {
  const std::string text = R"(<scene version="3.0.0"><integrator type="path"/>
    <sensor type="perspective"><float name="fov" value="9.147842"/><string name="fov_axis" value="y"/>
      <transform name="to_world"><lookat origin="0, 0, 10" target="0, 0, 0" up="0, 1, 0"/></transform>
      <film type="hdrfilm"><integer name="width" value="16"/><integer name="height" value="16"/>
        <rfilter type="box"/></film></sensor>
    <bsdf type="diffuse" id="black"><rgb name="reflectance" value="0"/></bsdf>
    <shape type="rectangle"><transform name="to_world"><scale x="0.045" y=")" +
                           std::to_string(height * 0.05) + R"("/><translate x="0.15" y="0.253"/></transform>
      <ref id="black"/><emitter type="area"><rgb name="radiance" value="100"/></emitter></shape></scene>)";
  return parse_scene_text(text, "lamp.xml");
}

/// Radiance times pixels.
double flux(const Image& image) {
  double sum = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) sum += double{image.rgb[i]};
  return sum;
}

// A light of 0.9 x 0.25 pixels has 100 x 0.225 in it, wherever it lies. POV-Ray alone sees nothing of it: its corners
// are black. The grid of 13 and its refinement by 16 put an edge to within 1/208 pixel: 2 x 0.0048 / 0.25 = 4 %.
TEST(povray_lights, of_a_quarter_of_a_pixel_keep_their_light) {
  const SceneDescription scene = light(0.25);
  PovrayOptions options{.width = 16, .height = 16};
  EXPECT_EQ(flux(render_povray(export_povray(scene, options)).rendering.mean), 0);
  options.lights_apart = true;
  EXPECT_NEAR(flux(render_povray(export_povray(scene, options)).rendering.mean), 22.5, 0.04 * 22.5);
}

TEST(povray_lights, are_rendered_besides_only_where_they_are_thin_in_the_picture) {
  const PovrayExport thin = export_povray(light(0.25), {.width = 16, .height = 16, .lights_apart = true});
  ASSERT_EQ(thin.besides.size(), 1u);
  // 0.225 pixels over a diagonal of 0.934 are 0.241 across: 3 / 0.241 = 12.4.
  EXPECT_EQ(thin.besides[0].grid, 13) << "three pixels of it across the light";
  EXPECT_EQ(thin.besides[0].sdl.str().find("\nSpot("), std::string::npos) << "nothing is lit";
  EXPECT_NE(thin.sdl.str().find("emission rgb 0}"), std::string::npos) << "it is not counted twice";
  EXPECT_TRUE(export_povray(light(0.25), {.width = 256, .height = 256, .lights_apart = true}).besides.empty());
  EXPECT_TRUE(export_povray(light(0.25), {.width = 16, .height = 16, .grid = 8, .lights_apart = true}).besides.empty());
}

}  // namespace
}  // namespace photonproof::inline reference_povray
