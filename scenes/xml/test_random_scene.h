// Random scenes for tests of the writer.
#pragma once

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "scenes/description/description.h"
#include "scenes/xml/test_named_files.h"

namespace photonproof::inline scenes_xml {

/// Random but valid scenes in the parser's canonical form: objects with an id first, then the others in the order of
/// their use.
class RandomScene {
 public:
  RandomScene(unsigned seed, const NamedFiles& files) : files_(files), random_(seed) {}

  SceneDescription make() {
    for (std::size_t i = pick(3); i > 0; --i)
      named_textures_.push_back(add_texture("t" + std::to_string(i) + nasty(), true));
    for (std::size_t i = pick(3); i > 0; --i) scene_.media.push_back({{}, "m" + std::to_string(i) + nasty(), medium()});
    named_media_ = scene_.media.size();
    for (std::size_t i = 1 + pick(4); i > 0; --i) {
      const std::string id = "b" + std::to_string(i) + nasty();
      named_bsdfs_.push_back(add_bsdf(id, 0));
    }
    for (std::size_t i = pick(3); i > 0; --i) {
      ShapeGroupDescription group{{}, "g" + std::to_string(i) + nasty(), {}};
      for (std::size_t j = pick(3); j > 0; --j) group.shapes.push_back(shape("", false));
      scene_.groups.push_back(group);
    }
    for (std::size_t i = pick(6); i > 0; --i)
      scene_.shapes.push_back(shape(coin() ? "s" + std::to_string(i) + nasty() : "", true));
    scene_.emitters.push_back({{}, "", PointLightDescription{}});  // so that there is light
    for (std::size_t i = pick(4); i > 0; --i)
      scene_.emitters.push_back({{}, coin() ? "e" + std::to_string(i) + nasty() : "", light()});
    scene_.sensor = sensor();
    scene_.integrator.method = method();
    return std::move(scene_);
  }

 private:
  std::size_t pick(std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_); }
  bool coin() { return pick(2) == 1; }
  double unit() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  double positive() { return std::exp(std::uniform_real_distribution<double>(-80, 80)(random_)); }
  double refraction() { return std::exp(std::uniform_real_distribution<double>(-6.9, 6.9)(random_)); }
  double number() { return coin() ? positive() : -positive(); }
  Vec3d vector() { return {number(), number(), number()}; }
  RgbD rgb() { return {unit(), coin() ? 0.0 : 1.0, unit()}; }
  RgbD bright() { return {positive(), coin() ? 0.0 : positive(), positive()}; }

  /// Characters that XML, white space rules and `$name` could trip over.
  std::string nasty() {
    const char* const pieces[] = {"", " & <tag> \"quoted\" 'single'", "$size \\$ \\\\", "\ttab\nline\r\n", "grün ∮",
                                  "a"};
    return pieces[pick(6)];
  }

  Transform turned() { return Transform::rotate({unit() - 0.5, 1, 1}, 720 * unit()); }
  Transform similarity() {
    return Transform::translate(vector()) * Transform::rotate({number(), 1, 1}, 720 * unit()) *
           Transform::scale(Vec3d(positive()));
  }
  Transform stretched() { return similarity() * Transform::scale({0.5 + unit(), 0.5 + unit(), -0.5 - unit()}); }
  Transform any() { return coin() ? stretched() : Transform(); }

