// The probes as data: a scene of a few lines, and the formula of its image. Those with files are in probe_files.cpp.

#include <cmath>
#include <vector>

#include "harness/verify/probe_scenes.h"
#include "reference/closed_forms/closed_forms_glass.h"
#include "reference/closed_forms/closed_forms_lights.h"
#include "reference/closed_forms/closed_forms_media.h"

namespace photonproof::inline harness_verify {
namespace {

using namespace probe_scenes;

constexpr double kFarLight = 1.8;  // x of lights, outside of the view at their height of 1.5

SurfacePoint floor_at(double x, double y) { return {{x, y, 0}, {0, 0, 1}}; }

const Vec3d kPoint{0.4, 0.2, 1.5};
RgbD by_point(double x, double y) { return lit(irradiance_of_point(5, kPoint, floor_at(x, y))); }
std::string point_light() {
  return R"(<emitter type="point"><point name="position" value="0.4,0.2,1.5"/><rgb name="intensity" value="5"/>
    </emitter>)";
}
RgbD by_spot(double x, double y) {
  return lit(irradiance_of_spot(9, {0.1, 0, 3}, {0, 0, -1}, {10 * kPi / 180, 25 * kPi / 180}, floor_at(x, y)));
}
const Vec3d kToBeam = Vec3d{-1, 0, 2} / std::sqrt(5.0);
RgbD by_beam(double, double) { return lit(irradiance_of_beam(2, -kToBeam, {0, 0, 1})); }
RgbD by_rectangle(double x, double y) {
  const double a = kFarLight - 0.4, b = kFarLight + 0.4;
  const Vec3d corners[] = {{a, 0.4, 1.5}, {b, 0.4, 1.5}, {b, -0.4, 1.5}, {a, -0.4, 1.5}};
  return lit(irradiance_of_polygon(10, corners, floor_at(x, y)));
}
RgbD by_ball(double x, double y) { return lit(irradiance_of_sphere(12, {kFarLight, 0, 1.5}, 0.4, floor_at(x, y))); }
RgbD by_disc(double x, double y) {
  return lit(irradiance_of_parallel_disc(10, 0.45, 1.5, std::hypot(x - kFarLight, y)));
}
const Vec3d kTubeEnds[] = {{kFarLight, -0.5, 1.5}, {kFarLight, 0.5, 1.5}};
RgbD by_tube(double x, double y) {
  return lit(irradiance_of_cylinder(20, kTubeEnds[0], kTubeEnds[1], 0.2, floor_at(x, y)));
}
RgbD under_sky(double, double) { return RgbD{1, 0.8, 0.6} * kAlbedo; }
RgbD tinted(double, double) { return {0.7, 0.45, 0.2}; }
RgbD mirrored(double, double) { return {0.9, 0.6, 0.3}; }
RgbD whole(double, double) { return RgbD(1.0); }

/// Cosine of the angle between the axis and the ray through (x, y). The image's edge is at half the field of view.
double cosine(double x, double y, double fov_degrees) {
  const double t = std::tan(fov_degrees * kPi / 360);
  return 1 / std::sqrt(1 + t * t * (x * x + y * y));
}
/// A clear coat of index 1.5 over a diffuse base; a way straight through it absorbs exp(-depth).
class Coat {
 public:
  explicit Coat(double depth) : depth_(depth) {
    constexpr int steps = 4000;
    for (int i = 0; i < steps; ++i) {
      const double angle = (i + 0.5) / steps * kPi / 2, sine = std::sin(angle);
      const double weight = std::sin(2 * angle) * kPi / 2 / steps;
      entered_ += (1 - mirrored(sine)) * absorbed(sine / kIndex) * weight;
      inside_ += (sine < 1 / kIndex ? mirrored(kIndex * sine) : 1) * std::pow(absorbed(sine), 2) * weight;
    }
  }
  /// Radiance under light 1 from all directions: reflection of the coat, and light that entered, was reflected back and
  /// forth and left.
  double seen(double x, double y) const {
    const double sine = std::sin(std::acos(cosine(x, y, kFov))), F = mirrored(sine);
    const double below = entered_ * kAlbedo / (1 - kAlbedo * inside_);
    return F + (1 - F) * absorbed(sine / kIndex) * below / (kIndex * kIndex);
  }

 private:
  static constexpr double kIndex = 1.5;
  static double mirrored(double sine) { return fresnel_reflectance(std::asin(sine), kIndex).unpolarised(); }
  double absorbed(double sine_within) const { return std::exp(-depth_ / std::sqrt(1 - sine_within * sine_within)); }

