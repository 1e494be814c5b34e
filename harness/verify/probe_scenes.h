// Parts of the calibration probes' scenes. A lit floor is the plane z = 0, seen from (0, 0, 4) so that the image spans
// x and y from -1 to 1.
#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "harness/verify/probes.h"

namespace photonproof::probe_scenes {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kAlbedo = 0.5, kFov = 28.072486935852957;  // 2 atan(1/4): the floor's edges at +-1

std::string look_down();
/// A scene's text up to the end of its camera.
std::string camera(double fov = kFov, const std::string& transform = look_down());
std::string along_z(double fov);
std::string film();
std::string diffuse(const std::string& albedo);
std::string mirror(const std::string& reflectance);
std::string floor_of(const std::string& bsdf);
/// A black light that emits on its front; `shape` is a shape's opening text.
std::string light(const std::string& shape, double radiance);
std::string sky(const std::string& radiance);
/// A wall of light that fills the view behind the objects.
std::string wall_of_light(double z = 2);

/// Radiance of the floor of kAlbedo.
RgbD lit(double irradiance);

}  // namespace photonproof::probe_scenes

namespace photonproof::inline harness_verify {

/// Probes of lights and textures from files, and of the clear sky.
std::vector<Probe> probes_with_files();

}  // namespace photonproof::inline harness_verify
