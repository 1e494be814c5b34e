#include "scenes/parser/parser.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <string>

#include "scenes/base/input_error.h"

namespace photonproof::inline scenes_parser {
namespace {

/// A scene around `content`: a sensor and a light beside it, so that only `content` matters.
SceneDescription parse(const std::string& content, const ParseOptions& options = {}) {
  return parse_scene_text(
      "<scene version=\"3.0.0\"><sensor type=\"perspective\"><film type=\"hdrfilm\">"
      "<rfilter type=\"box\"/></film></sensor><emitter type=\"point\"/>" +
          content + "</scene>",
      "test.xml", options);
}

template <class Model>
Model bsdf(const std::string& type, const std::string& parameters) {
  const auto scene = parse("<bsdf id='b' type='" + type + "'>" + parameters + "</bsdf>");
  return std::get<Model>(scene.bsdfs.at(0).model);
}

RgbD reflectance(const std::string& parameter) {
  return constant(bsdf<DiffuseDescription>("diffuse", parameter).reflectance);
}

ShapeDescription shape(const std::string& type, const std::string& content) {
  return parse("<shape type='" + type + "'>" + content + "</shape>").shapes.at(0);
}

Transform to_world(const std::string& operations) {
  return shape("cube", "<transform name='to_world'>" + operations + "</transform>").to_world;
}

SceneDescription with_sensor(const std::string& parameters, const std::string& film = "",
                             const std::string& sampler = "") {
  return parse_scene_text("<scene version=\"3.0.0\"><emitter type=\"point\"/><sensor type=\"perspective\">" +
                              parameters + "<film type=\"hdrfilm\"><rfilter type=\"box\"/>" + film + "</film>" +
                              sampler + "</sensor></scene>",
                          "test.xml");
}

PerspectiveDescription camera(const std::string& parameters) {
  return std::get<PerspectiveDescription>(with_sensor(parameters).sensor.camera);
}

template <class Method>
Method integrator(const std::string& type, const std::string& parameters) {
  const auto scene = parse("<integrator type='" + type + "'>" + parameters + "</integrator>");
  return std::get<Method>(scene.integrator.method);
}

TEST(parser, gives_mitsubas_defaults) {
  const SceneDescription scene = parse("<shape type='sphere'/>");
  EXPECT_EQ(std::get<PathDescription>(scene.integrator.method), PathDescription{});
  EXPECT_EQ(scene.sensor.film, (FilmDescription{768, 576}));
  EXPECT_EQ(scene.sensor.sample_count, 4);
  EXPECT_EQ(scene.sensor.to_world, Transform());
  EXPECT_EQ(std::get<PointLightDescription>(scene.emitters[0].light), PointLightDescription{});
  EXPECT_EQ(std::get<SphereDescription>(scene.shapes[0].geometry), SphereDescription{});
  EXPECT_FALSE(scene.shapes[0].flip_normals);
  EXPECT_FALSE(scene.shapes[0].radiance.has_value());
  EXPECT_EQ(std::get<DiffuseDescription>(scene.bsdfs[scene.shapes[0].bsdf.value].model), DiffuseDescription{});
  EXPECT_EQ(bsdf<DielectricDescription>("dielectric", ""),
            (DielectricDescription{1.5046, 1.000277, RgbD(1.0), RgbD(1.0)}));
}

TEST(parser, reads_colours_in_every_form) {
  EXPECT_EQ(reflectance("<rgb name='reflectance' value='0.1, 0.2 0.3'/>"), RgbD(0.1, 0.2, 0.3));
  EXPECT_EQ(reflectance("<rgb name='reflectance' value='0.25'/>"), RgbD(0.25));
  EXPECT_EQ(reflectance("<spectrum name='reflectance' value='0.25'/>"), RgbD(0.25));
  EXPECT_EQ(reflectance("<float name='reflectance' value='0.25'/>"), RgbD(0.25));
  // sRGB codes: 0 and 255 are 0 and 1; 0x80 = 128/255 = 0.50196, ((0.50196 + 0.055) / 1.055)^2.4 = 0.21586.
  const RgbD hex = reflectance("<rgb name='reflectance' value='#00fF80'/>");
  EXPECT_EQ(hex.x, 0);
  EXPECT_EQ(hex.y, 1);
  EXPECT_NEAR(hex.z, 0.21586, 1e-5);
}

TEST(parser, reads_points_in_every_form) {
  const auto center = [](const std::string& attributes) {
    return std::get<SphereDescription>(shape("sphere", "<point name='center' " + attributes + "/>").geometry).center;
  };
  EXPECT_EQ(center("x='1' y='2' z='3'"), Vec3d(1, 2, 3));
  EXPECT_EQ(center("value='1, 2, 3'"), Vec3d(1, 2, 3));
  EXPECT_EQ(center("value='4'"), Vec3d(4, 4, 4));
}

TEST(parser, applies_transforms_in_the_order_of_the_file) {
  // x=1 is scaled to 2, turned about z to y=2, moved to y=12.
  const std::string scale = "<scale value='2'/>", turn = "<rotate z='1' angle='90'/>", move = "<translate y='10'/>";
  EXPECT_EQ(to_world(scale + turn + move).point({1, 0, 0}), Vec3d(0, 12, 0));
  // Moved to (1,10), turned to (-10,1), scaled.
  EXPECT_EQ(to_world(move + turn + scale).point({1, 0, 0}), Vec3d(-20, 2, 0));
}

TEST(parser, fills_missing_components_of_transforms_as_mitsuba_does) {
  EXPECT_EQ(to_world("<scale y='3'/>"), Transform::scale({1, 3, 1}));
  EXPECT_EQ(to_world("<translate z='3'/>"), Transform::translate({0, 0, 3}));
  EXPECT_EQ(to_world("<rotate value='0 1 0' angle='30'/>"), Transform::rotate({0, 1, 0}, 30));
}

TEST(parser, reads_matrices_row_by_row) {
  EXPECT_EQ(to_world("<matrix value='1 0 0 5  0 1 0 6  0 0 1 7  0 0 0 1'/>"), Transform::translate({5, 6, 7}));
  EXPECT_EQ(to_world("<matrix value='0 -1 0  1 0 0  0 0 1'/>"), Transform::rotate({0, 0, 1}, 90));
}

TEST(parser, reads_conductors) {
  const auto mirror = bsdf<ConductorDescription>(
      "conductor", "<string name='material' value='none'/><float name='specular_reflectance' value='0.7'/>");
  EXPECT_FALSE(mirror.ior.has_value());
  EXPECT_EQ(mirror.specular_reflectance, Colour(RgbD(0.7)));
  const auto metal =
      bsdf<ConductorDescription>("conductor", "<rgb name='eta' value='0.2, 0.9, 1.1'/><float name='k' value='3'/>");
  ASSERT_TRUE(metal.ior.has_value());
  EXPECT_EQ(metal.ior->eta, RgbD(0.2, 0.9, 1.1));
  EXPECT_EQ(metal.ior->k, RgbD(3.0));
}

TEST(parser, knows_indices_of_refraction_by_name) {
  const auto glass = bsdf<DielectricDescription>(
      "dielectric", "<string name='int_ior' value='diamond'/><integer name='ext_ior' value='1'/>");
  EXPECT_EQ(glass.int_ior, 2.419);
  EXPECT_EQ(glass.ext_ior, 1);
}

TEST(parser, shares_bsdfs_by_reference_also_before_they_are_defined) {
  const auto scene = parse(
      "<shape type='cube'><ref id='a'/></shape><shape type='cube'><bsdf type='diffuse'/></shape>"
      "<bsdf type='diffuse' id='a'/><shape type='cube'><bsdf type='dielectric' id='b'/></shape>"
      "<shape type='cube'><ref id='b' name='bsdf'/></shape>");
  ASSERT_EQ(scene.bsdfs.size(), 3u);  // a, b, and the one without an id
  EXPECT_EQ(scene.bsdfs[0].id, "a");
  EXPECT_EQ(scene.bsdfs[1].id, "b");
  EXPECT_EQ(scene.bsdfs[2].id, "");
  const std::vector<std::uint32_t> expected = {0, 2, 1, 1};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(scene.shapes[i].bsdf.value, expected[i]) << i;
}

TEST(parser, makes_the_bsdf_that_a_shape_lacks_black_where_it_emits) {
  const auto lacking = [](const std::string& content) {
    const SceneDescription scene = parse("<shape type='sphere'>" + content + "</shape>");
    return std::get<DiffuseDescription>(scene.bsdfs.at(scene.shapes.at(0).bsdf.value).model).reflectance;
  };
  EXPECT_EQ(lacking("<emitter type='area'/>"), Colour(RgbD(0.0)));
  EXPECT_EQ(lacking(""), Colour(RgbD(0.5)));
  EXPECT_EQ(lacking("<bsdf type='diffuse'/><emitter type='area'/>"), Colour(RgbD(0.5)));
}

TEST(parser, reads_area_lights) {
  const auto light = shape("rectangle",
                           "<boolean name='flip_normals' value='True'/><emitter type='area'><rgb name='radiance' "
                           "value='1, 2, 3'/></emitter>");
  EXPECT_EQ(light.radiance, Colour(RgbD(1, 2, 3)));
  EXPECT_TRUE(light.flip_normals);
  EXPECT_EQ(shape("cube", "<emitter type='area'/>").radiance, Colour(RgbD(1.0)));
}

TEST(parser, places_point_lights_by_position_or_transform) {
  const auto position = [](const std::string& parameter) {
    const auto scene = parse("<emitter type='point' id='light'>" + parameter + "</emitter>");
    EXPECT_EQ(scene.emitters.at(1).id, "light");
    return std::get<PointLightDescription>(scene.emitters.at(1).light).position;
  };
  EXPECT_EQ(position("<point name='position' value='1 2 3'/>"), Vec3d(1, 2, 3));
  EXPECT_EQ(position("<transform name='to_world'><translate x='4'/><scale value='2'/></transform>"), Vec3d(8, 0, 0));
}

TEST(parser, reads_the_camera) {
  const auto c = camera(
      "<float name='fov' value='36'/><string name='fov_axis' value='y'/><float name='near_clip' "
      "value='100.1'/><integer name='far_clip' value='1000'/>");
  EXPECT_EQ(c, (PerspectiveDescription{36, FovAxis::y, 100.1, 1000}));
  EXPECT_EQ(camera("<float name='fov' value='36'/>").fov_axis, FovAxis::x);
}

TEST(parser, turns_focal_lengths_into_diagonal_fields_of_view) {
  // The diagonal of 36 x 24 mm is 43.267 mm: 2 atan(43.267 / (2 * 50)) = 46.793 degrees, Mitsuba's default camera.
  for (const char* text :
       {"", "<string name='focal_length' value='50mm'/>", "<string name='focal_length' value='50'/>"}) {
    EXPECT_NEAR(camera(text).fov_degrees, 46.793, 5e-4) << text;
    EXPECT_EQ(camera(text).fov_axis, FovAxis::diagonal) << text;
  }
}

TEST(parser, reads_film_and_sampler) {
  const auto scene = with_sensor("",
                                 "<integer name='width' value='65536'/><integer name='height' value='4096'/><string "
                                 "name='pixel_format' value='rgb'/><string name='file_format' value='openexr'/>",
                                 "<sampler type='independent'><integer name='sample_count' value='9'/></sampler>");
  EXPECT_EQ(scene.sensor.film, (FilmDescription{65536, 4096}));  // exactly 2^28 pixels
  EXPECT_EQ(scene.sensor.sample_count, 9);
}

TEST(parser, reads_integrators) {
  EXPECT_EQ(integrator<PathDescription>("path",
                                        "<integer name='max_depth' value='17'/><integer name='rr_depth' "
                                        "value='3'/><boolean name='hide_emitters' value='true'/>"),
            (PathDescription{17, 3, true}));
  EXPECT_EQ(integrator<PhotonMapperDescription>(
                "photonmapper",
                "<integer name='global_photons' value='1000'/><integer name='caustic_photons' value='10000'/><float "
                "name='global_radius' value='30'/><string name='indirect' value='gather'/>"),
            (PhotonMapperDescription{-1, 5, false, 1000, 10000, 30, 0, IndirectLight::gather}));
  EXPECT_EQ(integrator<PhotonMapperDescription>("photonmapper", ""), PhotonMapperDescription{});
}

TEST(parser, knows_where_everything_stands) {
  const auto scene = parse("\n<bsdf type='diffuse' id='a'/>\n  <shape type='cube'/>");
  EXPECT_EQ(scene.where(scene.bsdfs[0].loc), "test.xml:2:1");
  EXPECT_EQ(scene.where(scene.shapes[0].loc), "test.xml:3:3");
  EXPECT_EQ(scene.where(scene.sensor.loc), "test.xml:1:24");
  EXPECT_EQ(scene.where(SourceLoc{9, 1, 1}), "<scene>:1:1");
}

TEST(parser, decodes_entities_and_ignores_comments) {
  const auto scene = parse("<!-- $undefined &nothing; --><bsdf type='diffuse' id='&lt;&amp;&#65;&#x42;&quot;'/><?pi?>");
  EXPECT_EQ(scene.bsdfs[0].id, "<&AB\"");
}

TEST(parser, accepts_a_byte_order_mark_and_names_columns_after_it) {
  const std::string mark = "\xEF\xBB\xBF";
  try {
    parse_scene_text(mark + "<scene version='3.0'>\n <oops/></scene>", "test.xml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.summary().rfind("test.xml:2:2: error: <oops> is not supported in <scene>", 0), 0u) << error.what();
  }
}

// Linear, 16 times as many attributes take 16 times as long; compared each with each, 256 times.
TEST(parser, many_attributes_take_time_in_proportion) {
  const auto seconds = [](int count) {
    std::string text = "<scene version='3.0.0'";
    for (int i = 0; i < count; ++i) text += " a" + std::to_string(i) + "='1'";
    text += "/>";
    double least = 1e9;
    for (int repeat = 0; repeat < 3; ++repeat) {
      const std::clock_t begin = std::clock();
      EXPECT_THROW(parse_scene_text(text, "test.xml"), InputError);
      least = std::min(least, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    }
    return least;
  };
  EXPECT_LT(seconds(32000), 64 * seconds(2000));
}

TEST(shapes, read_disks_that_are_ellipses) {
  const ShapeDescription ellipse = shape("disk", "<transform name='to_world'><scale x='3' y='2'/></transform>");
  EXPECT_EQ(ellipse.to_world, Transform::scale({3, 2, 1}));
}

TEST(shapes, lengthen_cylinders_that_are_stretched_along_their_axis) {
  // The axis along (0, 3, 4), which a turn about x by atan(3/4) makes z. There 6 is along it and 2 across.
  const ShapeDescription longer =
      shape("cylinder",
            "<point name='p0' x='1' y='1' z='1'/><point name='p1' x='1' y='4' z='5'/><float name='radius' value='0.5'/>"
            "<transform name='to_world'><rotate x='1' angle='36.86989764584402'/><scale x='2' y='2' z='6'/>"
            "<translate z='7'/></transform>");
  const auto& cylinder = std::get<CylinderDescription>(longer.geometry);
  EXPECT_EQ(cylinder.p0, Vec3d(1));
  EXPECT_LT(length(cylinder.p1 - Vec3d(1, 1 + 9, 1 + 12)), 1e-12);  // three times as long in its own units
  EXPECT_EQ(cylinder.radius, 0.5);
  const auto world = [&](const Vec3d& p) { return longer.to_world.point(p); };
  // p0 turned: y = 4/5 - 3/5, z = 3/5 + 4/5. The axis is 5 long before to_world.
  EXPECT_LT(length(world(cylinder.p0) - Vec3d(2, 2 * 0.2, 6 * 1.4 + 7)), 1e-12);
  EXPECT_LT(length(world(cylinder.p1) - world(cylinder.p0) - Vec3d(0, 0, 30)), 1e-12);
  EXPECT_NEAR(longer.to_world.similarity_scale(), 2, 1e-12);

  const ShapeDescription even = shape("cylinder", "<transform name='to_world'><scale value='3'/></transform>");
  EXPECT_EQ(even.to_world, Transform::scale(Vec3d(3)));
  EXPECT_EQ(std::get<CylinderDescription>(even.geometry), CylinderDescription{});
  EXPECT_THROW(shape("cylinder", "<transform name='to_world'><scale z='-3'/></transform>"), InputError);
  EXPECT_THROW(shape("cylinder", "<transform name='to_world'><scale y='3'/></transform>"), InputError);
}

}  // namespace
}  // namespace photonproof::inline scenes_parser