  double depth_;
  double entered_ = 0;  ///< share of diffuse light from above
  double inside_ = 0;   ///< share of diffuse light from below that comes back
};
RgbD by_plastic(double x, double y) {
  static const Coat coat(0);
  return RgbD(coat.seen(x, y));
}
RgbD by_lacquer(double x, double y) {
  static const Coat red(0.1), green(0.3), blue(0.8);
  return {red.seen(x, y), green.seen(x, y), blue.seen(x, y)};
}
/// A third of the surface is cut out, and the sky shines through.
RgbD behind_mask(double, double) { return RgbD(2 * kAlbedo / 3 + 1.0 / 3); }
RgbD blended(double, double) { return {0.75 * 0.8 + 0.25 * 0.2, 0.75 * 0.4 + 0.25 * 0.6, 0.75 * 0.1 + 0.25 * 0.9}; }
RgbD through_pane(double x, double y) {
  return RgbD(slab_transmittance(fresnel_reflectance(std::acos(cosine(x, y, 100)), 1.5).unpolarised()));
}
RgbD through_ink(double x, double y) {
  const double way = 1 / cosine(x, y, 60);
  return {transmittance(0.3, way), transmittance(1, way), transmittance(2.5, way)};
}
/// The angle from the axis is 35 degrees at the edge.
RgbD by_point_in_fisheye(double x, double y) {
  const double r = std::hypot(x, y), angle = r * 35 * kPi / 180;
  if (r >= 1) return RgbD(0.0);
  const double at = 4 * std::tan(angle) / std::max(r, 1e-12);
  return by_point(at * x, at * y);
}

/// GGX of roughness 0.3 times Smith's masking, separate for both directions, over 4 cosines (Walter et al. 2007): the
/// reflectance without the Fresnel factor.
double facets(const Vec3d& light, const Vec3d& eye) {
  constexpr double a2 = 0.3 * 0.3;
  const auto seen = [](double c) { return 2 / (1 + std::sqrt(1 + a2 * (1 - c * c) / (c * c))); };
  const double h = normalize(light + eye).z, below = h * h * (a2 - 1) + 1;
  return a2 / (kPi * below * below) * seen(light.z) * seen(eye.z) / (4 * light.z * eye.z);
}
Vec3d to_eye(double x, double y) { return normalize(Vec3d{-x, -y, 4}); }
RgbD by_rough_metal(double x, double y) {
  return RgbD{0.9, 0.6, 0.3} * (facets(kToBeam, to_eye(x, y)) * 2 * kToBeam.z);
}
/// The reflected part; light that goes through meets no surface.
double rough_glass(const Vec3d& light, const Vec3d& eye) {
  const double angle = std::acos(std::min(1.0, dot(light, normalize(light + eye))));
  return fresnel_reflectance(angle, 1.5).unpolarised() * facets(light, eye);
}
/// Black under its coat.
RgbD by_rough_coat(double x, double y) { return RgbD(rough_glass(kToBeam, to_eye(x, y)) * 2 * kToBeam.z); }
/// (n + 2) / (2 pi) cos^n of the angle to the mirrored eye (Lafortune and Willems 1994).
double lobe(const Vec3d& light, const Vec3d& eye) {
  constexpr int exponent = 20;
  const double off_mirror = dot(light, Vec3d{-eye.x, -eye.y, eye.z});
  return (exponent + 2) / (2 * kPi) * std::pow(std::max(0.0, off_mirror), exponent);
}
/// Radiance towards the eye from a floor with reflectance `f`, under light 1 from the whole upper half, by the midpoint
/// rule.
template <double (*f)(const Vec3d& light, const Vec3d& eye)>
double under_bright_ceiling(double x, double y) {
  constexpr int steps = 150, eyes = 9;
  constexpr double farthest = 0.06;  // 1 - cosine of the eye in the picture's corner
  static const std::vector<double> reflected = [] {
    std::vector<double> table;
    for (int e = 0; e < eyes; ++e) {
      const double c = 1 - farthest * e / (eyes - 1);
      const Vec3d eye{std::sqrt(1 - c * c), 0, c};
      double sum = 0;
      for (int i = 0; i < steps * steps; ++i) {
        const double z = (i / steps + 0.5) / steps, azimuth = (i % steps + 0.5) / steps * kPi, r = std::sqrt(1 - z * z);
        sum += f({r * std::cos(azimuth), r * std::sin(azimuth), z}, eye) * z * 2 * kPi / (steps * steps);
      }
      table.push_back(sum);
    }
    return table;
  }();
  const double at = (1 - to_eye(x, y).z) / farthest * (eyes - 1);
  const std::size_t below = std::min<std::size_t>(static_cast<std::size_t>(at), eyes - 2);
  const double share = at - static_cast<double>(below);
  return reflected[below] * (1 - share) + reflected[below + 1] * share;
}
RgbD by_rough_glass(double x, double y) { return RgbD(under_bright_ceiling<rough_glass>(x, y)); }
RgbD by_phong(double x, double y) {
  return RgbD{0.3, 0.2, 0.1} + RgbD{0.2, 0.4, 0.6} * under_bright_ceiling<lobe>(x, y);
}
/// Fields of 0.5 by 1, from the floor's corner at (-4, -4) on.
RgbD chequered(double x, double y) {
  const auto second_half = [](double u) { return u - std::floor(u) >= 0.5; };
  return second_half(x + 4) == second_half((y + 4) / 2) ? RgbD{0.8, 0.4, 0.1} : RgbD{0.2, 0.6, 0.9};
}

std::string beam() {
  return R"(<emitter type="directional"><vector name="direction" value="1,0,-2"/><rgb name="irradiance" value="2"/>
    </emitter>)";
}

