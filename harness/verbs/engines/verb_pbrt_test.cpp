// Scenes of pbrt-v4 in place of ours: pictures against hand-written scenes, closed forms, and the verbs that take them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scenes/base/process.h"
#include "scenes/files/test_folder.h"
#include "scenes/images/image.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline harness_verbs_engines {
namespace {

namespace fs = std::filesystem;

class PbrtScenes : public FolderTest {
 protected:
  ProcessOutcome run(const std::vector<std::string>& arguments) const {
    std::vector<std::string> argv{PHOTONPROOF_BINARY};
    argv.insert(argv.end(), arguments.begin(), arguments.end());
    return run_process(argv, {.wall_limit_seconds = 120, .working_folder = folder_});
  }
  Rendering rendered(const std::string& file, int spp) const {
    const ProcessOutcome outcome = run({"render", file, "-o", file + ".exr", "--spp", std::to_string(spp)});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.standard_error;
    return read_rendering((folder_ / (file + ".exr")).string());
  }
  Rendering pbrt(const std::string& text, int spp) const {
    put("a.pbrt", text);
    return rendered("a.pbrt", spp);
  }
};

/// A film of 32 x 24 without filter.
const std::string kFilm =
    "Film \"rgb\" \"integer xresolution\" 32 \"integer yresolution\" 24 PixelFilter \"box\" "
    "Integrator \"path\" \"integer maxdepth\" 3\n";

/// The mean square of the pixels' differences over their variances: 1 where both have one mean.
double difference(const Rendering& a, const Rendering& b) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < a.mean.rgb.size(); ++i) {
    const double d = double{a.mean.rgb[i]} - double{b.mean.rgb[i]};
    const double variance = double{a.variance->rgb[i]} + double{b.variance->rgb[i]};
    if (variance <= 0) continue;
    sum += d * d / variance;
    ++count;
  }
  EXPECT_GT(count, 500);
  return sum / count;
}

/// The middle of the pixels above half the brightest one, from the left and from above, as shares of the film.
Vec2<double> bright_place(const Image& image) {
  const float most = *std::max_element(image.rgb.begin(), image.rgb.end());
  Vec2<double> sum;
  double count = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (image.pixel(x, y)[1] > most / 2) sum.x += x + .5, sum.y += y + .5, ++count;
  return {sum.x / count / image.width, sum.y / count / image.height};
}

TEST_F(PbrtScenes, equal_a_scene_that_is_written_by_hand) {
  // A lamp of 1 x 1 at (0.8, 2, 0), a floor, and a red wall at x = 1 that faces it. In pbrt's left-handed world the
  // camera at z = -5 sees +x on the right; so here x is mirrored.
  const Rendering theirs = pbrt(
      "LookAt 0 1 -5  0 1 0  0 1 0 Camera \"perspective\" \"float fov\" 45 " + kFilm +
          "WorldBegin AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [ 5 4 3 ] Translate .8 2 0\n"
          "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] "
          "\"point3 P\" [ -.5 0 -.5  .5 0 -.5  .5 0 .5  -.5 0 .5 ] AttributeEnd\n"
          "Material \"diffuse\" \"rgb reflectance\" [ .6 .6 .6 ]\n"
          "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point3 P\" [ -2 0 -2  2 0 -2  2 0 2  -2 0 2 ]\n"
          "Material \"diffuse\" \"rgb reflectance\" [ .8 .1 .1 ]\n"
          "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point3 P\" [ 1 0 -1  1 1 -1  1 1 1  1 0 1 ]",
      64);
  put("b.xml", R"(<scene version="3.0.0"><integrator type="path"><integer name="max_depth" value="4"/></integrator>
<sensor type="perspective"><float name="fov" value="45"/><string name="fov_axis" value="y"/>
<transform name="to_world"><lookat origin="0,1,-5" target="0,1,0" up="0,1,0"/></transform>
<film type="hdrfilm"><integer name="width" value="32"/><integer name="height" value="24"/><rfilter type="box"/></film></sensor>
<shape type="rectangle"><transform name="to_world"><scale value=".5"/><rotate x="1" angle="90"/><translate x="-.8" y="2"/></transform>
<emitter type="area"><rgb name="radiance" value="5,4,3"/></emitter>
<bsdf type="twosided"><bsdf type="diffuse"/></bsdf></shape>
<shape type="rectangle"><transform name="to_world"><scale value="2"/><rotate x="1" angle="-90"/></transform>
<bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value=".6"/></bsdf></bsdf></shape>
<shape type="rectangle"><transform name="to_world"><scale y=".5"/><rotate y="1" angle="90"/><translate x="-1" y=".5"/></transform>
<bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value=".8,.1,.1"/></bsdf></bsdf></shape></scene>)");
  EXPECT_LT(difference(theirs, rendered("b.xml", 256)), 1.3);
}