  /// A named one or a new one without an id.
  TextureIndex texture() {
    if (!named_textures_.empty() && coin()) return named_textures_[pick(named_textures_.size())];
    return add_texture("", false);
  }
  /// A texture; its values are at most 1. Those with an id nest only those without.
  TextureIndex add_texture(const std::string& id, bool alone) {
    if (pick(5) == 0) {
      scene_.textures.push_back({{}, id, MeshAttributeDescription{coin() ? "vertex_color" : "face_a_1", positive()}});
    } else if (pick(6) == 0) {
      scene_.textures.push_back({{}, id, VolumeTextureDescription{volume(rgb())}});
    } else if (pick(5) == 0) {
      const ScaledTextureDescription scaled{add_texture("", true), rgb()};
      scene_.textures.push_back({{}, id, scaled});
    } else if (coin()) {
      const auto filter = coin() ? TextureFilter::nearest : TextureFilter::bilinear;
      scene_.textures.push_back(
          {{}, id, BitmapDescription{"a.exr", files_.image, coin(), filter, static_cast<TextureWrap>(pick(3)), any()}});
    } else {
      CheckerboardDescription board{rgb(), rgb(), any()};
      if (!alone && pick(4) == 0) board.color0 = add_texture("", true);
      if (!alone && pick(4) == 0) board.color1 = texture();
      scene_.textures.push_back({{}, id, board});
    }
    return {static_cast<std::uint32_t>(scene_.textures.size() - 1)};
  }
  Colour colour() {
    if (pick(3) == 0) return texture();
    return rgb();
  }
  Scalar scalar(double most) {
    if (pick(3) == 0) return texture();
    return unit() * most + 1e-9;
  }

  MicrofacetDistribution distribution() {
    return coin() ? MicrofacetDistribution::ggx : MicrofacetDistribution::beckmann;
  }
  std::optional<ComplexIor> ior() {
    if (coin()) return std::nullopt;
    return ComplexIor{{unit(), 1, positive()}, {positive(), unit(), 0}};
  }

  BsdfIndex bsdf(int depth) {
    if (!named_bsdfs_.empty() && coin()) return named_bsdfs_[pick(named_bsdfs_.size())];
    return add_bsdf("", depth);
  }
  BsdfIndex add_bsdf(const std::string& id, int depth) {
    auto model = depth < 3 && pick(3) == 0 ? nesting(depth + 1) : leaf();
    scene_.bsdfs.push_back({{}, id, std::move(model)});
    return {static_cast<std::uint32_t>(scene_.bsdfs.size() - 1)};
  }
  BsdfIndex add_opaque() {
    scene_.bsdfs.push_back({{}, "", PlasticDescription{rgb(), rgb(), refraction(), refraction(), coin()}});
    return {static_cast<std::uint32_t>(scene_.bsdfs.size() - 1)};
  }

  // Members are filled in the order in which the parser reads them.
  decltype(BsdfDescription::model) leaf() {
    switch (pick(13)) {
      case 0:
        return DiffuseDescription{colour()};
      case 1:
        return ConductorDescription{ior(), colour()};
      case 2: {
        RoughConductorDescription m{distribution(), 0.1, 0.1, coin(), ior()};
        m.alpha_u = scalar(1);
        m.alpha_v = coin() ? m.alpha_u : scalar(1);
        m.specular_reflectance = colour();
        return m;
      }
      case 3: {
        DielectricDescription m{refraction(), refraction(), colour(), rgb(), std::nullopt};
        if (coin()) m.priority = static_cast<int>(pick(1000));
        return m;
      }
      case 4:
        return ThinDielectricDescription{refraction(), refraction(), rgb(), colour()};
      case 5: {
        RoughDielectricDescription m{distribution(), 0.1, 0.1, coin(), refraction(), refraction()};
        m.alpha_u = m.alpha_v = scalar(3);
        m.specular_transmittance = colour();
        return m;
      }
      case 6: {
        PlasticDescription m{rgb(), rgb(), refraction(), refraction(), coin()};
        (coin() ? m.diffuse_reflectance : m.specular_reflectance) = colour();
        return m;
      }
      case 7: {
        RoughPlasticDescription m{distribution(), positive(), coin(), rgb(), rgb(), refraction(), refraction(), coin()};
        (coin() ? m.diffuse_reflectance : m.specular_reflectance) = colour();
        return m;
      }
      case 8:
        return PhongDescription{positive(), colour(), rgb()};
      case 9: {
        PrincipledDescription m{.base_color = colour(), .roughness = scalar(1)};
        if (coin()) m.eta = refraction();
        m.metallic = scalar(1);
        m.clearcoat_rate = positive();
        return m;
      }
      case 10: {
        PrincipledThinDescription m{.base_color = rgb(), .roughness = scalar(1)};
        m.diff_trans = scalar(2);
        m.transmitted_rate = positive();
        return m;
      }
      case 11:
        return DiffuseTransmitterDescription{colour()};
      default:
        return NullDescription{};
    }
  }

