// A scene's obstacles are told together, or left out. Scenes without a sensor or a light, scenes with several sensors,
// and spectra with a type.
#include "scenes/xml/obstacles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "scenes/description/spectrum.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline scenes_parser {
namespace {

const std::string kSensor = "<sensor type='perspective'/>", kLight = "<emitter type='point'/>";

SceneDescription parse(const std::string& content, const ParseOptions& options = {}) {
  return parse_scene_text("<scene version='3.0.0'>\n" + content + "</scene>", "test.xml", options);
}

std::string report_of(const std::string& content) {
  try {
    parse(content);
    return "";
  } catch (const InputError& error) {
    return error.report();
  }
}

TEST(obstacles, are_told_together_in_the_order_of_the_file_and_once_a_text) {
  EXPECT_EQ(
      report_of(
          "<emitter type='candle'/>\n<shape type='sphere'><float name='radius' value='-1'/></shape>\n"
          "<emitter type='candle'/>\n<emitter type='candle'/>\n<emitter type='candle'/>\n<emitter type='candle'/>\n"),
      "test.xml:2:10: error: emitter 'candle' is not supported, expected constant, directional, envmap, ies, point, "
      "projector, spot or sunsky, and at test.xml:4:10, test.xml:5:10, test.xml:6:10 and 1 more places\n"
      "test.xml:3:43: error: parameter 'radius' of shape 'sphere' is -1, expected more than 0\n"
      "6 obstacles; --lenient renders the scene without them");
}

TEST(obstacles, of_a_value_leave_the_others_of_its_object) {
  const std::string text =
      "<sensor type='perspective'><float name='fov' value='x'/><float name='near_clip' value='.5'/></sensor>" + kLight;
  EXPECT_EQ(report_of(text).substr(0, 62), "test.xml:2:46: error: parameter 'fov' of sensor 'perspective' ");
  ParseOptions lenient;
  lenient.lenient = true;
  const auto camera = std::get<PerspectiveDescription>(parse(text, lenient).sensor.camera);
  EXPECT_EQ(camera.near_clip, .5);
}

TEST(lenient, leaves_out_what_cannot_be_read_with_a_note) {
  ParseOptions lenient;
  lenient.lenient = true;
  const SceneDescription scene =
      parse(kSensor + kLight +
                "<shape type='cube'/><shape type='teapot'/><shape type='sphere'><bsdf type='velvet'/><float "
                "name='size' value='2'/></shape>"
                "<shape type='ply'><string name='filename' value='missing.ply'/></shape><bsdf type='twosided' "
                "id='t'><ref id='nothing'/></bsdf>",
            lenient);
  ASSERT_EQ(scene.shapes.size(), 2u) << "cube and sphere";
  EXPECT_EQ(scene.bsdfs[scene.shapes[1].bsdf.value].model, decltype(BsdfDescription::model)(DiffuseDescription{}));
  ASSERT_EQ(scene.notes.size(), 5u);
  EXPECT_EQ(scene.notes[0].text.substr(0, 37), "left out: nothing has the id 'nothing");
  for (const SceneNote& note : scene.notes) EXPECT_EQ(note.text.substr(0, 10), "left out: ");
}

TEST(lenient, still_refuses_what_is_no_scene) {
  ParseOptions lenient;
  lenient.lenient = true;
  EXPECT_THROW(parse_scene_text("<scene version='3.0.0'>", "a.xml", lenient), InputError);
  EXPECT_THROW(parse_scene_text("<bsdf version='3.0.0'/>", "a.xml", lenient), InputError);
}

TEST(sensors, are_chosen_by_number) {
  const std::string two = kLight + "<sensor type='orthographic'/><sensor type='perspective' id='second'/>";
  EXPECT_TRUE(std::holds_alternative<OrthographicDescription>(parse(two).sensor.camera));
  ParseOptions second;
  second.sensor = 1;
  EXPECT_EQ(parse(two, second).sensor.id, "second");
  EXPECT_EQ(parse(two, second).defines, std::vector<std::string>{"--sensor=1"}) << "another image has another hash";
  second.sensor = 2;
  try {
    parse(two, second);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.summary(), "--sensor: error: 2 is not a sensor of the scene, expected 0 to 1");
  }
}

TEST(sensors, see_the_whole_scene_where_the_file_has_none) {
  const SceneDescription scene = parse(
      kLight + "<shape type='sphere'><float name='radius' value='2'/><point name='center' x='1' y='2' z='3'/></shape>");
  EXPECT_EQ(scene.notes.size(), 1u);
  const Vec3d eye = scene.sensor.to_world.point({0, 0, 0});
  // Extent 4 fills 45 degrees at 2 / tan(22.5 degrees) before z = 1.
  EXPECT_NEAR(eye.x, 1, 1e-12);
  EXPECT_NEAR(eye.y, 2, 1e-12);
  EXPECT_NEAR(eye.z, 1 - 2 / std::tan(std::acos(-1.0) / 8), 1e-12);
}

TEST(scene, without_light_gets_a_note) {
  EXPECT_EQ(parse(kSensor).notes.at(0).text, "the scene has no light: its image is black");
  EXPECT_TRUE(parse(kSensor + kLight).notes.empty());
}