TEST_F(PbrtScenes, a_distant_light_on_a_plane_has_its_closed_form) {
  // The radiance is albedo * L * cos / pi = 0.5 * 3 * 0.8 / pi, without noise, on one side of the film's middle alone.
  const Image image = pbrt("Camera \"orthographic\" " + kFilm +
                               "WorldBegin LightSource \"distant\" \"point3 from\" [ 0 3 -4 ] \"point3 to\" [ 0 0 0 ] "
                               "\"rgb L\" [ 3 3 3 ]\n"
                               "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] "
                               "\"point3 P\" [ 0 -9 5  9 -9 5  9 9 5  0 9 5 ]",
                           4)
                          .mean;
  for (int x = 0; x < 32; ++x)
    EXPECT_NEAR(image.pixel(x, 12)[1], x < 16 ? 0 : 0.5 * 3 * 0.8 / std::numbers::pi, 1e-5) << x;
}

TEST_F(PbrtScenes, a_light_shines_on_the_side_of_its_normal) {
  const std::string
      quad = "AreaLightSource \"diffuse\" ",
      shape =
          "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point3 P\" [ -9 -9 5  9 -9 5  9 9 5  -9 9 5 ]";
  const auto seen = [&](const std::string& before) {
    return pbrt("Camera \"perspective\" " + kFilm + "WorldBegin " + before + shape, 1).mean.pixel(16, 12)[1];
  };
  // The cross product of the edges is +z, away from the camera.
  EXPECT_EQ(seen(quad), 0);
  EXPECT_NEAR(seen(quad + "ReverseOrientation "), 1, 1e-5);
  EXPECT_NEAR(seen(quad + "\"bool twosided\" true "), 1, 1e-5);
  EXPECT_EQ(seen(quad + "Scale -1 1 1 "), 0) << "a transform that mirrors turns nothing";
}

TEST_F(PbrtScenes, places_on_the_film_are_those_of_pbrt) {
  // A light of 0.02 at (0.25, 0.25, 1): a quarter from the left and a half from above of [0,1] x [-0.25,0.75].
  const std::string window = "\"float screenwindow\" [ 0 1 -.25 .75 ] ",
                    film = "Film \"rgb\" \"integer xresolution\" 64 \"integer yresolution\" 64 PixelFilter \"box\" ",
                    light =
                        "WorldBegin AreaLightSource \"diffuse\" Translate .25 .25 1 Shape \"sphere\" "
                        "\"float radius\" .02";
  for (const std::string camera : {"Camera \"perspective\" ", "Camera \"orthographic\" "}) {
    const Vec2<double> at = bright_place(pbrt(camera + window + film + light, 16).mean);
    EXPECT_NEAR(at.x, .25, .01) << camera;
    EXPECT_NEAR(at.y, .5, .01) << camera;
  }
  // A field of 90 degrees shows x and y from -1 to 1 at z = 1.
  const Vec2<double> at = bright_place(pbrt("Camera \"perspective\" " + film + light, 16).mean);
  EXPECT_NEAR(at.x, .625, .01);
  EXPECT_NEAR(at.y, .375, .01);
}

TEST_F(PbrtScenes, an_environment_is_seen_where_it_is) {
  // A map that is bright about one point of the square, seen by a camera that looks along +z.
  const double across = std::tan(55 * std::numbers::pi / 180) * 32 / 24, down = std::tan(55 * std::numbers::pi / 180);
  const auto seen = [&](int column, int row, const std::string& turn) {
    Rendering square;
    square.mean = Image(128, 128);
    for (int i = 0; i < 4; ++i)
      for (int c = 0; c < 3; ++c) square.mean.pixel(column - 1 + i % 2, row - 1 + i / 2)[c] = 10;
    write_exr((folder_ / "sky.exr").string(), square);
    const Vec2<double> at = bright_place(pbrt("Camera \"perspective\" \"float fov\" 110 " + kFilm + "WorldBegin " +
                                                  turn + " LightSource \"infinite\" \"string filename\" \"sky.exr\"",
                                              64)
                                             .mean);
    // As tangents to the right and upwards.
    return Vec2<double>{(2 * at.x - 1) * across, (1 - 2 * at.y) * down};
  };
  const auto near = [](const Vec2<double>& at, double x, double y) {
    EXPECT_NEAR(at.x, x, .06);
    EXPECT_NEAR(at.y, y, .06);
  };
  near(seen(64, 64, ""), 0, 0);
  // Half-way to the border r is 1/2, so z is 3/4 and the sine the root of 7/16.
  const double tangent = std::sqrt(7.0 / 16) / .75;
  near(seen(96, 64, ""), tangent, 0);
  near(seen(64, 96, ""), 0, tangent);
  near(seen(32, 64, ""), -tangent, 0);
  // pbrt's Rotate about +z turns +x to +y, about +y it turns +z to +x.
  near(seen(96, 64, "Rotate 90 0 0 1"), 0, tangent);
  near(seen(64, 64, "Rotate 30 0 1 0"), std::tan(std::numbers::pi / 6), 0);
}