  decltype(BsdfDescription::model) nesting(int depth) {
    switch (pick(6)) {
      case 0: {
        LayeredDescription m{{}, refraction(), refraction(), bright(), positive(), colour()};
        m.base = add_opaque();
        return m;
      }
      case 1: {
        const BsdfIndex front = add_opaque();
        return TwoSidedDescription{front, coin() ? front : add_opaque()};
      }
      case 2: {
        const Scalar opacity = scalar(1);
        return MaskDescription{opacity, bsdf(depth)};
      }
      case 3: {
        const Scalar weight = scalar(1);
        const BsdfIndex first = bsdf(depth);
        return BlendDescription{weight, first, bsdf(depth)};
      }
      case 4: {
        const TextureIndex height = texture();
        return BumpMapDescription{height, number(), bsdf(depth), {coin(), coin()}};
      }
      default: {
        const TextureIndex normals = texture();
        return NormalMapDescription{normals, bsdf(depth), {coin(), coin()}};
      }
    }
  }

  PhaseLobe lobe() {
    if (coin()) return HenyeyGreensteinDescription{1.9 * unit() - 0.95};
    if (coin()) return RayleighDescription{};
    return IsotropicDescription{};
  }
  PhaseDescription phase() {
    if (coin()) return BlendPhaseDescription{coin() ? VolumeNumber(grid()) : unit(), lobe(), lobe()};
    return std::visit([](const auto& l) -> PhaseDescription { return l; }, lobe());
  }
  VolumeColour volume(const RgbD& constant) {
    if (coin()) return constant;
    return coin() ? VolumeColour(ConstantVolumeDescription{constant, similarity()}) : grid();
  }
  GridVolumeDescription grid() {
    const auto wrap = static_cast<TextureWrap>(pick(3));
    return {"a.vol", files_.grid, coin(), static_cast<VolumeFilter>(pick(2)), wrap, coin(), similarity()};
  }
  decltype(MediumDescription::model) medium() {
    if (coin()) return HeterogeneousDescription{volume(bright()), volume(rgb()), positive(), phase()};
    return HomogeneousDescription{bright(), coin() ? VolumeColour(rgb()) : grid(), positive(), phase()};
  }
  MediumIndex any_medium() {
    if (named_media_ > 0 && coin()) return {static_cast<std::uint32_t>(pick(named_media_))};
    scene_.media.push_back({{}, "", medium()});
    return {static_cast<std::uint32_t>(scene_.media.size() - 1)};
  }

  HeightfieldDescription heightfield() {
    HeightfieldDescription field{1 + static_cast<int>(pick(4000)), 1 + static_cast<int>(pick(4000)), number(), coin(),
                                 HeightfieldNoise{unit(), 2 * unit(), 5, 4294967295u}};
    if (coin()) field.height = texture();
    return field;
  }

  MeshDescription mesh() {
    using Format = MeshDescription::Format;
    if (coin()) return {Format::ply, "a.ply", coin(), coin(), files_.mesh_of_ply};
    return {Format::obj, "a.obj", coin(), coin(), files_.mesh_of_obj};
  }