RgbD radiance(const std::string& type, const std::string& content) {
  const auto scene = parse(kSensor + "<emitter type='constant'><spectrum name='radiance' type='" + type + "'>" +
                           content + "</spectrum></emitter>");
  return std::get<ConstantLightDescription>(scene.emitters[0].light).radiance;
}

TEST(typed_spectra, are_those_of_mitsuba) {
  EXPECT_EQ(radiance("uniform", "<float name='value' value='2'/>"), RgbD(2.0));
  EXPECT_EQ(radiance("d65", "<float name='scale' value='3'/>"), RgbD(3.0));
  EXPECT_EQ(radiance("d65", "<rgb name='color' value='1 2 0'/><float name='scale' value='3'/>"), RgbD(3, 6, 0));
  EXPECT_EQ(radiance("srgb", "<rgb name='color' value='.2 .4 .6'/>"), RgbD(.2, .4, .6));
  const RgbD pairs = rgb_of_spectrum({{400, 1}, {550, 2}, {700, 1}}, SpectrumKind::emission);
  EXPECT_EQ(radiance("regular",
                     "<float name='wavelength_min' value='400'/><float name='wavelength_max' value='700'/>"
                     "<string name='values' value='1, 2, 1'/>"),
            pairs);
  EXPECT_EQ(
      radiance("irregular", "<string name='wavelengths' value='400, 550, 700'/><string name='values' value='1 2 1'/>"),
      pairs);
}

TEST(typed_spectra, of_black_bodies_have_plancks_radiance_and_colour) {
  // CIE 1931 chromaticities of Planck's law, Wyszecki and Stiles 1982, table 1(3.11): 2856 K is illuminant A.
  for (const auto& [kelvin, x, y] : {std::tuple{2856, .4476, .4074}, std::tuple{6500, .3135, .3237}}) {
    const RgbD rgb = radiance("blackbody", "<float name='temperature' value='" + std::to_string(kelvin) + "'/>");
    // Rec. 709's primaries and white, IEC 61966-2-1.
    const Vec3d xyz = {.4124 * rgb.x + .3576 * rgb.y + .1805 * rgb.z, .2126 * rgb.x + .7152 * rgb.y + .0722 * rgb.z,
                       .0193 * rgb.x + .1192 * rgb.y + .9505 * rgb.z};
    const double sum = xyz.x + xyz.y + xyz.z;
    EXPECT_NEAR(xyz.x / sum, x, 1e-3) << kelvin;
    EXPECT_NEAR(xyz.y / sum, y, 1e-3) << kelvin;
  }
  // The candela was defined by a black body at the freezing point of platinum, 2042 K: 60 cd/cm^2 (CGPM 1948). Radiance
  // here is a nm's, times the integral of the observer.
  const RgbD platinum = radiance("blackbody", "<float name='temperature' value='2042'/>");
  const double luminance = .2126 * platinum.x + .7152 * platinum.y + .0722 * platinum.z;
  EXPECT_NEAR(683 * luminance * cie_y_integral, 6e5, 6e3);
}

TEST(spellings, of_mitsuba_are_read) {
  EXPECT_NO_THROW(parse_scene_text(
      "<?xml version='1.0'?><!DOCTYPE scene><scene version='2.1.0' id='s'>" + kSensor + kLight + "</scene>", "a.xml"));
  const auto scene = parse(kSensor + "<emitter type='area' id='lamp'/><shape type='cube'><ref id='lamp'/></shape>");
  EXPECT_TRUE(scene.shapes[0].radiance.has_value());
  const auto mask = parse(kSensor + kLight +
                          "<bsdf type='mask' id='m'><rgb name='opacity' value='1 0 0'/><bsdf type='diffuse'/></bsdf>");
  EXPECT_NEAR(std::get<double>(std::get<MaskDescription>(mask.bsdfs.back().model).opacity), .2126, 1e-4);
  const auto inner = parse(kSensor + kLight + "<integrator type='moment'><integrator type='direct'/></integrator>");
  EXPECT_TRUE(std::holds_alternative<DirectDescription>(inner.integrator.method));
}

TEST(spellings, of_a_lookat_without_up_stand_on_mitsubas_basis) {
  // Duff et al. 2017 for n = (0, 0, -1): the first tangent is (1, 0, 0), and lookat's +y lies along it.
  const auto scene = parse(
      "<sensor type='perspective'><transform name='to_world'><lookat origin='0,0,5' "
      "target='0,0,0'/></transform></sensor>" +
      kLight);
  const Vec3d up = scene.sensor.to_world.vector({0, 1, 0});
  EXPECT_NEAR(up.x, 1, 1e-12);
  EXPECT_NEAR(up.y, 0, 1e-12);
}

TEST(spellings, of_a_metal_in_glass_divide_its_index) {
  const auto metal = [](const std::string& more) {
    const auto scene = parse(kSensor + kLight +
                             "<bsdf type='conductor' id='m'><rgb name='eta' value='1.5'/><rgb name='k' value='3'/>" +
                             more + "</bsdf>");
    return *std::get<ConductorDescription>(scene.bsdfs[0].model).ior;
  };
  EXPECT_EQ(metal("<float name='ext_eta' value='1.5'/>"), (ComplexIor{RgbD(1.0), RgbD(2.0)}));
  EXPECT_EQ(metal(""), (ComplexIor{RgbD(1.5), RgbD(3.0)}));
}

}  // namespace
}  // namespace photonproof::inline scenes_parser
