// Every plugin's defaults and parameters as SceneDescription has them.
#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>

#include "scenes/parser/parser.h"

namespace photonproof::inline scenes_parser {
namespace {

const std::string kLight = "<emitter type='point'/>", kSensor = "<sensor type='perspective'/>";

SceneDescription parse(const std::string& content, const std::string& name = "test.xml") {
  return parse_scene_text("<scene version='3.0.0'>" + content + "</scene>", name);
}

template <class Model>
Model bsdf(const std::string& type, const std::string& content = "") {
  const auto scene = parse(kSensor + kLight + "<bsdf id='b' type='" + type + "'>" + content + "</bsdf>");
  return std::get<Model>(scene.bsdfs.back().model);
}

template <class Shape>
Shape shape(const std::string& type, const std::string& content = "") {
  return std::get<Shape>(
      parse(kSensor + kLight + "<shape type='" + type + "'>" + content + "</shape>").shapes.at(0).geometry);
}

template <class Light>
Light light(const std::string& type, const std::string& content = "") {
  const auto scene = parse(kSensor + "<emitter type='" + type + "'>" + content + "</emitter>");
  return std::get<Light>(scene.emitters.at(0).light);
}

SensorDescription sensor(const std::string& type, const std::string& content = "") {
  return parse(kLight + "<sensor type='" + type + "'>" + content + "</sensor>").sensor;
}

template <class Method>
Method integrator(const std::string& type, const std::string& content = "") {
  const auto scene = parse(kSensor + kLight + "<integrator type='" + type + "'>" + content + "</integrator>");
  return std::get<Method>(scene.integrator.method);
}

const std::string kDiffuse = "<bsdf type='diffuse'/>";

TEST(plugins, give_mitsubas_defaults_of_bsdfs) {
  EXPECT_EQ(bsdf<ConductorDescription>("conductor"), ConductorDescription{}) << "the perfect mirror";
  EXPECT_EQ(bsdf<RoughConductorDescription>("roughconductor"), RoughConductorDescription{});
  EXPECT_EQ(bsdf<ThinDielectricDescription>("thindielectric"), ThinDielectricDescription{});
  EXPECT_EQ(bsdf<RoughDielectricDescription>("roughdielectric"), RoughDielectricDescription{});
  EXPECT_EQ(bsdf<PlasticDescription>("plastic"), PlasticDescription{});
  EXPECT_EQ(bsdf<RoughPlasticDescription>("roughplastic"), RoughPlasticDescription{});
  EXPECT_EQ(bsdf<PhongDescription>("phong"), PhongDescription{});
  EXPECT_EQ(bsdf<NullDescription>("null"), NullDescription{});
  EXPECT_EQ(bsdf<PrincipledDescription>("principled"), PrincipledDescription{});
  EXPECT_EQ(bsdf<PrincipledThinDescription>("principledthin"), PrincipledThinDescription{});
  EXPECT_EQ(bsdf<DiffuseTransmitterDescription>("difftrans"), DiffuseTransmitterDescription{});
  EXPECT_EQ(bsdf<MaskDescription>("mask", kDiffuse), (MaskDescription{0.5, {0}}));
  EXPECT_EQ(bsdf<TwoSidedDescription>("twosided", kDiffuse), (TwoSidedDescription{{0}, {0}}));
  EXPECT_EQ(bsdf<TwoSidedDescription>("twosided", kDiffuse + kDiffuse), (TwoSidedDescription{{0}, {1}}));
  EXPECT_EQ(bsdf<BlendDescription>("blendbsdf", "<float name='weight' value='0.2'/>" + kDiffuse + kDiffuse),
            (BlendDescription{0.2, {0}, {1}}));
  EXPECT_EQ(bsdf<BumpMapDescription>("bumpmap", "<texture type='checkerboard'/>" + kDiffuse),
            (BumpMapDescription{{0}, 1, {0}, {true, true}}));
  EXPECT_EQ(bsdf<NormalMapDescription>("normalmap", "<texture name='normalmap' type='checkerboard'/>" + kDiffuse),
            (NormalMapDescription{{0}, {0}, {true, true}}));
  EXPECT_EQ(bsdf<LayeredDescription>("layered", kDiffuse), LayeredDescription{});
}

TEST(plugins, read_every_parameter_of_principled_bsdfs) {
  const auto set = [](const char* name, const char* value) {
    return "<float name='" + std::string(name) + "' value='" + value + "'/>";
  };
  const std::string common = set("base_color", "0.11") + set("roughness", "0.12") + set("anisotropic", "0.13") +
                             set("spec_tint", "0.14") + set("sheen", "0.15") + set("sheen_tint", "0.16") +
                             set("flatness", "0.17") + set("spec_trans", "0.18") +
                             set("diffuse_reflectance_sampling_rate", "0.19");
  const std::string all = common + set("metallic", "0.2") + set("clearcoat", "0.21") + set("clearcoat_gloss", "0.22") +
                          set("main_specular_sampling_rate", "0.23") + set("clearcoat_sampling_rate", "0.24");
  PrincipledDescription expected{.base_color = RgbD(0.11),
                                 .roughness = 0.12,
                                 .anisotropic = 0.13,
                                 .metallic = 0.2,
                                 .spec_trans = 0.18,
                                 .eta = 1.7,
                                 .spec_tint = 0.14,
                                 .sheen = 0.15,
                                 .sheen_tint = 0.16,
                                 .flatness = 0.17,
                                 .clearcoat = 0.21,
                                 .clearcoat_gloss = 0.22,
                                 .diffuse_rate = 0.19,
                                 .specular_rate = 0.23,
                                 .clearcoat_rate = 0.24};
  EXPECT_EQ(bsdf<PrincipledDescription>("principled", all + set("eta", "1.7")), expected);
  expected.eta.reset();
  expected.specular = 0.9;
  EXPECT_EQ(bsdf<PrincipledDescription>("principled", all + set("specular", "0.9")), expected);
  const std::string thin =
      common + set("eta", "1.7") + set("diff_trans", "1.8") + set("specular_reflectance_sampling_rate", "0.3") +
      set("specular_transmittance_sampling_rate", "0.31") + set("diffuse_transmittance_sampling_rate", "0.32");
  EXPECT_EQ(bsdf<PrincipledThinDescription>("principledthin", thin),
            (PrincipledThinDescription{.base_color = RgbD(0.11),
                                       .roughness = 0.12,
                                       .anisotropic = 0.13,
                                       .spec_trans = 0.18,
                                       .eta = 1.7,
                                       .spec_tint = 0.14,
                                       .sheen = 0.15,
                                       .sheen_tint = 0.16,
                                       .flatness = 0.17,
                                       .diff_trans = 1.8,
                                       .diffuse_rate = 0.19,
                                       .specular_rate = 0.3,
                                       .transmitted_rate = 0.31,
                                       .diffuse_transmitted_rate = 0.32}));
}

TEST(plugins, nest_a_principled_bsdf_in_twosided_unless_it_transmits) {
  EXPECT_EQ(bsdf<TwoSidedDescription>("twosided", "<bsdf type='principled'/>"), (TwoSidedDescription{{0}, {0}}));
  for (const char* clear :
       {"<bsdf type='principled'><float name='spec_trans' value='0.1'/></bsdf>", "<bsdf type='principledthin'/>"})
    EXPECT_THROW(bsdf<TwoSidedDescription>("twosided", clear), InputError) << clear;
}

TEST(plugins, read_what_maps_do_with_normals) {
  const std::string no_flips = "<boolean name='flip_invalid_normals' value='false'/>";
  const std::string no_shadows = "<boolean name='use_shadowing_function' value='false'/>";
  const std::string height = "<texture type='checkerboard'/>" + kDiffuse;
  const std::string normals = "<texture name='normalmap' type='checkerboard'/>" + kDiffuse;
  const MappedNormalsDescription unflipped{false, true}, unshadowed{true, false};
  EXPECT_EQ(bsdf<BumpMapDescription>("bumpmap", no_flips + height).normal_options, unflipped);
  EXPECT_EQ(bsdf<BumpMapDescription>("bumpmap", no_shadows + height).normal_options, unshadowed);
  EXPECT_EQ(bsdf<NormalMapDescription>("normalmap", no_flips + normals).normal_options, unflipped);
  EXPECT_EQ(bsdf<NormalMapDescription>("normalmap", no_shadows + normals).normal_options, unshadowed);
}

TEST(plugins, read_roughness_in_both_forms) {
  const auto one = bsdf<RoughConductorDescription>("roughconductor", "<float name='alpha' value='0.3'/>");
  EXPECT_EQ(one.alpha_u, Scalar(0.3));
  EXPECT_EQ(one.alpha_v, Scalar(0.3));
  const auto two = bsdf<RoughDielectricDescription>(
      "roughdielectric",
      "<float name='alpha_u' value='0.3'/><texture type='checkerboard' name='alpha_v'/>"
      "<string name='distribution' value='ggx'/><boolean name='sample_visible' value='false'/>");
  EXPECT_EQ(two.alpha_u, Scalar(0.3));
  EXPECT_EQ(two.alpha_v, Scalar(TextureIndex{0}));
  EXPECT_EQ(two.distribution, MicrofacetDistribution::ggx);
  EXPECT_FALSE(two.sample_visible);
}

TEST(plugins, know_conductors_by_name_and_fill_in_what_is_missing) {
  EXPECT_EQ(bsdf<ConductorDescription>("conductor", "<string name='material' value='Ag'/>").ior->eta,
            RgbD(0.1552646, 0.1167233, 0.1383807));
  // Mitsuba: eta is 0 and k is 1 unless given.
  EXPECT_EQ(*bsdf<ConductorDescription>("conductor", "<float name='k' value='3'/>").ior,
            (ComplexIor{RgbD(0.0), RgbD(3.0)}));
  EXPECT_EQ(*bsdf<ConductorDescription>("conductor", "<float name='eta' value='2'/>").ior,
            (ComplexIor{RgbD(2.0), RgbD(1.0)}));
}

template <class Pattern>
Pattern texture(const std::string& type, const std::string& content) {
  const auto scene = parse(kSensor + kLight + "<texture id='t' type='" + type + "'>" + content + "</texture>");
  return std::get<Pattern>(scene.textures.back().pattern);
}

TEST(plugins, read_textures_that_show_others_or_the_mesh) {
  EXPECT_EQ(texture<MeshAttributeDescription>("mesh_attribute", "<string name='name' value='face_heat'/>"),
            (MeshAttributeDescription{"face_heat", 1}));
  const std::string inner = "<texture type='checkerboard'/>";
  EXPECT_EQ(texture<ScaledTextureDescription>("scale", inner), (ScaledTextureDescription{TextureIndex{0}, RgbD(1.0)}));
  EXPECT_EQ(texture<ScaledTextureDescription>("scale", "<float name='scale' value='0.5'/>" + inner).scale, RgbD(0.5));
  EXPECT_EQ(texture<ScaledTextureDescription>("scale", "<rgb name='scale' value='1, 2, 0'/>" + inner).scale,
            RgbD(1, 2, 0));
}

TEST(plugins, know_the_largest_value_of_a_scaled_texture) {
  // The checkerboard's is 0.4: times 2.5 is 1, times 2.6 is more than a reflectance may be.
  const auto scaled = [](const std::string& by) {
    return bsdf<DiffuseDescription>("diffuse", "<texture name='reflectance' type='scale'><float name='scale' value='" +
                                                   by + "'/><texture type='checkerboard'/></texture>");
  };
  EXPECT_NO_THROW(scaled("2.5"));
  EXPECT_THROW(scaled("2.6"), InputError);
}

TEST(plugins, give_mitsubas_defaults_of_shapes) {
  EXPECT_EQ(shape<DiskDescription>("disk"), DiskDescription{});
  EXPECT_EQ(shape<CylinderDescription>("cylinder"), CylinderDescription{});
  EXPECT_EQ(shape<PlaneDescription>("plane"), PlaneDescription{});
  const auto field = shape<HeightfieldDescription>("heightfield");
  EXPECT_EQ(field.columns, 64);
  EXPECT_EQ(field.rows, 64);
  EXPECT_EQ(field.amplitude, 1);
  EXPECT_EQ(std::get<HeightfieldNoise>(field.height), HeightfieldNoise{});
  const auto bumpy = shape<HeightfieldDescription>("heightfield",
                                                   "<texture type='checkerboard' name='height'/><integer "
                                                   "name='columns' value='3'/><integer name='rows' value='2'/>");
  EXPECT_EQ(std::get<TextureIndex>(bumpy.height), TextureIndex{0});
  EXPECT_EQ(bumpy.columns, 3);
}

TEST(plugins, read_curves) {
  const auto of = [](const std::string& type, const std::string& file) {
    const std::string name = PHOTONPROOF_CORPORA "/curve_set_corpus/test.xml";
    const auto scene = parse(
        kSensor + kLight + "<shape type='" + type + "'><string name='filename' value='" + file + "'/></shape>", name);
    return std::get<CurvesDescription>(scene.shapes.at(0).geometry);
  };
  EXPECT_EQ(of("bsplinecurve", "bspline").basis, CurvesDescription::Basis::bspline);
  EXPECT_EQ(of("linearcurve", "linear").basis, CurvesDescription::Basis::linear);
  EXPECT_EQ(of("linearcurve", "linear").curves->first.size(), 2u);
  EXPECT_THROW(of("bsplinecurve", "linear"), InputError);
}

TEST(plugins, give_mitsubas_defaults_of_emitters) {
  EXPECT_EQ(light<SpotLightDescription>("spot"), SpotLightDescription{});
  EXPECT_EQ(light<SpotLightDescription>("spot", "<float name='cutoff_angle' value='40'/>").beam_degrees, 30)
      << "three quarters of the cut-off";
  const auto projector = light<ProjectorDescription>("projector");
  EXPECT_EQ(projector.irradiance, Colour(RgbD(1.0)));
  EXPECT_EQ(projector.scale, 1);
  EXPECT_EQ(projector.fov_axis, FovAxis::diagonal);
  EXPECT_NEAR(std::tan(projector.fov_degrees * M_PI / 360), std::hypot(36, 24) / 100, 1e-9) << "behind a lens of 50 mm";
  EXPECT_EQ(light<ProjectorDescription>("projector", "<float name='fov' value='30'/>").fov_axis, FovAxis::x);
  EXPECT_EQ(light<DirectionalLightDescription>("directional"), DirectionalLightDescription{});
  EXPECT_EQ(light<ConstantLightDescription>("constant"), ConstantLightDescription{});
  const auto sky = light<SunSkyDescription>("sunsky");
  EXPECT_EQ(sky.turbidity, 3);
  EXPECT_EQ(sky.albedo, RgbD(0.3));
  EXPECT_EQ(sky.sun_aperture_degrees, 0.5358);
  EXPECT_NEAR(length(sky.sun_direction), 1, 1e-8);
  EXPECT_GT(sky.sun_direction.z, 0.5) << "a summer afternoon in Tokyo";
}

TEST(plugins, turn_directions_into_unit_vectors_of_the_right_space) {
  const auto slanted = light<DirectionalLightDescription>("directional", "<vector name='direction' value='0, -3, 4'/>");
  EXPECT_EQ(slanted.direction, Vec3d(0, -0.6, 0.8));
  const auto turned = light<DirectionalLightDescription>(
      "directional", "<transform name='to_world'><rotate y='1' angle='90'/><scale value='5'/></transform>");
  EXPECT_NEAR(turned.direction.x, 1, 1e-12);
  // The sun's direction is given in world space and stored in the sky's space. The rotation about x by 90 degrees takes
  // local +z to world -y.
  const auto sky = light<SunSkyDescription>("sunsky",
                                            "<vector name='sun_direction' x='0' y='-2' z='0'/><transform "
                                            "name='to_world'><rotate x='1' angle='90'/></transform>");
  EXPECT_NEAR(sky.sun_direction.z, 1, 1e-8);
}

// Values of Mitsuba 3.9.1, scalar_rgb, traverse(load_string(...)). The <spectrum> of 10 gives [12.0479, 9.48291,
// 9.08916] in each, <float> and <rgb> give [10, 10, 10], the `albedo` of a sunsky 0.4.
TEST(plugins, read_the_number_of_a_lights_spectrum_as_white_of_equal_energy) {
  const auto ten = [](const std::string& tag, const std::string& name) {
    return "<" + tag + " name='" + name + "' value='10'/>";
  };
  const auto area = [&](const std::string& tag) {
    const std::string area_light = "<emitter type='area'>" + ten(tag, "radiance") + "</emitter>";
    return constant(*parse(kSensor + "<shape type='sphere'>" + area_light + "</shape>").shapes.at(0).radiance);
  };
  const std::string spectrum = ten("spectrum", "radiance"), intensity = ten("spectrum", "intensity");
  for (const RgbD& white :
       {area("spectrum"), light<ConstantLightDescription>("constant", spectrum).radiance,
        light<PointLightDescription>("point", intensity).intensity,
        light<SpotLightDescription>("spot", intensity).intensity,
        light<DirectionalLightDescription>("directional", ten("spectrum", "irradiance")).irradiance}) {
    EXPECT_NEAR(white.x, 12.0479, 1e-4);
    EXPECT_NEAR(white.y, 9.48291, 1e-5);
    EXPECT_NEAR(white.z, 9.08916, 1e-5);
  }
  for (const char* tag : {"rgb", "float"}) {
    EXPECT_EQ(area(tag), RgbD(10.0)) << tag;
    EXPECT_EQ(light<ConstantLightDescription>("constant", ten(tag, "radiance")).radiance, RgbD(10.0)) << tag;
  }
  EXPECT_EQ(light<SunSkyDescription>("sunsky", "<spectrum name='albedo' value='0.4'/>").albedo, RgbD(0.4));
}

TEST(plugins, give_mitsubas_defaults_of_sensors) {
  const SensorDescription pinhole = sensor("perspective");
  EXPECT_EQ(pinhole.film.width, 768);
  EXPECT_EQ(pinhole.film.filter, (ReconstructionFilter{ReconstructionFilter::Kind::gaussian, 0.5})) << "no film";
  EXPECT_EQ(sensor("perspective", "<film type='hdrfilm'/>").film.filter.kind, ReconstructionFilter::Kind::gaussian);
  const auto lens = std::get<ThinLensDescription>(
      sensor("thinlens", "<float name='aperture_radius' value='0.1'/><float name='far_clip' value='50'/>").camera);
  EXPECT_EQ(lens.aperture_radius, 0.1);
  EXPECT_EQ(lens.focus_distance, 50) << "far_clip";
  EXPECT_EQ(std::get<OrthographicDescription>(sensor("orthographic").camera), OrthographicDescription{});
  EXPECT_EQ(std::get<FisheyeDescription>(sensor("fisheye").camera), FisheyeDescription{});
}

TEST(plugins, read_films) {
  const FilmDescription film =
      sensor("perspective",
             "<film type='hdrfilm'><integer name='width' value='40'/><integer name='height' value='30'/>"
             "<integer name='crop_offset_x' value='4'/><integer name='crop_width' value='8'/>"
             "<string name='pixel_format' value='rgba'/><string name='component_format' value='float16'/>"
             "<rfilter type='tent'><float name='radius' value='2'/></rfilter></film>")
          .film;
  EXPECT_EQ(film.crop, (FilmDescription::Crop{4, 0, 8, 30}));
  EXPECT_TRUE(film.alpha);
  EXPECT_FALSE(film.sample_border);
  EXPECT_TRUE(sensor("perspective", "<film type='hdrfilm'><boolean name='sample_border' value='true'/></film>")
                  .film.sample_border);
  EXPECT_FALSE(sensor("perspective", "<film type='hdrfilm'/>").film.alpha);
  EXPECT_EQ(film.filter, (ReconstructionFilter{ReconstructionFilter::Kind::tent, 0.5, 2}));
}

TEST(plugins, take_filters_with_negative_lobes) {
  using Kind = ReconstructionFilter::Kind;
  const auto filter = [](const std::string& text) {
    return sensor("perspective", "<film type='hdrfilm'><rfilter " + text + "</rfilter></film>").film.filter;
  };
  EXPECT_EQ(filter("type='mitchell'>"), (ReconstructionFilter{.kind = Kind::mitchell}));
  EXPECT_EQ(filter("type='mitchell'><float name='B' value='0'/><float name='C' value='0.75'/>"),
            (ReconstructionFilter{.kind = Kind::mitchell, .b = 0, .c = 0.75}));
  EXPECT_EQ(filter("type='mitchell'><float name='radius' value='3'/>").mitchell_radius, 3);
  EXPECT_EQ(filter("type='catmullrom'>"), (ReconstructionFilter{.kind = Kind::catmullrom}));
  EXPECT_EQ(filter("type='lanczos'><integer name='lobes' value='4'/>"),
            (ReconstructionFilter{.kind = Kind::lanczos, .lobes = 4}));
  EXPECT_EQ(filter("type='sinc'><float name='radius' value='3'/><float name='tau' value='2'/>"),
            (ReconstructionFilter{.kind = Kind::sinc, .sinc_radius = 3, .tau = 2}));
}

TEST(plugins, take_any_of_mitsubas_samplers) {
  for (const char* type : {"independent", "stratified", "multijitter", "orthogonal", "ldsampler"})
    EXPECT_EQ(sensor("perspective",
                     "<sampler type='" + std::string(type) + "'><integer name='sample_count' value='16'/></sampler>")
                  .sample_count,
              16);
}

TEST(plugins, give_mitsubas_defaults_of_integrators) {
  EXPECT_EQ(integrator<VolPathDescription>("volpath"), VolPathDescription{});
  EXPECT_EQ(integrator<BdptDescription>("bdpt"), BdptDescription{});
  EXPECT_EQ(integrator<ParticleTracerDescription>("ptracer"), ParticleTracerDescription{});
  EXPECT_EQ(integrator<WhittedDescription>("whitted"), WhittedDescription{});
  EXPECT_EQ(integrator<DirectDescription>("direct"), DirectDescription{});
  const auto direct = integrator<DirectDescription>("direct", "<integer name='shading_samples' value='4'/>");
  EXPECT_EQ(direct.emitter_samples, 4);
  EXPECT_EQ(direct.bsdf_samples, 4);
  EXPECT_EQ(integrator<PathDescription>("moment",
                                        "<integrator type='path'><integer name='max_depth' value='2'/></integrator>")
                .max_depth,
            2);
}

TEST(plugins, read_media_of_shapes_and_cameras) {
  const auto scene =
      parse(kLight +
            "<sensor type='perspective'><ref name='medium' id='fog'/></sensor>"
            "<medium type='homogeneous' id='fog'/>"
            "<shape type='sphere'><ref name='exterior' id='fog'/><medium type='homogeneous' name='interior'>"
            "<float name='scale' value='3'/><phase type='hg'/></medium></shape>");
  ASSERT_EQ(scene.media.size(), 2u);
  EXPECT_EQ(std::get<HomogeneousDescription>(scene.media[0].model), HomogeneousDescription{});
  const auto& milk = std::get<HomogeneousDescription>(scene.media[1].model);
  EXPECT_EQ(milk.scale, 3);
  EXPECT_EQ(std::get<HenyeyGreensteinDescription>(milk.phase).g, 0.8);
  EXPECT_EQ(scene.shapes[0].exterior, MediumIndex{0});
  EXPECT_EQ(scene.shapes[0].interior, MediumIndex{1});
  EXPECT_EQ(scene.sensor.medium, MediumIndex{0});
}

template <class Model>
Model medium(const std::string& content, const std::string& version = "3.0.0", const std::string& name = "test.xml") {
  const bool varies = std::is_same_v<Model, HeterogeneousDescription>;
  const auto scene =
      parse_scene_text("<scene version='" + version + "'>" + kSensor + kLight + "<medium type='" +
                           (varies ? "heterogeneous" : "homogeneous") + "' id='m'>" + content + "</medium></scene>",
                       name);
  return std::get<Model>(scene.media.at(0).model);
}

TEST(plugins, read_absorption_and_scattering_in_place_of_extinction_and_albedo) {
  // sigma_t = (1, 2, 0) + (3, 0, 0), and the share of sigma_s is 3/4, 0 and nothing of nothing.
  const auto milk = medium<HomogeneousDescription>(
      "<rgb name='sigma_a' value='1,2,0'/><rgb name='sigma_s' value='3,0,0'/><float name='scale' value='2'/>");
  EXPECT_EQ(milk.sigma_t, RgbD(4, 2, 0));
  EXPECT_EQ(milk.albedo, VolumeColour(RgbD(0.75, 0, 0)));
  EXPECT_EQ(milk.scale, 2);
  const auto old = medium<HomogeneousDescription>(
      "<float name='sigmaA' value='1'/><spectrum name='sigmaS' value='1, 3, 0'/>", "0.6.0");
  EXPECT_EQ(old.sigma_t, RgbD(2, 4, 1));
  EXPECT_EQ(old.albedo, VolumeColour(RgbD(0.5, 0.75, 0)));
}

TEST(plugins, read_constant_volumes_as_colours) {
  const auto fog = medium<HomogeneousDescription>(
      "<volume type='constvolume' name='albedo'><rgb name='value' value='0.1,0.2,0.3'/></volume>"
      "<volume type='constvolume' name='sigma_t'><float name='value' value='7'/></volume>");
  EXPECT_EQ(fog.albedo, VolumeColour(RgbD(0.1, 0.2, 0.3)));
  EXPECT_EQ(fog.sigma_t, RgbD(7));
}

TEST(plugins, place_constant_volumes_of_media_that_vary) {
  const std::string moved = "<transform name='to_world'><translate x='3'/></transform>";
  const auto cloud = medium<HeterogeneousDescription>("<volume type='constvolume' name='sigma_t'>" + moved +
                                                      "<rgb name='value' value='1,2,7'/></volume>");
  EXPECT_EQ(cloud.sigma_t, VolumeColour(ConstantVolumeDescription{{1, 2, 7}, Transform::translate({3, 0, 0})}));
  EXPECT_THROW(medium<HeterogeneousDescription>("<volume type='constvolume' name='albedo'>" + moved +
                                                "<float name='value' value='1.1'/></volume>"),
               InputError);
  EXPECT_THROW(medium<HeterogeneousDescription>("<volume type='constvolume' name='sigma_t'>"
                                                "<transform name='to_world'><scale x='0'/></transform></volume>"),
               InputError);
  // A homogeneous medium fills its shape, whatever the box of its values.
  EXPECT_EQ(medium<HomogeneousDescription>("<volume type='constvolume' name='sigma_t'>" + moved +
                                           "<float name='value' value='7'/></volume>")
                .sigma_t,
            RgbD(7));
}

TEST(plugins, read_phase_functions) {
  const auto phase = [](const std::string& content) { return medium<HomogeneousDescription>(content).phase; };
  EXPECT_EQ(phase("<phase type='rayleigh'/>"), PhaseDescription(RayleighDescription{}));
  EXPECT_EQ(phase("<phase type='blendphase'><float name='weight' value='0.3'/><phase type='hg'/>"
                  "<phase type='isotropic'/></phase>"),
            PhaseDescription(BlendPhaseDescription{0.3, HenyeyGreensteinDescription{}, IsotropicDescription{}}));
}

TEST(plugins, read_grids_of_values) {
  const std::string name = PHOTONPROOF_CORPORA "/vol_corpus/test.xml";  // 00 has one cell of value 0
  const auto cloud = medium<HeterogeneousDescription>(
      "<volume type='gridvolume' name='sigma_t'><string name='filename' value='03'/>"
      "<string name='filter_type' value='nearest'/><string name='wrap_mode' value='mirror'/>"
      "<boolean name='use_grid_bbox' value='true'/><transform name='to_world'><scale value='2'/></transform></volume>"
      "<volume type='gridvolume' name='albedo'><string name='filename' value='00'/></volume>"
      "<float name='scale' value='5'/><phase type='hg'/>",
      "3.0.0", name);
  const auto& grid = std::get<GridVolumeDescription>(cloud.sigma_t);
  EXPECT_EQ(grid.grid->depth, 4);
  EXPECT_EQ(grid.filter, VolumeFilter::nearest);
  EXPECT_EQ(grid.wrap, TextureWrap::mirror);
  EXPECT_TRUE(grid.use_grid_bbox);
  EXPECT_EQ(grid.to_world, Transform::scale(Vec3d(2)));
  EXPECT_EQ(std::get<GridVolumeDescription>(cloud.albedo).wrap, TextureWrap::clamp);
  EXPECT_EQ(cloud.scale, 5);
  EXPECT_EQ(medium<HeterogeneousDescription>(""), HeterogeneousDescription{});
  const auto old = medium<HeterogeneousDescription>(
      "<volume type='gridvolume' name='density'><string name='filename' value='00'/></volume>"
      "<volume type='constvolume' name='albedo'><spectrum name='value' value='0.5'/></volume>",
      "0.6.0", name);
  EXPECT_TRUE(std::get<GridVolumeDescription>(old.sigma_t).use_grid_bbox);
  EXPECT_EQ(old.albedo, VolumeColour(RgbD(0.5)));
}

TEST(plugins, share_textures_bsdfs_and_groups_by_reference) {
  const auto scene =
      parse(kSensor + kLight +
            "<bsdf type='diffuse' id='a'><ref name='reflectance' id='t'/></bsdf><texture type='checkerboard' id='t'/>"
            "<alias id='a' as='b'/><shape type='instance'><ref id='g'/></shape><shape type='cube'><ref id='b'/></shape>"
            "<shape type='shapegroup' id='g'><shape type='sphere'><ref id='a'/></shape></shape>");
  EXPECT_EQ(scene.textures.size(), 1u);
  ASSERT_EQ(scene.bsdfs.size(), 1u);
  EXPECT_EQ(std::get<DiffuseDescription>(scene.bsdfs[0].model).reflectance, Colour(TextureIndex{0}));
  EXPECT_EQ(scene.shapes[1].bsdf, BsdfIndex{0});
  EXPECT_EQ(std::get<InstanceDescription>(scene.shapes[0].geometry).group, ShapeGroupIndex{0});
  EXPECT_EQ(scene.groups[0].shapes[0].bsdf, BsdfIndex{0});
}

TEST(plugins, put_nested_bsdfs_before_what_nests_them) {
  const auto scene = parse(kSensor + kLight +
                           "<bsdf type='mask' id='leaf'><bsdf type='twosided'><ref id='green'/></bsdf></bsdf>"
                           "<bsdf type='diffuse' id='green'/>");
  ASSERT_EQ(scene.bsdfs.size(), 3u);
  EXPECT_EQ(scene.bsdfs[0].id, "green");
  EXPECT_EQ(scene.bsdfs[2].id, "leaf");
}

TEST(plugins, limit_how_deep_references_nest_in_either_order) {
  const auto link = [](int i) {
    const std::string below = std::to_string(i - 1);
    return "<bsdf type='twosided' id='b" + std::to_string(i) + "'><ref id='b" + below + "'/><ref id='b" + below +
           "'/></bsdf>";
  };
  const std::string end = "<bsdf type='diffuse' id='b0'/>";
  std::string forwards, backwards;
  for (int i = 1; i < 64; ++i) forwards += link(i);
  EXPECT_NO_THROW(parse(kSensor + kLight + end + forwards)) << "64 deep, and 2^63 ways down";
  EXPECT_THROW(parse(kSensor + kLight + end + forwards + link(64)), InputError);
  for (int i = 64; i > 0; --i) backwards += link(i);
  EXPECT_THROW(parse(kSensor + kLight + backwards + end), InputError);
}

}  // namespace
}  // namespace photonproof::inline scenes_parser
