// Runs the second program, photonproof-faulty (scenes/base/faults.h), in tests, with small scenes for it.
#pragma once

#include <cstdlib>
#include <string>
#include <vector>

#include "harness/gates/gate_mutants.h"
#include "scenes/base/process.h"
#include "scenes/files/test_folder.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_gates {

class FaultyProgramTest : public FolderTest {
 protected:
  const std::string sound = PHOTONPROOF_BINARY, faulty = sound + "-faulty";
  const std::string library = PHOTONPROOF_SOURCE_DIR "/scenes/library/";
  std::string size_ = "16x16", seed_ = "5";
  std::vector<std::string> kernels_ = kernels_with_faults("path");

  void TearDown() override {
    unsetenv("PHOTONPROOF_FAULT");
    FolderTest::TearDown();
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// An empty `fault` leaves the variable unset.
  ProcessOutcome run(const std::string& program, const std::string& fault, const std::string& scene,
                     std::vector<std::string> options) const {
    if (fault.empty())
      unsetenv("PHOTONPROOF_FAULT");
    else
      setenv("PHOTONPROOF_FAULT", fault.c_str(), 1);
    std::vector<std::string> argv{program,  "render", scene,       "-o", path("out.exr"), "--size", size_,
                                  "--seed", seed_,    "--threads", "2",  "--quiet"};
    argv.insert(argv.end(), kernels_.begin(), kernels_.end());
    argv.insert(argv.end(), options.begin(), options.end());
    return run_process(argv, {.wall_limit_seconds = 60});
  }
  Image render(const std::string& program, const std::string& fault, const std::string& scene,
               const std::vector<std::string>& options) const {
    const ProcessOutcome outcome = run(program, fault, scene, options);
    EXPECT_TRUE(outcome.ok()) << outcome.standard_error;
    return outcome.ok() ? read_image(path("out.exr")) : Image();
  }

  static double sum(const Image& image) {
    double all = 0;
    for (const float value : image.rgb) all += double{value};
    return all;
  }
  static double mean(const Image& image) { return sum(image) / static_cast<double>(image.rgb.size()); }

  /// Writes a scene seen from (0, 0, 4) along -z, the x axis to the right, `fov` degrees wide. `integrator`: "path", or
  /// with parameters after the quotes that end its name.
  std::string put_scene(const std::string& name, const std::string& integrator, const std::string& content,
                        double fov = 30, const std::string& filter = R"(<rfilter type="box"/>)",
                        const std::string& camera = "") const {
    put(name, "<scene version=\"3.0.0\"><integrator type=\"" + integrator +
                  R"(</integrator><sensor type="perspective"><float name="fov" value=")" + std::to_string(fov) +
                  "\"/>" + camera + R"(<transform name="to_world"><lookat origin="0,0,4" target="0,0,0" up="0,1,0"/>
                  </transform><film type="hdrfilm"><string name="component_format" value="float32"/>)" +
                  filter + "</film></sensor>" + content + "</scene>");
    return path(name);
  }

  /// The only visible shape: a wall in the plane z = 0, normal +z.
  static std::string wall(const std::string& bsdf) {
    return R"(<shape type="rectangle"><transform name="to_world"><scale value="4"/></transform>)" + bsdf + "</shape>";
  }
  static std::string diffuse(const std::string& reflectance) {
    return R"(<bsdf type="diffuse">)" + reflectance + "</bsdf>";
  }
  static std::string grey(double albedo) {
    return diffuse(R"(<rgb name="reflectance" value=")" + std::to_string(albedo) + "\"/>");
  }
  static std::string sky(double radiance) {
    return R"(<emitter type="constant"><rgb name="radiance" value=")" + std::to_string(radiance) + "\"/></emitter>";
  }
};

}  // namespace photonproof::inline harness_gates