std::vector<Probe> lights() {
  const std::string grey = camera() + floor_of(diffuse("0.5"));
  const auto far = [](const std::string& type, const std::string& scale) {
    return R"(<shape type=")" + type + R"("><transform name="to_world"><scale value=")" + scale +
           R"("/><rotate y="1" angle="180"/><translate x="1.8" z="1.5"/></transform>)";
  };
  return {
      {"light", "point light", grey + point_light() + "</scene>", by_point},
      {"light", "spot light", grey + R"(<emitter type="spot"><rgb name="intensity" value="9"/>
        <float name="cutoff_angle" value="25"/><float name="beam_width" value="10"/><transform name="to_world">
        <lookat origin="0.1,0,3" target="0.1,0,0" up="0,1,0"/></transform></emitter></scene>)",
       by_spot},
      {"light", "directional light", grey + beam() + "</scene>", by_beam},
      {"light", "rectangular light", grey + light(far("rectangle", "0.4"), 10) + "</scene>", by_rectangle},
      {"light", "spherical light",
       grey +
           light(R"(<shape type="sphere"><point name="center" value="1.8,0,1.5"/>
        <float name="radius" value="0.4"/>)",
                 12) +
           "</scene>",
       by_ball},
      {"light", "disk light", grey + light(far("disk", "0.45"), 10) + "</scene>", by_disc},
      {"light", "cylindrical light",
       grey +
           light(R"(<shape type="cylinder"><point name="p0" value="1.8,-0.5,1.5"/>
        <point name="p1" value="1.8,0.5,1.5"/><float name="radius" value="0.2"/>)",
                 20) +
           "</scene>",
       by_tube},
      {"light", "constant sky", grey + sky("1,0.8,0.6") + "</scene>", under_sky},
  };
}

std::vector<Probe> materials() {
  return {
      {"material", "diffuse", camera() + floor_of(diffuse("0.7,0.45,0.2")) + sky("1") + "</scene>", tinted},
      {"material", "mirror", camera() + floor_of(mirror("0.9,0.6,0.3")) + sky("1") + "</scene>", mirrored},
      {"material", "glass",
       along_z(100) + R"(<shape type="cube"><transform name="to_world">
        <scale x="2000" y="2000" z="0.05"/><translate z="1"/></transform><bsdf type="dielectric">
        <float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/></bsdf></shape>)" +
           wall_of_light() + "</scene>",
       through_pane},
      {"material", "thin glass",
       along_z(100) + R"(<shape type="rectangle"><transform name="to_world">
        <scale value="2000"/><translate z="1"/></transform><bsdf type="thindielectric">
        <float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/></bsdf></shape>)" +
           wall_of_light() + "</scene>",
       through_pane},
      {"material", "plastic",
       camera() + floor_of(R"(<bsdf type="plastic"><float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/>
        <rgb name="diffuse_reflectance" value="0.5"/><boolean name="nonlinear" value="true"/></bsdf>)") +
           sky("1") + "</scene>",
       by_plastic},
      {"material", "lacquer",
       camera() +
           floor_of(R"(<bsdf type="layered"><float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/>
        <rgb name="sigma_a" value="0.2,0.6,1.6"/><float name="thickness" value="0.5"/>)" +
                    diffuse("0.5") + "</bsdf>") +
           sky("1") + "</scene>",
       by_lacquer},
      {"material", "two-sided",
       camera() +
           R"(<shape type="rectangle"><transform name="to_world"><scale value="4"/><rotate y="1" angle="180"/>
        </transform><bsdf type="twosided">)" +
           diffuse("0") + diffuse("0.7,0.45,0.2") + "</bsdf></shape>" + sky("1") + "</scene>",
       tinted},
      {"material", "null",
       camera() + floor_of(diffuse("0.7,0.45,0.2")) + R"(<shape type="sphere"><bsdf type="null"/></shape>)" + sky("1") +
           "</scene>",
       tinted},
      {"material", "mask",
       camera() +
           floor_of(R"(<bsdf type="mask"><float name="opacity" value="0.6666666667"/>)" + diffuse("0.5") + "</bsdf>") +
           sky("1") + "</scene>",
       behind_mask},
      {"material", "blend",
       camera() +
           floor_of(R"(<bsdf type="blendbsdf"><float name="weight" value="0.25"/>)" + diffuse("0.8,0.4,0.1") +
                    diffuse("0.2,0.6,0.9") + "</bsdf>") +
           sky("1") + "</scene>",
       blended},
      {"material", "lossless glass",
       camera(40) + R"(<shape type="sphere"><bsdf type="dielectric">
        <float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/></bsdf></shape>)" +
           sky("1") + "</scene>",
       whole},
  };
}

