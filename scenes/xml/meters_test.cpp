// Sensors that measure, batches of cameras, and lights along normals, as scene files state them.
#include <gtest/gtest.h>

#include "scenes/parser/parser.h"
#include "scenes/parser/test_same_scene.h"
#include "scenes/xml/writer.h"

namespace photonproof::inline scenes_xml {
namespace {

const std::string kLight = "<emitter type='point'/>", kFilm =
                                                          "<film type='hdrfilm'><integer name='width' value='1'/>"
                                                          "<integer name='height' value='1'/></film>";

SceneDescription parse(const std::string& content, int number = 0) {
  ParseOptions options;
  options.sensor = number;
  return parse_scene_text("<scene version='3.0.0'>" + kLight + content + "</scene>", "test.xml", options);
}
SensorDescription sensor(const std::string& type, const std::string& content) {
  return parse("<sensor type='" + type + "'>" + content + "</sensor>").sensor;
}
std::string refusal(const std::string& content) {
  try {
    parse(content);
    return "";
  } catch (const InputError& error) {
    const std::string message = error.what();
    const std::size_t at = message.find("error: ") + 7;
    return message.substr(at, message.find('\n') - at);
  }
}
std::string refusal_of(const std::string& type, const std::string& content) {
  return refusal("<sensor type='" + type + "'>" + content + "</sensor>");
}

void expect_near(const Vec3d& a, const Vec3d& b) { EXPECT_LT(length(a - b), 1e-12) << a.x << " " << a.y << " " << a.z; }

TEST(radiancemeter, looks_from_its_origin_along_its_direction) {
  const auto given = sensor("radiancemeter",
                            "<point name='origin' x='1' y='2' z='3'/><vector name='direction' x='0' y='3' "
                            "z='-4'/>" +
                                kFilm);
  EXPECT_TRUE(std::holds_alternative<RadianceMeterDescription>(given.camera));
  expect_near(given.to_world.point({0, 0, 0}), {1, 2, 3});
  expect_near(given.to_world.vector({0, 0, 1}), {0, 0.6, -0.8});
  const auto placed = sensor("radiancemeter", "<transform name='to_world'><translate x='5'/></transform>" + kFilm);
  EXPECT_EQ(placed.to_world, Transform::translate({5, 0, 0}));
  EXPECT_EQ(placed.film.filter.kind, ReconstructionFilter::Kind::box);
}

TEST(radiancemeter, is_refused_where_its_ray_is_unclear) {
  EXPECT_EQ(refusal_of("radiancemeter", "<point name='origin' x='1' y='0' z='0'/>" + kFilm),
            "parameter 'origin' of sensor 'radiancemeter' is alone, expected origin and direction");
  EXPECT_EQ(refusal_of("radiancemeter", "<vector name='direction' x='1' y='0' z='0'/>" + kFilm),
            "parameter 'direction' of sensor 'radiancemeter' is alone, expected origin and direction");
  EXPECT_NE(refusal_of("radiancemeter",
                       "<point name='origin' x='1' y='0' z='0'/><vector name='direction' x='1' y='0' z='0'/><transform "
                       "name='to_world'><translate x='5'/></transform>" +
                           kFilm),
            "");
  EXPECT_EQ(refusal_of("radiancemeter", ""), "sensor 'radiancemeter' has a film of 768 x 576 pixels, expected 1 x 1");
}

TEST(distant, aims_at_a_point_an_area_or_all_shapes) {
  const std::string down = "<vector name='direction' x='0' y='-2' z='0'/>";
  const auto all = sensor("distant", down + kFilm);
  expect_near(all.to_world.vector({0, 0, 1}), {0, -1, 0});
  EXPECT_EQ(std::get<DistantDescription>(all.camera), DistantDescription{});
  const auto point = sensor("distant", down + "<point name='target' x='1' y='2' z='3'/>" + kFilm);
  EXPECT_EQ(std::get<DistantDescription>(point.camera).target, decltype(DistantDescription::target)(Vec3d(1, 2, 3)));
  const auto area = sensor("distant",
                           "<shape type='disk' name='target'><transform name='to_world'><scale value='2'/>"
                           "</transform></shape>" +
                               kFilm);
  EXPECT_EQ(std::get<DistantDescription>(area.camera).target,
            decltype(DistantDescription::target)(TargetArea{true, Transform::scale(Vec3d(2))}));
  EXPECT_EQ(parse("<sensor type='distant'><shape type='rectangle'/>" + kFilm + "</sensor>").shapes.size(), 0u);
  EXPECT_EQ(refusal_of("distant", "<shape type='sphere'/>" + kFilm),
            "the target of sensor 'distant' is no rectangle or disk");
  EXPECT_EQ(refusal_of("distant", "<shape type='disk'/><point name='target' x='1' y='0' z='0'/>" + kFilm),
            "parameter 'target' of sensor 'distant' is given beside a shape, expected one or the other");
}

TEST(irradiancemeter, measures_the_shape_that_it_stands_in) {
  const std::string meter = "<sensor type='irradiancemeter'>" + kFilm + "</sensor>";
  const auto scene = parse("<shape type='sphere'/><shape type='rectangle'>" + meter + "</shape><shape type='disk'/>");
  EXPECT_TRUE(std::holds_alternative<IrradianceMeterDescription>(scene.sensor.camera));
  ASSERT_EQ(scene.shapes.size(), 3u);
  EXPECT_FALSE(scene.shapes[0].measures);
  EXPECT_TRUE(scene.shapes[1].measures);
  EXPECT_FALSE(scene.shapes[2].measures);
  // Sensors of shapes are counted after the scene's own.
  const std::string camera = "<sensor type='perspective'/>", disk = "<shape type='disk'>" + meter + "</shape>";
  EXPECT_FALSE(parse(disk + camera).shapes[0].measures);
  EXPECT_TRUE(parse(disk + camera, 1).shapes[0].measures);
  EXPECT_EQ(refusal(meter), "sensor 'irradiancemeter' needs a surface, expected it inside a <shape>");
  EXPECT_EQ(refusal("<shape type='disk'>" + camera + "</shape>"), "the sensor of a shape is no 'irradiancemeter'");
  EXPECT_NE(refusal("<shape type='sphere'>" + meter + "</shape>").find("<sensor>"), std::string::npos);
}

TEST(batch, has_cameras_on_equal_columns) {
  const std::string wide =
      "<film type='hdrfilm'><integer name='width' value='6'/><integer name='height' value='2'/></film>";
  const std::string first = "<sensor type='perspective'><float name='fov' value='40'/><film type='hdrfilm'/></sensor>";
  const std::string second =
      "<sensor type='orthographic'><transform name='to_world'><translate x='5'/></transform></sensor>";
  const auto batch = std::get<BatchDescription>(sensor("batch", first + second + wide).camera);
  ASSERT_EQ(batch.views.size(), 2u);
  EXPECT_EQ(std::get<PerspectiveDescription>(batch.views[0].camera).fov_degrees, 40);
  EXPECT_TRUE(std::holds_alternative<OrthographicDescription>(batch.views[1].camera));
  EXPECT_EQ(batch.views[1].to_world, Transform::translate({5, 0, 0}));
  EXPECT_EQ(refusal_of("batch", wide), "sensor 'batch' is empty, expected at least one <sensor>");
  EXPECT_EQ(refusal_of("batch", first + first + first + first + wide),
            "sensor 'batch' has 4 cameras and a film of 6 x 2 pixels, expected a width that is a multiple of 4");
  EXPECT_EQ(refusal_of("batch", "<sensor type='perspective'><float name='far_clip' value='9'/></sensor>" + wide),
            "parameter 'far_clip' of sensor 'perspective' is not done in a batch, expected 10000");
  EXPECT_NE(refusal_of("batch", "<sensor type='radiancemeter'/>" + wide).find("'radiancemeter' is not supported"),
            std::string::npos);
}

TEST(directionalarea, is_the_emission_of_a_flat_shape) {
  const std::string beam = "<emitter type='directionalarea'><rgb name='radiance' value='1,2,3'/></emitter>";
  const auto scene = parse("<sensor type='perspective'/><shape type='rectangle'>" + beam + "</shape>");
  EXPECT_TRUE(scene.shapes.at(0).emits_along_normal);
  EXPECT_EQ(*scene.shapes[0].radiance, Colour(RgbD(1, 2, 3)));
  EXPECT_FALSE(parse("<sensor type='perspective'/><shape type='disk'><emitter type='area'/></shape>")
                   .shapes[0]
                   .emits_along_normal);
  EXPECT_EQ(refusal("<sensor type='perspective'/><shape type='sphere'>" + beam + "</shape>"),
            "emitter 'directionalarea' stands in a sphere, expected it in a rectangle or disk");
  EXPECT_EQ(refusal("<sensor type='perspective'/>" + beam),
            "emitter 'directionalarea' needs a surface, expected it inside a <shape>");
}

TEST(meters, are_written_as_they_are_read) {
  const std::string meter = "<sensor type='irradiancemeter'>" + kFilm + "</sensor>";
  const std::string turned = "<transform name='to_world'><rotate x='1' angle='20'/><translate z='7'/></transform>";
  const std::string view = "<sensor type='thinlens'><float name='aperture_radius' value='0.1'/>" + turned + "</sensor>";
  const std::string beam = "<emitter type='directionalarea'><rgb name='radiance' value='1,2,3'/></emitter>";
  for (const std::string& text :
       {"<sensor type='radiancemeter'>" + turned + kFilm + "</sensor>", "<sensor type='distant'>" + kFilm + "</sensor>",
        "<sensor type='distant'><point name='target' x='2' y='0' z='0'/>" + turned + kFilm + "</sensor>",
        "<sensor type='distant'><shape type='disk' name='target'>" + turned + "</shape>" + kFilm + "</sensor>",
        "<shape type='disk'>" + turned + meter + "</shape>", "<sensor type='batch'>" + view + view + "</sensor>",
        "<sensor type='fisheye'/><shape type='rectangle'>" + beam + "</shape>"}) {
    const SceneDescription scene = parse(text);
    EXPECT_EQ(first_difference(parse_scene_text(write_scene(scene), "test.xml"), scene), "") << write_scene(scene);
  }
}

}  // namespace
}  // namespace photonproof::inline scenes_xml