  decltype(ShapeDescription::geometry) curves_or_ellipsoids() {
    if (coin()) return CurvesDescription{static_cast<CurvesDescription::Basis>(pick(2)), "a.txt", files_.curves};
    EllipsoidsDescription cloud;
    cloud.filename = "e.ply";
    cloud.cloud = files_.cloud;
    cloud.triangles = coin();
    if (cloud.triangles) cloud.shell = static_cast<Shell>(pick(4));
    cloud.scale_factor = positive();
    cloud.extent = positive();
    cloud.adapts_extent = coin();
    return cloud;
  }

  ShapeDescription shape(const std::string& id, bool in_scene) {
    ShapeDescription result;
    result.id = id;
    result.to_world = similarity();
    bool emits = in_scene, has_media = true;
    switch (pick(in_scene && !scene_.groups.empty() ? 11 : 10)) {
      case 0:
        result.geometry = SphereDescription{vector(), positive()};
        break;
      case 1:
        result.geometry = RectangleDescription{};
        result.to_world = stretched();
        break;
      case 2:
        result.geometry = mesh();
        result.to_world = stretched();
        break;
      case 3:
        result.geometry = DiskDescription{};
        break;
      case 4:
        result.geometry = CylinderDescription{vector(), vector(), positive()};
        break;
      case 5:
        result.geometry = PlaneDescription{};
        emits = false;
        break;
      case 6:
        result.geometry = heightfield();
        break;
      case 7:
        result.geometry = CubeDescription{};
        result.to_world = any();
        break;
      case 8:
        result.geometry = curves_or_ellipsoids();
        result.to_world = stretched();
        emits = has_media = false;
        break;
      case 9:
        result.geometry =
            SdfGridDescription{"b.vol", files_.distances, static_cast<SdfGridDescription::Normals>(pick(2))};
        result.to_world = stretched();
        emits = false;
        break;
      default:
        result.geometry = InstanceDescription{{static_cast<std::uint32_t>(pick(scene_.groups.size()))}};
        result.to_world = stretched();
        return result;
    }
    result.flip_normals = coin();
    result.bsdf = bsdf(0);
    if (has_media && coin()) result.interior = any_medium();
    if (has_media && coin()) result.exterior = any_medium();
    if (emits && coin()) result.radiance = pick(3) == 0 ? Colour(texture()) : Colour(bright());
    return result;
  }

  decltype(EmitterDescription::light) light() {
    switch (pick(environment_ ? 5 : 8)) {
      case 0:
        return PointLightDescription{vector(), bright()};
      case 1: {
        SpotLightDescription spot{similarity(), bright(), 1e-6 + 89 * unit(), 0, std::nullopt};
        spot.beam_degrees = spot.cutoff_degrees * unit();
        if (coin()) spot.texture = texture();
        return spot;
      }
      case 2:
        return DirectionalLightDescription{normalize(Vec3d(unit(), unit(), -1)), bright()};
      case 3:
        return IesLightDescription{"a.ies", files_.profile, bright(), similarity()};
      case 4:
        return ProjectorDescription{pick(3) == 0 ? Colour(texture()) : Colour(bright()), positive(), 1 + 170 * unit(),
                                    static_cast<FovAxis>(pick(5)), similarity()};
      case 5:
        environment_ = true;
        return ConstantLightDescription{bright()};
      case 6:
        environment_ = true;
        return EnvmapDescription{"a.exr", files_.image, positive(), similarity()};
      default: {
        environment_ = true;
        // The parser rounds a direction to multiples of 2^-30.
        const Vec3d d = normalize(Vec3d(unit(), unit(), unit() + 0.1)) * static_cast<double>(1 << 30);
        const Vec3d on_grid = Vec3d(std::round(d.x), std::round(d.y), std::round(d.z)) / static_cast<double>(1 << 30);
        return SunSkyDescription{on_grid, 1 + 9 * unit(), rgb(), positive(), positive(), 1e-3 + 80 * unit(), turned()};
      }
    }
  }