std::vector<Probe> glossy_materials() {
  const std::string ggx = R"(<string name="distribution" value="ggx"/><float name="alpha" value="0.3"/>)";
  const std::string ceiling = wall_of_light(5) + "</scene>";
  return {
      {"material", "rough metal",
       camera() +
           floor_of(R"(<bsdf type="roughconductor">
        <string name="material" value="none"/><rgb name="specular_reflectance" value="0.9,0.6,0.3"/>)" +
                    ggx + "</bsdf>") +
           beam() + "</scene>",
       by_rough_metal},
      {"material", "rough glass",
       camera() +
           floor_of(R"(<bsdf type="roughdielectric">
        <float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/>)" +
                    ggx + "</bsdf>") +
           ceiling,
       by_rough_glass},
      {"material", "rough plastic",
       camera() +
           floor_of(R"(<bsdf type="roughplastic"><rgb name="diffuse_reflectance" value="0"/>
        <float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/>)" +
                    ggx + "</bsdf>") +
           beam() + "</scene>",
       by_rough_coat},
      {"material", "phong", camera() + floor_of(R"(<bsdf type="phong"><float name="exponent" value="20"/>
        <rgb name="diffuse_reflectance" value="0.3,0.2,0.1"/><rgb name="specular_reflectance" value="0.2,0.4,0.6"/>
        </bsdf>)") + ceiling,
       by_phong},
  };
}

std::vector<Probe> textures() {
  return {{"material", "checkerboard",
           camera() + floor_of(R"(<bsdf type="diffuse"><texture type="checkerboard" name="reflectance">
        <rgb name="color0" value="0.8,0.4,0.1"/><rgb name="color1" value="0.2,0.6,0.9"/>
        <transform name="to_uv"><scale x="8" y="4"/></transform></texture></bsdf>)") +
               sky("1") + "</scene>",
           chequered}};
}

/// The same floor under the same light, through every camera.
std::vector<Probe> cameras() {
  const std::string scenery = floor_of(diffuse("0.5")) + point_light() + "</scene>";
  const auto with = [&](const std::string& type, const std::string& parameters, const std::string& scale = "") {
    return R"(<scene version="3.0.0"><integrator type="path"/><sensor type=")" + type + "\">" + parameters +
           R"(<transform name="to_world">)" + scale + look_down() + "</transform>" + film() + scenery;
  };
  return {
      {"camera", "perspective camera", with("perspective", R"(<float name="fov" value="28.072487"/>)"), by_point},
      {"camera", "thin lens", with("thinlens", R"(<float name="fov" value="28.072487"/>
        <float name="aperture_radius" value="0.1"/><float name="focus_distance" value="4"/>)"),
       by_point},
      {"camera", "orthographic camera", with("orthographic", ""), by_point},
      {"camera", "fisheye camera", with("fisheye", R"(<float name="fov" value="70"/>)"), by_point_in_fisheye},
  };
}

std::vector<Probe> media() {
  const auto medium = [](const std::string& sigma_t, const std::string& albedo) {
    return R"(<medium type="homogeneous" id="m"><rgb name="sigma_t" value=")" + sigma_t +
           R"("/><rgb name="albedo" value=")" + albedo + R"("/></medium>)";
  };
  const std::string inside = R"(<bsdf type="null"/><ref name="interior" id="m"/></shape>)";
  return {
      {"medium", "absorbing medium",
       along_z(60) + medium("0.3,1,2.5", "0") + R"(<shape type="cube">
        <transform name="to_world"><scale x="50" y="50" z="0.5"/><translate z="2"/></transform>)" +
           inside + wall_of_light(4) + "</scene>",
       through_ink},
      {"medium", "scattering medium",
       camera(40) + medium("1", "1") + R"(<shape type="sphere">)" + inside + sky("1") + "</scene>", whole},
  };
}

}  // namespace

const std::vector<Probe>& probe_rows() {
  static const std::vector<Probe> rows = [] {
    std::vector<Probe> all;
    for (std::vector<Probe> part :
         {lights(), materials(), glossy_materials(), textures(), cameras(), media(), probes_with_files()})
      for (Probe& probe : part) all.push_back(std::move(probe));
    return all;
  }();
  return rows;
}

}  // namespace photonproof::inline harness_verify