TEST_F(PbrtScenes, images_are_seen_upright) {
  // Red above, green to the right below: uv (0,0) is below on the left, as pbrt's camera sees x and y.
  Image image(2, 2);
  for (const int x : {0, 1}) image.pixel(x, 0)[0] = 1;
  image.pixel(1, 1)[1] = 1;
  write_png((folder_ / "i.png").string(), image);
  const Image seen =
      pbrt("Camera \"orthographic\" " + kFilm +
               "WorldBegin LightSource \"infinite\" \"rgb L\" [ 1 1 1 ] Texture \"t\" \"spectrum\" \"imagemap\" "
               "\"string filename\" \"i.png\" \"string filter\" \"point\"\n"
               "Material \"diffuse\" \"texture reflectance\" \"t\" Shape \"trianglemesh\" \"integer indices\" "
               "[ 0 1 2 0 2 3 ] \"point3 P\" [ -1 -1 1  1 -1 1  1 1 1  -1 1 1 ] \"point2 uv\" [ 0 0 1 0 1 1 0 1 ]",
           16)
          .mean;
  EXPECT_GT(seen.pixel(12, 6)[0], .5f);
  EXPECT_GT(seen.pixel(20, 6)[0], .5f);
  EXPECT_LT(seen.pixel(20, 18)[0], .1f);
  EXPECT_GT(seen.pixel(20, 18)[1], .5f);
  EXPECT_LT(seen.pixel(12, 18)[1], .1f);
}

TEST_F(PbrtScenes, all_materials_and_shapes_are_rendered) {
  std::string text = "LookAt 2 2 -9  2 0 0  0 1 0 Camera \"perspective\" " + kFilm +
                     "WorldBegin LightSource \"infinite\" MakeNamedMaterial \"d\" \"string type\" \"diffuse\"\n"
                     "Texture \"f\" \"float\" \"checkerboard\" \"float tex1\" .2 \"float tex2\" .7 ";
  for (const std::string material :
       {"\"diffuse\"", "\"coateddiffuse\"", "\"coateddiffuse\" \"float roughness\" .1", "\"conductor\"",
        "\"conductor\" \"texture roughness\" \"f\"", "\"coatedconductor\" \"float conductor.roughness\" .1",
        "\"dielectric\"", "\"dielectric\" \"float roughness\" .1", "\"thindielectric\"", "\"diffusetransmission\"",
        "\"mix\" \"string materials\" [ \"d\" \"d\" ] \"texture amount\" \"f\"", "\"interface\"",
        "\"diffuse\" \"texture displacement\" \"f\"", "\"subsurface\" \"float roughness\" .2"})
    for (const std::string shape :
         {"\"sphere\"", "\"disk\" \"float innerradius\" .3", "\"cylinder\" \"texture alpha\" \"f\"",
          "\"bilinearmesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 1 1 1 ]"})
      text += "Translate .1 0 .3 Material " + material + " Shape " + shape + "\n";
  text += "ObjectBegin \"o\" Shape \"sphere\" ObjectEnd Scale 1 2 1 ObjectInstance \"o\"";
  const Image image = pbrt(text, 16).mean;
  double sum = 0;
  for (const float v : image.rgb) sum += double{v};
  EXPECT_GT(sum / static_cast<double>(image.rgb.size()), .2);
}