  SensorDescription sensor() {
    SensorDescription result;
    if (coin()) result.id = "sensor" + nasty();
    const double near = positive(), far = near * (1.5 + unit());
    const PerspectiveDescription lens{
        180 * unit() + 1e-9, static_cast<FovAxis>(pick(5)), near, far, number(), number()};
    result.to_world = Transform::look_at(Vec3d(unit()), {3, unit(), 4}, {0, 1, 0});
    switch (pick(4)) {
      case 0:
        result.camera = lens;
        break;
      case 1:
        result.camera = ThinLensDescription{lens, positive(), positive()};
        break;
      case 2:
        result.camera = OrthographicDescription{near, far};
        result.to_world = stretched();
        break;
      default:
        result.camera = FisheyeDescription{1 + 359 * unit(), near, far};
    }
    result.film = {1 + static_cast<int>(pick(65536)), 1 + static_cast<int>(pick(4096)), {}, std::nullopt};
    using Kind = ReconstructionFilter::Kind;
    switch (pick(7)) {
      case 3:
        result.film.filter = {.kind = Kind::mitchell, .b = unit(), .c = unit()};
        if (coin()) result.film.filter.mitchell_radius = 0.5 + 15 * unit();
        break;
      case 4:
        result.film.filter = {.kind = Kind::catmullrom};
        break;
      case 5:
        result.film.filter = {.kind = Kind::lanczos, .lobes = 1 + static_cast<int>(pick(16))};
        break;
      case 6:
        result.film.filter = {.kind = Kind::sinc, .sinc_radius = 0.5 + 15 * unit(), .tau = 1 + unit()};
        break;
      case 0:
        result.film.filter = {ReconstructionFilter::Kind::box};
        break;
      case 1:
        result.film.filter = {ReconstructionFilter::Kind::tent, 0.5, 1e-3 + unit()};
        break;
      default:
        result.film.filter = {ReconstructionFilter::Kind::gaussian, 1e-3 + unit()};
    }
    result.film.sample_border = coin();
    result.film.alpha = coin();
    if (coin()) result.film.crop = FilmDescription::Crop{0, result.film.height - 1, 1, 1};
    result.sample_count = 1 + static_cast<int>(pick(100000));
    if (coin()) result.medium = any_medium();
    return result;
  }

  template <class Method>
  Method limited() {
    Method method;
    method.max_depth = coin() ? -1 : 1 + static_cast<int>(pick(100));
    method.rr_depth = 1 + static_cast<int>(pick(100));
    method.hide_emitters = coin();
    return method;
  }
  decltype(IntegratorDescription::method) method() {
    switch (pick(8)) {
      case 0:
        return limited<PathDescription>();
      case 1:
        return limited<VolPathDescription>();
      case 2:
        return limited<BdptDescription>();
      case 3:
        return limited<ParticleTracerDescription>();
      case 4:
        return limited<WhittedDescription>();
      case 6: {
        RadianceFieldDescription field;
        field.max_depth = coin() ? -1 : 1 + static_cast<int>(pick(100));
        field.srgb_primitives = coin();
        return field;
      }
      case 5: {
        DirectDescription direct;
        direct.hide_emitters = coin();
        direct.emitter_samples = 1 + static_cast<int>(pick(9));
        direct.bsdf_samples = static_cast<int>(pick(9));
        return direct;
      }
      default: {
        auto photons = limited<PhotonMapperDescription>();
        photons.global_photons = static_cast<std::int64_t>(pick(1u << 30)) << 9;
        photons.caustic_photons = 0;
        photons.global_radius = positive();
        photons.indirect = static_cast<IndirectLight>(pick(5));
        photons.gather_rays = 4 + pick(1000);
        return photons;
      }
    }
  }

  const NamedFiles& files_;
  std::mt19937 random_;
  SceneDescription scene_;
  std::vector<TextureIndex> named_textures_;
  std::size_t named_media_ = 0;
  std::vector<BsdfIndex> named_bsdfs_;
  bool environment_ = false;
};

}  // namespace photonproof::inline scenes_xml
