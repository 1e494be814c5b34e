#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>

#include "harness/stress/stress_scene.h"
#include "scenes/files/atomic_file.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_stress {
namespace {

namespace fs = std::filesystem;

MeshDescription pyramid(const fs::path& assets) {
  return mesh_file(assets, "pyramid",
                   mesh_of({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 1}},
                           {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}));
}

/// 16 x 8 pixels between 0.2 and 1, as an EXR: different colours and no symmetry.
std::string picture_file(const fs::path& assets) {
  Rendering picture;
  picture.mean = Image(16, 8);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 16; ++x)
      for (int c = 0; c < 3; ++c)
        picture.mean.pixel(x, y)[c] = 0.2f + 0.05f * static_cast<float>((3 * x + 5 * y + 7 * c) % 17);
  const fs::path file = fs::absolute(assets / "picture.exr");
  write_exr(file.string(), picture);
  return file.string();
}

/// Normals that lean by up to 0.3, n = 2 rgb - 1.
std::string normals_file(const fs::path& assets) {
  Rendering picture;
  picture.mean = Image(8, 8);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      const float a = 0.3f * std::sin(static_cast<float>(x)), b = 0.3f * std::cos(static_cast<float>(2 * y));
      float* p = picture.mean.pixel(x, y);
      p[0] = 0.5f + 0.5f * a;
      p[1] = 0.5f + 0.5f * b;
      p[2] = 0.5f + 0.5f * std::sqrt(1 - a * a - b * b);
    }
  const fs::path file = fs::absolute(assets / "normals.exr");
  write_exr(file.string(), picture);
  return file.string();
}

std::string light_file(const fs::path& assets) {
  const fs::path file = fs::absolute(assets / "lamp.ies");
  write_file_atomically(file,
                        "IESNA:LM-63-1995\nTILT=NONE\n1 1000 1 3 1 1 2 0.1 0.1 0\n1 1 10\n0 60 90\n0\n200 100 0\n");
  return file.string();
}

SceneDescription with_shape(const Geometry& geometry, const Transform& to_world) {
  SceneDescription scene = lit_stress_scene();
  add_shape(scene, geometry, to_world, {0});
  return scene;
}

void add_shapes(std::vector<NamedScene>& scenes, const fs::path& assets) {
  const auto add = [&](const char* name, const Geometry& geometry, const Transform& to_world) {
    scenes.emplace_back(std::string("shape ") + name, with_shape(geometry, to_world));
  };
  add("sphere", SphereDescription{}, standing({0, 1, 0}, 1));
  add("rectangle", RectangleDescription{}, lying({0, 0.5, 0}, 1) * Transform::rotate({1, 0, 0}, 20));
  add("disk", DiskDescription{}, lying({0, 0.5, 0}, 1) * Transform::rotate({1, 0, 0}, 20));
  add("cube", CubeDescription{}, standing({0, 0.7, 0}, 0.7) * Transform::rotate({0, 1, 0}, 30));
  add("cylinder", CylinderDescription{}, lying({0, 0, 0}, 1));
  add("heightfield", HeightfieldDescription{8, 8, 0.3, true, HeightfieldNoise{2, 2, 2, 7}}, lying({0, 0.4, 0}, 1.2));
  add("mesh", pyramid(assets), lying({0, 0.01, 0}, 1));
  SceneDescription plane = with_shape(SphereDescription{}, standing({0, 1, 0}, 1));
  plane.shapes[0].geometry = PlaneDescription{};
  plane.shapes[0].to_world = lying({0, 0, 0}, 1);
  scenes.emplace_back("shape plane", plane);
  SceneDescription instance = lit_stress_scene();
  ShapeGroupDescription group;
  group.id = "group";
  ShapeDescription member;
  member.geometry = pyramid(assets);
  group.shapes.push_back(member);
  instance.groups.push_back(group);
  add_shape(instance, InstanceDescription{{0}}, lying({0, 0.01, 0}, 1), {0});
  scenes.emplace_back("shape instance", instance);
}

