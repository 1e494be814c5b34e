#include "harness/verify/probe_scenes.h"

namespace photonproof::probe_scenes {

std::string film() {
  return R"(<film type="hdrfilm"><integer name="width" value="32"/><integer name="height" value="32"/>
    <rfilter type="box"/></film></sensor>)";
}

std::string look_down() { return R"(<lookat origin="0,0,4" target="0,0,0" up="0,1,0"/>)"; }

std::string camera(double fov, const std::string& transform) {
  return R"(<scene version="3.0.0"><integrator type="path"/><sensor type="perspective"><float name="fov" value=")" +
         std::to_string(fov) + R"("/><transform name="to_world">)" + transform + "</transform>" + film();
}

std::string along_z(double fov) { return camera(fov, R"(<lookat origin="0,0,0" target="0,0,1" up="0,1,0"/>)"); }

std::string diffuse(const std::string& albedo) {
  return R"(<bsdf type="diffuse"><rgb name="reflectance" value=")" + albedo + R"("/></bsdf>)";
}

std::string mirror(const std::string& reflectance) {
  return R"(<bsdf type="conductor"><string name="material" value="none"/><rgb name="specular_reflectance" value=")" +
         reflectance + R"("/></bsdf>)";
}

std::string floor_of(const std::string& bsdf) {
  return R"(<shape type="rectangle"><transform name="to_world"><scale value="4"/></transform>)" + bsdf + "</shape>";
}

std::string light(const std::string& shape, double radiance) {
  return shape + diffuse("0") + R"(<emitter type="area"><rgb name="radiance" value=")" + std::to_string(radiance) +
         R"("/></emitter></shape>)";
}

std::string sky(const std::string& radiance) {
  return R"(<emitter type="constant"><rgb name="radiance" value=")" + radiance + R"("/></emitter>)";
}

std::string wall_of_light(double z) {
  return light(R"(<shape type="rectangle"><transform name="to_world"><scale value="2000"/><rotate y="1" angle="180"/>
    <translate z=")" +
                   std::to_string(z) + R"("/></transform>)",
               1);
}

RgbD lit(double irradiance) { return RgbD(kAlbedo * irradiance / kPi); }

}  // namespace photonproof::probe_scenes