TEST_F(PbrtScenes, an_example_of_several_files_is_rendered_converted_and_measured) {
  fs::copy(PHOTONPROOF_PBRT_EXAMPLE, folder_, fs::copy_options::recursive);
  Image tiles(8, 8);
  for (std::size_t i = 0; i < tiles.rgb.size(); ++i) tiles.rgb[i] = i % 24 < 6 ? .2f : .6f;
  write_png((folder_ / "tiles.png").string(), tiles);
  Rendering sky;
  sky.mean = Image(16, 16);
  std::fill(sky.mean.rgb.begin(), sky.mean.rgb.end(), .7f);
  write_exr((folder_ / "sky.exr").string(), sky);
  const ProcessOutcome outcome = run({"convert", "scene.pbrt", "made"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.standard_error;
  EXPECT_NE(outcome.standard_output.find("note: materials.pbrt:12:1: material 'coateddiffuse' is rendered as plastic"),
            std::string::npos)
      << outcome.standard_output;
  const SceneDescription scene = parse_scene_file((folder_ / "made/scene.xml").string());
  EXPECT_TRUE(scene.notes.empty());
  EXPECT_EQ(scene.shapes.size(), 11u);
  EXPECT_EQ(scene.groups.size(), 1u);
  // The lantern's 60 over pi and its area.
  double power = 0;
  for (const ShapeDescription& shape : scene.shapes)
    if (const auto* ball = std::get_if<SphereDescription>(&shape.geometry); ball != nullptr && shape.radiance) {
      const RgbD c = constant(*shape.radiance);
      power = (.2126 * c.x + .7152 * c.y + .0722 * c.z) * 4 * std::numbers::pi * std::numbers::pi * .18 * .18;
    }
  EXPECT_NEAR(power, 60, .1);
  const ProcessOutcome a = run({"render", "scene.pbrt", "-o", "a.exr", "--size", "64x40", "--spp", "16"});
  const ProcessOutcome b = run({"render", "made/scene.xml", "-o", "b.exr", "--size", "64x40", "--spp", "16"});
  ASSERT_EQ(a.exit_code, 0) << a.standard_error;
  ASSERT_EQ(b.exit_code, 0) << b.standard_error;
  EXPECT_EQ(read_image((folder_ / "a.exr").string()).rgb, read_image((folder_ / "b.exr").string()).rgb);
  put("suite.toml",
      "name = \"s\"\ntitle = \"S\"\n[[scene]]\nname = \"yard\"\npath = \"scene.pbrt\"\nwidth = 32\nheight = 20\n"
      "reference = {engine = \"path\", budget = \"spp=16\", seed = 9}\n"
      "[[run]]\nengine = \"path\"\nbudgets = [\"spp=4\"]\nseeds = [1, 2]\n");
  const ProcessOutcome bench = run({"bench", "suite.toml", "-o", "out"});
  EXPECT_EQ(bench.exit_code, 0) << bench.standard_error << bench.standard_output;
  EXPECT_NE(bench.standard_output.find("3 images measured"), std::string::npos) << bench.standard_output;
}

TEST_F(PbrtScenes, problems_are_told_at_once_and_left_out_when_asked) {
  put("bad.pbrt", "WorldBegin\nLightSource \"infinite\"\nShape \"torus\"\nShape \"sphere\"\nFoo 1\n");
  const ProcessOutcome strict = run({"render", "bad.pbrt", "-o", "a.exr"});
  EXPECT_EQ(strict.exit_code, 2);
  EXPECT_EQ(strict.standard_error,
            "bad.pbrt:3:1: error: Shape 'torus': is not supported, expected trianglemesh, plymesh, bilinearmesh, "
            "loopsubdiv, curve, sphere, disk or cylinder\n"
            "bad.pbrt:5:1: error: unknown directive 'Foo'\n"
            "2 obstacles; --lenient renders the scene without them\n");
  const ProcessOutcome lenient =
      run({"render", "bad.pbrt", "-o", "a.exr", "--lenient", "--size", "16x16", "--spp", "1"});
  EXPECT_EQ(lenient.exit_code, 0) << lenient.standard_error;
  EXPECT_NE(lenient.standard_error.find("bad.pbrt:5:1: warning: left out: unknown directive 'Foo'\n"),
            std::string::npos)
      << lenient.standard_error;
  put("out.pbrt", "WorldBegin Include \"../" + folder_.filename().string() + "/../x.pbrt\"\n");
  EXPECT_NE(run({"render", "out.pbrt", "-o", "a.exr"}).standard_error.find("lies outside the scene's folder"),
            std::string::npos);
}

}  // namespace
}  // namespace photonproof::inline harness_verbs_engines