/// BSDFs made of others stand on the ball as the last BSDF.
SceneDescription stress_scene_with_wrapped(const BsdfModel& inner, const std::function<BsdfModel(BsdfIndex)>& wrap) {
  SceneDescription scene = stress_scene_with_bsdf(inner);
  const BsdfIndex own = scene.shapes.back().bsdf;
  scene.bsdfs[own.value].id = "inner";
  scene.shapes.back().bsdf = add_bsdf(scene, wrap(own));
  return scene;
}

void add_plain_bsdfs(std::vector<NamedScene>& scenes) {
  const auto add = [&](const char* name, const BsdfModel& model) {
    scenes.emplace_back(std::string("bsdf ") + name, stress_scene_with_bsdf(model));
  };
  add("diffuse", DiffuseDescription{RgbD{0.7, 0.4, 0.2}});
  add("conductor", ConductorDescription{ComplexIor{RgbD{0.2, 0.9, 1.1}, RgbD{3.9, 2.4, 2.2}}});
  add("roughconductor", of_roughness<RoughConductorDescription>(0.2));
  add("dielectric", DielectricDescription{});
  add("thindielectric", ThinDielectricDescription{});
  add("roughdielectric", of_roughness<RoughDielectricDescription>(0.2));
  add("plastic", PlasticDescription{});
  add("roughplastic", of_roughness<RoughPlasticDescription>(0.2));
  add("phong", PhongDescription{});
  add("principled", PrincipledDescription{.metallic = 0.4, .clearcoat = 0.6});
  add("principledthin", PrincipledThinDescription{.spec_trans = 0.4, .diff_trans = 0.5});
}

void add_wrapping_bsdfs(std::vector<NamedScene>& scenes, const fs::path& assets) {
  const auto add = [&](const char* name, const BsdfModel& inner, const std::function<BsdfModel(BsdfIndex)>& wrap) {
    scenes.emplace_back(std::string("bsdf ") + name, stress_scene_with_wrapped(inner, wrap));
  };
  const DiffuseDescription red{RgbD{0.7, 0.4, 0.2}};
  add("twosided", red, [](BsdfIndex i) { return TwoSidedDescription{i, i}; });
  add("mask", red, [](BsdfIndex i) { return MaskDescription{0.6, i}; });
  add("blendbsdf", red, [](BsdfIndex i) { return BlendDescription{0.3, i, BsdfIndex{0}}; });
  add("layered", red, [](BsdfIndex i) {
    LayeredDescription lacquer;
    lacquer.base = i;
    lacquer.sigma_a = RgbD{0.1, 0.3, 0.5};
    return lacquer;
  });
  add("bumpmap", red, [](BsdfIndex i) {
    BumpMapDescription bumps;
    bumps.height = TextureIndex{1};
    bumps.scale = 0.2;
    bumps.nested = i;
    return bumps;
  });
  const auto add_texture = [&](const std::string& file, bool raw) {
    BitmapDescription bitmap;
    bitmap.filename = file;
    bitmap.raw = raw;
    scenes.back().second.textures.push_back({{}, "bitmap", bitmap});
  };
  add_texture(picture_file(assets), true);
  add("normalmap", red, [](BsdfIndex i) { return NormalMapDescription{TextureIndex{1}, i}; });
  add_texture(normals_file(assets), true);
}

void add_shapes_that_emit(std::vector<NamedScene>& scenes, const fs::path& assets) {
  const auto add = [&](const char* name, const Geometry& geometry, const Transform& to_world, double radiance) {
    scenes.emplace_back(std::string("light ") + name, stress_scene_under_shape(geometry, to_world, radiance));
  };
  add("rectangle", RectangleDescription{}, hanging({1, 5, -1}, 1), 6);
  add("disk", DiskDescription{}, hanging({1, 5, -1}, 1), 8);
  add("sphere", SphereDescription{}, standing({1, 5, -1}, 0.5), 24);
  add("cylinder", CylinderDescription{}, standing({1, 4.5, -1}, 0.5), 20);
  add("mesh", pyramid(assets), hanging({1, 5, -1}, 0.8), 8);
}

