// Scenes of other versions mean the same as the scenes of this format that are written out beside them.
#include "scenes/dialect/stand_ins.h"

#include <gtest/gtest.h>

#include "scenes/parser/parser.h"
#include "scenes/parser/test_same_scene.h"

namespace photonproof::scene_xml {
namespace {

const std::string kSensor = "<sensor type='perspective'/>", kLight = "<emitter type='point'/>";

SceneDescription parse(const std::string& content, const std::string& version = "3.0.0") {
  return parse_scene_text("<scene version='" + version + "'>" + content + "</scene>", "test.xml");
}

/// The notes of a scene, a line each, without their places.
std::string notes_of(const std::string& content, const std::string& version = "3.0.0") {
  std::string text;
  for (const SceneNote& note : parse(kSensor + kLight + content, version).notes) text += note.text + "\n";
  return text;
}

/// Empty when an old text means what the new one does.
std::string difference(const std::string& old_text, const std::string& new_text, const std::string& version = "0.6.0") {
  return first_difference(parse(kSensor + kLight + old_text, version), parse(kSensor + kLight + new_text));
}

TEST(upgrade, renames_what_versions_before_2_have) {
  EXPECT_EQ(difference("<shape type='sphere'><transform name='toWorld'><scale value='2'/></transform>"
                       "<bsdf type='dielectric'><float name='intIOR' value='1.3'/><string name='extIOR' "
                       "value='air'/></bsdf></shape>",
                       "<shape type='sphere'><transform name='to_world'><scale value='2'/></transform>"
                       "<bsdf type='dielectric'><float name='int_ior' value='1.3'/><string name='ext_ior' "
                       "value='air'/></bsdf></shape>"),
            "");
  EXPECT_EQ(difference("<integrator type='path'><integer name='maxDepth' value='7'/><integer name='rrDepth' "
                       "value='3'/></integrator>",
                       "<integrator type='path'><integer name='max_depth' value='7'/><integer name='rr_depth' "
                       "value='3'/></integrator>"),
            "");
  EXPECT_EQ(difference("<bsdf type='diffuse' id='b'><rgb name='diffuseReflectance' value='.1 .2 .3'/></bsdf>",
                       "<bsdf type='diffuse' id='b'><rgb name='reflectance' value='.1 .2 .3'/></bsdf>"),
            "");
  EXPECT_EQ(difference("<luminaire type='point'><transform name='toWorld'><lookAt origin='1,2,3' target='0,0,0' "
                       "up='0,1,0'/></transform></luminaire>",
                       "<emitter type='point'><transform name='to_world'><lookat origin='1,2,3' target='0,0,0' "
                       "up='0,1,0'/></transform></emitter>"),
            "");
}

TEST(upgrade, scales_texture_coordinates_before_it_moves_them) {
  const auto board = [](const std::string& content) {
    return "<texture type='checkerboard' id='t'>" + content + "</texture>";
  };
  EXPECT_EQ(
      difference(
          board("<float name='uscale' value='8'/><float name='vscale' value='4'/><float name='uoffset' value='.5'/>"),
          board("<transform name='to_uv'><scale x='8' y='4'/><translate x='.5'/></transform>")),
      "");
  EXPECT_EQ(difference(board("<float name='voffset' value='.25'/>"),
                       board("<transform name='to_uv'><translate y='.25'/></transform>")),
            "");
}

TEST(upgrade, leaves_names_of_versions_from_2_on) {
  EXPECT_THROW(parse(kSensor + "<shape type='sphere'><transform name='toWorld'/></shape>", "2.0.0"), InputError);
}

TEST(stand_ins, render_unknown_integrators_by_the_nearest_and_tell) {
  const auto becomes = [](const std::string& type, const std::string& more = "") {
    const SceneDescription scene =
        parse(kSensor + kLight + more + "<integrator type='" + type +
              "'><integer name='max_depth' value='4'/><float name='jump' value='2'/></integrator>");
    EXPECT_EQ(scene.notes.size(), 1u) << type;
    EXPECT_EQ(std::visit([](const auto& d) { return d.max_depth; }, scene.integrator.method), 4) << type;
    return scene.integrator.method.index();
  };
  const auto index_of = [](const std::string& type) {
    return parse(kSensor + "<integrator type='" + type + "'/>").integrator.method.index();
  };
  for (const char* type : {"mlt", "pssmlt", "erpt", "vpl", "prb", "prb_basic", "guided"})
    EXPECT_EQ(becomes(type), index_of("path")) << type;
  for (const char* type : {"volpathmis", "prbvolpath", "volpath_simple"}) EXPECT_EQ(becomes(type), index_of("volpath"));
  EXPECT_EQ(becomes("mlt", "<medium type='homogeneous' id='m'/>"), index_of("volpath"));
  EXPECT_EQ(notes_of("<integrator type='mlt'/>"), "integrator 'mlt' is rendered as 'path'\n");
  EXPECT_EQ(
      notes_of("<integrator type='aov'><string name='aovs' value='d:depth'/><integrator type='direct'/></integrator>"),
      "integrator 'aov' is left out: only the one that it nests is rendered\n");
  EXPECT_THROW(parse(kSensor + kLight + "<integrator type='pathh'/>"), InputError) << "a typing error";
}

TEST(stand_ins, end_paths_where_mitsubas_differentiable_integrators_do) {
  const auto depth = [](const std::string& type, const std::string& inside = "") {
    return std::visit([](const auto& d) { return d.max_depth; },
                      parse(kSensor + "<integrator type='" + type + "'>" + inside + "</integrator>").integrator.method);
  };
  for (const char* type : {"prb", "prb_basic", "prb_projective", "prbvolpath"}) {
    EXPECT_EQ(depth(type), 6) << type;
    EXPECT_EQ(depth(type, "<integer name='max_depth' value='3'/>"), 3) << type;
  }
  EXPECT_EQ(depth("volpathmis"), -1);
  const SceneDescription direct =
      parse(kSensor + "<integrator type='direct_projective'><integer name='sppi' value='3'/></integrator>");
  EXPECT_TRUE(std::holds_alternative<DirectDescription>(direct.integrator.method));
}

TEST(stand_ins, take_the_parameters_of_other_photon_mappers) {
  EXPECT_EQ(
      difference(
          "<integrator type='sppm'><integer name='photonCount' value='5000'/><float name='initialRadius' value='.5'/>"
          "<float name='alpha' value='.7'/><integer name='maxPasses' value='20'/></integrator>",
          "<integrator type='sppm'><integer name='photons' value='5000'/><float name='radius' value='.5'/>"
          "<float name='alpha' value='.7'/></integrator>"),
      "");
  EXPECT_EQ(difference("<integrator type='photonmapper'><integer name='globalPhotons' value='5000'/><integer "
                       "name='causticPhotons' value='7000'/>"
                       "<float name='globalLookupRadius' value='.05'/><integer name='lookupSize' value='120'/><integer "
                       "name='directSamples' value='4'/></integrator>",
                       "<integrator type='photonmapper'><integer name='global_photons' value='5000'/><integer "
                       "name='caustic_photons' value='7000'/></integrator>"),
            "");
  EXPECT_EQ(
      notes_of("<integrator type='photonmapper'><float name='globalLookupRadius' value='.05'/></integrator>", "0.6.0"),
      "integrator 'photonmapper' chooses radii and gather rays by itself, without global_lookup_radius\n");
}

TEST(stand_ins, mix_any_number_of_bsdfs) {
  // .5 a + .3 b + .2 c = ((a .625 + b .375) .8 + c .2)
  const std::string a = "<bsdf type='plastic'/>", b = "<bsdf type='conductor'/>", c = "<bsdf type='null'/>";
  const SceneDescription scene =
      parse(kSensor + kLight + "<bsdf type='mixturebsdf' id='m'><string name='weights' value='.5, .3, .2'/>" + a + b +
            c + "</bsdf>");
  const auto& outer = std::get<BlendDescription>(scene.bsdfs.back().model);
  const auto& inner = std::get<BlendDescription>(scene.bsdfs[outer.first.value].model);
  EXPECT_EQ(scene.bsdfs.back().id, "m");
  EXPECT_NEAR(std::get<double>(outer.weight), .2, 1e-15);
  EXPECT_NEAR(std::get<double>(inner.weight), .375, 1e-15);
  EXPECT_TRUE(std::holds_alternative<NullDescription>(scene.bsdfs[outer.second.value].model));
  EXPECT_TRUE(std::holds_alternative<ConductorDescription>(scene.bsdfs[inner.second.value].model));
  const SceneDescription dim =
      parse(kSensor + kLight + "<bsdf type='mixturebsdf' id='m'><string name='weights' value='.25'/>" + a + "</bsdf>");
  const auto& black = std::get<BlendDescription>(dim.bsdfs.back().model);
  EXPECT_NEAR(std::get<double>(black.weight), .75, 1e-15) << "the rest absorbs";
  EXPECT_EQ(constant(std::get<DiffuseDescription>(dim.bsdfs[black.second.value].model).reflectance), RgbD(0.0));
  EXPECT_THROW(parse(kSensor + kLight + "<bsdf type='mixturebsdf' id='m'><string name='weights' value='.25'/>" + a + b +
                     "</bsdf>"),
               InputError);
}

TEST(stand_ins, coat_and_tell) {
  EXPECT_EQ(notes_of("<bsdf type='roughcoating' id='c'><float name='alpha' value='.2'/><bsdf type='diffuse'><rgb "
                     "name='reflectance' value='.3'/></bsdf></bsdf>"),
            "bsdf 'roughcoating' is rendered as 'roughplastic': the coat absorbs nothing\n");
  EXPECT_EQ(notes_of("<bsdf type='coating' id='c'><bsdf type='roughconductor'/></bsdf>"),
            "bsdf 'coating' is rendered as 'layered': light is also reflected several times below the coat\n");
  EXPECT_EQ(notes_of("<bsdf type='ward' id='w'><float name='alphaU' value='.2'/></bsdf>", "0.5.0"),
            "bsdf 'ward' is rendered as 'phong': its highlight is round and has no Fresnel edge\n");
  const auto ward = parse(kSensor + kLight + "<bsdf type='ward' id='w'><float name='alpha_u' value='.1'/></bsdf>");
  EXPECT_NEAR(std::get<double>(std::get<PhongDescription>(ward.bsdfs[0].model).exponent), 49.5, 1e-9);
}

TEST(stand_ins, turn_the_sun_of_old_to_its_up) {
  for (const char* type : {"sky", "sun", "sunsky"}) {
    const SceneDescription scene = parse(
        kSensor + "<emitter type='" + std::string(type) + "'><float name='turbidity' value='4'/></emitter>", "0.6.0");
    const auto& sky = std::get<SunSkyDescription>(scene.emitters.at(0).light);
    const Vec3d up = sky.to_world.vector({0, 0, 1});
    EXPECT_NEAR(up.y, 1, 1e-12) << type;
    EXPECT_EQ(sky.sun_scale, type == std::string("sky") ? 0 : 1);
    EXPECT_EQ(sky.sky_scale, type == std::string("sun") ? 0 : 1);
    EXPECT_EQ(sky.turbidity, 4);
  }
  EXPECT_NEAR(std::get<SunSkyDescription>(parse(kSensor + "<emitter type='sunsky'/>").emitters[0].light)
                  .to_world.vector({0, 0, 1})
                  .z,
              1, 1e-12)
      << "that of Mitsuba 3 stays";
}

TEST(stand_ins, read_colours_of_old) {
  const auto reflectance = [](const std::string& colour) {
    const auto scene = parse(kSensor + kLight + "<bsdf type='diffuse' id='b'>" + colour + "</bsdf>", "0.6.0");
    return constant(std::get<DiffuseDescription>(scene.bsdfs[0].model).reflectance);
  };
  EXPECT_EQ(reflectance("<srgb name='reflectance' value='#ff0080'/>"),
            reflectance("<rgb name='reflectance' value='#ff0080'/>"));
  EXPECT_NEAR(reflectance("<srgb name='reflectance' value='.5'/>").x, 0.21404114, 1e-8) << "IEC 61966-2-1";
  EXPECT_EQ(reflectance("<spectrum name='reflectance' intent='reflectance' value='.1 .2 .3'/>"), RgbD(.1, .2, .3));
}

TEST(stand_ins, accept_every_harmless_parameter) {
  const std::map<std::string_view, std::string> inside = {
      {"bsdf", "<bsdf type='plastic' id='b'>{}</bsdf>"},
      {"emitter", "<emitter type='constant'>{}</emitter>"},
      {"film", "<sensor type='orthographic'><film type='hdrfilm'>{}</film></sensor>"},
      {"integrator", "<integrator type='path'>{}</integrator>"},
      {"medium", "<medium type='homogeneous' id='m'>{}</medium>"},
      {"scene", "{}"},
      {"sampler", "<sensor type='orthographic'><sampler type='independent'>{}</sampler></sensor>"},
      {"sensor", "<sensor type='perspective'>{}</sensor>"},
      {"shape", "<shape type='cube'>{}</shape>"},
      {"volume",
       "<medium type='homogeneous' id='m'><volume type='constvolume' name='albedo'><float name='value' "
       "value='.5'/>{}</volume></medium>"},
      {"texture", "<texture type='checkerboard' id='t'>{}</texture>"}};
  for (const HarmlessParameter& row : harmless_parameters()) {
    std::string text = inside.at(row.tag);
    text.replace(text.find("{}"), 2, "<string name='" + std::string(row.name) + "' value='x'/>");
    const std::string without = [&] {
      std::string plain = inside.at(row.tag);
      return plain.erase(plain.find("{}"), 2);
    }();
    EXPECT_EQ(first_difference(parse(text), parse(without)), "") << row.tag << " " << row.name;
  }
  EXPECT_EQ(std::get<ThinLensDescription>(parse("<sensor type='thinlens'><float name='aperture_radius' value='1'/>"
                                                "<float name='focus_distance' value='7'/></sensor>")
                                              .sensor.camera)
                .focus_distance,
            7);
}

TEST(stand_ins, take_films_and_words_in_any_case) {
  const SceneDescription scene = parse(
      "<sensor type='perspective'><float name='fov' value='30'/><string name='fovAxis' value='Y'/><film type='ldrfilm'>"
      "<boolean name='highQualityEdges' value='true'/><float name='gamma' value='2.2'/><string name='pixelFormat' "
      "value='rgb'/></film>"
      "<sampler type='halton'><integer name='sampleCount' value='9'/></sampler></sensor>",
      "0.6.0");
  EXPECT_EQ(std::get<PerspectiveDescription>(scene.sensor.camera).fov_axis, FovAxis::y);
  EXPECT_TRUE(scene.sensor.film.sample_border);
  EXPECT_EQ(scene.sensor.sample_count, 9);
  const auto film = parse(
      "<sensor type='perspective'><film type='hdrfilm'><string name='pixel_format' "
      "value='Luminance_Alpha'/></film></sensor>");
  EXPECT_TRUE(film.sensor.film.alpha);
  EXPECT_EQ(film.notes.at(0).text, "pixel_format 'luminance_alpha' is written as rgba");
}

TEST(stand_ins, keep_the_first_key_of_an_animation_and_the_shapes_of_a_merge) {
  const auto moved =
      parse(kSensor + kLight +
            "<shape type='sphere'><animation name='to_world'>"
            "<transform time='0'><translate x='3'/></transform><transform time='1'><translate x='9'/></transform>"
            "</animation></shape>");
  EXPECT_EQ(moved.shapes[0].to_world, Transform::translate({3, 0, 0}));
  EXPECT_EQ(moved.notes.at(0).text, "the animation stands still at its first key");
  EXPECT_EQ(
      parse(kSensor + kLight + "<shape type='merge'><shape type='cube'/><shape type='sphere'/></shape>").shapes.size(),
      2u);
}

TEST(stand_ins, leave_rolling_shutters_out_and_tell) {
  const std::string rolling =
      "<string name='rolling_shutter_type' value='top'/><float name='rolling_shutter_duration' value='0.5'/>";
  const auto scene = parse("<sensor type='perspective'>" + rolling + "</sensor>" + kLight);
  ASSERT_EQ(scene.notes.size(), 1u);
  EXPECT_EQ(scene.notes[0].text, "the rolling shutter is left out: nothing moves");
}

TEST(stand_ins, make_a_texture_of_a_normal_that_is_the_same_everywhere) {
  const auto mapped = [](const std::string& normal) {
    return "<bsdf type='normalmap' id='b'>" + normal + "<bsdf type='diffuse'/></bsdf>";
  };
  const std::string board = mapped(
      "<texture name='normalmap' type='checkerboard'><rgb name='color0' value='0.5, 0.4, 1'/>"
      "<rgb name='color1' value='0.5, 0.4, 1'/></texture>");
  for (const char* normal :
       {"<rgb name='normalmap' value='0.5, 0.4, 1'/>",
        "<spectrum name='normalmap' type='srgb'><rgb name='color' value='0.5, 0.4, 1'/></spectrum>",
        "<texture name='normalmap' type='srgb'><rgb name='color' value='0.5, 0.4, 1'/></texture>"})
    EXPECT_EQ(difference(mapped(normal), board, "3.0.0"), "") << normal;
}

TEST(stand_ins, put_colours_in_place_of_refs_and_of_textures) {
  const std::string red = "<rgb name='reflectance' value='.4 .1 .1'/>";
  const auto paint = [](const std::string& colour) { return "<bsdf type='diffuse' id='d'>" + colour + "</bsdf>"; };
  EXPECT_EQ(
      difference(paint("<ref name='reflectance' id='tone'/>") + "<spectrum id='tone' value='.4 .1 .1'/>", paint(red)),
      "");
  const std::string grey = "<rgb name='reflectance' value='.6'/>";
  for (const char* tag : {"texture", "spectrum"})
    for (const char* type : {"uniform", "rawconstant"})
      EXPECT_EQ(difference(paint("<" + std::string(tag) + " name='reflectance' type='" + type +
                                 "'><float name='value' value='.6'/></" + tag + ">"),
                           paint(grey)),
                "")
          << tag << type;
  EXPECT_THROW(parse(kSensor + paint("<ref name='reflectance' id='tone'/>")), InputError);
}

TEST(stand_ins, give_hair_the_colour_of_much_of_it) {
  const auto colour = [](const std::string& inside) {
    const SceneDescription scene = parse(kSensor + kLight + "<bsdf type='hair' id='h'>" + inside + "</bsdf>");
    return constant(std::get<PrincipledDescription>(scene.bsdfs.back().model).base_color);
  };
  // Chiang et al. 2016, equation 9, at a roughness of 0 and of 1: absorptions of the reflectance 0.5.
  const std::string smooth = "<float name='azimuthal_roughness' value='0'/>",
                    rough = "<float name='azimuthal_roughness' value='1'/>";
  EXPECT_NEAR(colour(smooth + "<float name='sigma_a' value='0.0134849011'/>").x, 0.5, 1e-7);
  EXPECT_NEAR(colour(rough + "<rgb name='sigma_a' value='0.0421796885 0 0'/>").x, 0.5, 1e-5);
  EXPECT_EQ(colour(rough + "<rgb name='sigma_a' value='0.0421796885 0 0'/>").y, 1);
  const RgbD brown = colour(""), blonde = colour("<float name='eumelanin' value='.3'/>");
  EXPECT_GT(brown.x, brown.z);
  EXPECT_GT(blonde.x, brown.x);
  EXPECT_THROW(colour("<texture name='sigma_a' type='checkerboard'/>"), InputError);
}

TEST(stand_ins, take_polarizers_as_grey_filters) {
  const auto filter = [](const std::string& inside) {
    const SceneDescription scene =
        parse(kSensor + kLight + "<bsdf type='polarizer' id='p'><float name='theta' value='30'/>" + inside + "</bsdf>");
    return std::get<BlendDescription>(scene.bsdfs.back().model);
  };
  EXPECT_EQ(std::get<double>(filter("").weight), 0.5);
  EXPECT_EQ(std::get<double>(filter("<boolean name='polarizing' value='false'/>").weight), 0.0);
  const SceneDescription scene =
      parse(kSensor + kLight + "<bsdf type='circular' id='p'><rgb name='transmittance' value='.7'/></bsdf>");
  const auto& blend = std::get<BlendDescription>(scene.bsdfs.back().model);
  const auto& sheet = std::get<ThinDielectricDescription>(scene.bsdfs[blend.first.value].model);
  EXPECT_EQ(sheet.int_ior, sheet.ext_ior);
  EXPECT_EQ(constant(sheet.specular_transmittance), RgbD(0.7));
  EXPECT_EQ(notes_of("<bsdf type='retarder' id='p'><float name='delta' value='45'/></bsdf>"),
            "bsdf 'retarder' is rendered as 'null': without polarisation\n");
}

TEST(stand_ins, give_tables_of_phases_their_mean_cosine) {
  const auto g = [](const std::string& values) {
    const SceneDescription scene = parse(
        kSensor + kLight + "<medium type='homogeneous' id='m'><phase type='tabphase'><string name='values' value='" +
        values + "'/></phase></medium>");
    return std::get<HenyeyGreensteinDescription>(std::get<HomogeneousDescription>(scene.media[0].model).phase).g;
  };
  // (1 + c) / 2 has the mean cosine 1/3. Over three nodes of |c| it is 0.
  EXPECT_NEAR(g("0, 1"), 1.0 / 3, 1e-12);
  EXPECT_NEAR(g("1, 0, 1"), 0, 1e-12);
  EXPECT_NEAR(g("0, 0.5, 1"), 1.0 / 3, 1e-12);
  EXPECT_NEAR(g("0, 0, 1"), 2.0 / 3, 1e-12);
  EXPECT_THROW(parse(kSensor + "<medium type='homogeneous' id='m'><phase type='tabphase'/></medium>"), InputError);
}

TEST(stand_ins, stop_the_sun_at_its_first_hour) {
  EXPECT_EQ(
      difference("<emitter type='timed_sunsky'><integer name='start_month' value='3'/><integer name='end_month' "
                 "value='5'/><float name='window_start_time' value='9.5'/></emitter>",
                 "<emitter type='sunsky'><integer name='month' value='3'/><float name='hour' value='9.5'/></emitter>",
                 "3.0.0"),
      "");
  EXPECT_EQ(notes_of("<emitter type='sunsky'><boolean name='complex_sun' value='true'/></emitter>"),
            "complex_sun is left out: the sun is as bright at its rim as in its middle\n");
  EXPECT_EQ(notes_of("<emitter type='sunsky'><boolean name='complex_sun' value='false'/></emitter>"), "");
}

TEST(stand_ins, render_no_edges_black) {
  const SceneDescription scene = parse(kSensor + kLight +
                                       "<integrator type='path'><integer name='max_depth' value='0'/>"
                                       "</integrator><shape type='sphere'><emitter type='area'/></shape>");
  EXPECT_TRUE(scene.emitters.empty());
  EXPECT_FALSE(scene.shapes.at(0).radiance);
  EXPECT_EQ(scene.notes.at(0).text, "the scene has no light: its image is black");
}

}  // namespace
}  // namespace photonproof::scene_xml
