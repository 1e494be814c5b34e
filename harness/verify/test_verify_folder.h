// Runs of `photonproof verify` on small scenes, for tests.
#pragma once

#include <string>
#include <vector>

#include "reports/verify/verify_record.h"
#include "scenes/base/process.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_verify {

class VerifyTest : public FolderTest {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// `photonproof verify scene.xml` with the options, into out/.
  ProcessOutcome verify(std::vector<std::string> options, const std::string& scene = "scene.xml") const {
    std::vector<std::string> argv{PHOTONPROOF_BINARY, "verify", path(scene), "-o", path("out"),
                                  "--size",           "24x24",  "--seconds", "3",  "--no-probes"};
    argv.insert(argv.end(), options.begin(), options.end());
    return run_process(argv, {.wall_limit_seconds = 280});
  }
  VerifyScene verified() const { return read_verify_record(path("out/verify.json")).scenes.at(0); }

  /// A row that runs this command, as [[engine]] of a suite.
  static std::string row(const std::string& name, const std::string& command, const std::string& trust = "unbiased",
                         const std::string& budget = "spp") {
    return "[[engine]]\nname = '" + name + "'\ntitle = '" + name + "'\ncommand = [" + command +
           "]\nversions = [['{photonproof}', '--version']]\nbudgets = ['" + budget + "']\ntrust = '" + trust + "'\n";
  }
  /// `photonproof render` under a program before it: "'env', 'A=B', '/bin/photonproof'".
  static std::string render_command(const std::string& before, const std::string& integrator) {
    return before + ", 'render', '{scene}', '--integrator', '" + integrator +
           "', '-o', '{output}', '--stats', '{stats}', '--size', '{width}x{height}', '--seed', '{seed}', '--threads', "
           "'{threads}', '--checkpoint', '0', '--sampler', 'independent', '--allow-outside', '{budget}'";
  }

  /// The view is from (0, 0, 4) along -z, x to the right.
  void put_scene(const std::string& content, double fov = 40) const {
    put("scene.xml", R"(<scene version="3.0.0"><integrator type="path"/><sensor type="perspective">
      <float name="fov" value=")" +
                         std::to_string(fov) + R"("/><transform name="to_world">
      <lookat origin="0,0,4" target="0,0,0" up="0,1,0"/></transform><film type="hdrfilm">
      <integer name="width" value="24"/><integer name="height" value="24"/><rfilter type="box"/></film></sensor>)" +
                         content + "</scene>");
  }
  static std::string diffuse(const std::string& albedo) {
    return R"(<bsdf type="diffuse"><rgb name="reflectance" value=")" + albedo + R"("/></bsdf>)";
  }
  /// A rectangle of 2 x 2 under a transform.
  static std::string rectangle(const std::string& transform, const std::string& content) {
    return R"(<shape type="rectangle"><transform name="to_world">)" + transform + "</transform>" + content + "</shape>";
  }
  static std::string glow(const std::string& radiance) {
    return diffuse("0") + R"(<emitter type="area"><rgb name="radiance" value=")" + radiance + R"("/></emitter>)";
  }
  /// The back wall, and one on the left that faces it.
  static std::string walls(const std::string& back) {
    return rectangle(R"(<scale value="2"/>)", back) +
           rectangle(R"(<rotate y="1" angle="90"/><translate x="-1.2" z="1"/>)", diffuse("0.6,0.3,0.2"));
  }
  static std::string point_light() {
    return R"(<emitter type="point"><point name="position" value="0.5,0.4,1.4"/><rgb name="intensity" value="4"/>
      </emitter>)";
  }
  /// A light above and to the right, outside of the view.
  static std::string light() {
    return rectangle(R"(<scale value="0.7"/><rotate x="1" angle="120"/><translate x="0.6" y="2.4" z="1.6"/>)",
                     glow("9,8,7"));
  }
  static std::string glass_ball(const std::string& content = "") {
    return R"(<shape type="sphere"><point name="center" value="0.2,0,0.8"/><float name="radius" value="0.55"/>
      <bsdf type="dielectric"><float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/></bsdf>)" +
           content + "</shape>";
  }
};

}  // namespace photonproof::inline harness_verify