void add_lights(std::vector<NamedScene>& scenes, const fs::path& assets) {
  const auto add = [&](const char* name, const Light& light) {
    scenes.emplace_back(std::string("light ") + name, stress_scene_under(light));
  };
  const Transform down = Transform::look_at({1, 5, -1}, {0, 0, 0}, {0, 0, 1});
  add("point", PointLightDescription{{1, 5, -1}, RgbD(20)});
  SpotLightDescription spot;
  spot.to_world = down;
  spot.intensity = RgbD(30);
  spot.cutoff_degrees = 35;
  spot.beam_degrees = 20;
  add("spot", spot);
  const Vec3d slanted{-0.36, -0.8, 0.48};
  add("directional", DirectionalLightDescription{slanted, RgbD(2)});
  add("constant", ConstantLightDescription{});
  EnvmapDescription sky;
  sky.filename = picture_file(assets);
  add("envmap", sky);
  SunSkyDescription sun;
  sun.sun_direction = {0.36, -0.48, 0.8};
  sun.sun_aperture_degrees = 5;
  sun.to_world = Transform::rotate({1, 0, 0}, -90);
  add("sunsky", sun);
  IesLightDescription ies;
  ies.filename = light_file(assets);
  ies.intensity = RgbD(0.1);
  ies.to_world = Transform::translate({1, 5, -1}) * Transform::rotate({1, 0, 0}, -90);
  add("ies", ies);
}

void add_cameras(std::vector<NamedScene>& scenes) {
  SceneDescription scene = with_shape(SphereDescription{}, standing({0, 1, 0}, 1));
  PerspectiveDescription camera;
  camera.fov_degrees = 32;
  scene.sensor.camera = ThinLensDescription{camera, 0.3, 6.5};
  scenes.emplace_back("camera thinlens", scene);
  scene.sensor.camera = FisheyeDescription{60, 1e-2, 1e4};
  scenes.emplace_back("camera fisheye", scene);
  scene.sensor.camera = OrthographicDescription{};
  scene.sensor.to_world = scene.sensor.to_world * Transform::scale({2, 2, 1});
  scenes.emplace_back("camera orthographic", scene);
}

void add_textures_and_media(std::vector<NamedScene>& scenes, const fs::path& assets) {
  SceneDescription scene = stress_scene_with_bsdf(DiffuseDescription{});
  BitmapDescription bitmap;
  bitmap.filename = picture_file(assets);
  scene.textures.push_back({{}, "bitmap", bitmap});
  std::get<DiffuseDescription>(scene.bsdfs.back().model).reflectance = TextureIndex{1};
  scenes.emplace_back("texture bitmap", scene);
  SceneDescription fog = lit_stress_scene();
  fog.media.push_back({{}, "fog", HomogeneousDescription{RgbD{0.5, 0.7, 1.0}, RgbD(0.8), 1, {}}});
  add_shape(fog, SphereDescription{}, standing({0, 1, 0}, 1), add_bsdf(fog, NullDescription{})).interior =
      MediumIndex{0};
  scenes.emplace_back("medium homogeneous", fog);
}

}  // namespace

std::vector<NamedScene> scenes_of_features(const fs::path& assets) {
  std::vector<NamedScene> scenes;
  add_shapes(scenes, assets);
  add_plain_bsdfs(scenes);
  add_wrapping_bsdfs(scenes, assets);
  add_shapes_that_emit(scenes, assets);
  add_lights(scenes, assets);
  add_cameras(scenes);
  add_textures_and_media(scenes, assets);
  return scenes;
}

}  // namespace photonproof::inline harness_stress
