// The second program, photonproof-faulty (scenes/base/faults.h). Without a fault it equals the first. The effect of its
// faults on an image follows from theory; faults_of_*_test.cpp test more of them. The self-test of gates relies on
// both.

#include <cmath>
#include <numbers>

#include "harness/gates/gate_mutants.h"
#include "harness/gates/test_faulty_program.h"

namespace photonproof::inline harness_gates {
namespace {

// A square light that emits only upwards, onto a mirror above it. The floor below gets its light only from the mirror.
// Paths have three edges, so that no light goes from the floor to the mirror a second time.
constexpr const char* light_by_mirror = R"xml(<scene version="3.0.0">
  <default name="integrator" value="path"/>
  <integrator type="$integrator"><integer name="max_depth" value="3"/>%RADII%</integrator>
  <sensor type="perspective">
    <float name="fov" value="30"/>
    <transform name="to_world"><lookat origin="0, 0.5, 4" target="0, 0, 0" up="0, 1, 0"/></transform>
    <film type="hdrfilm"><string name="component_format" value="float32"/><rfilter type="box"/></film>
  </sensor>
  <shape type="rectangle">
    <transform name="to_world"><scale value="4"/><rotate x="1" angle="-90"/></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="0.5"/></bsdf>
  </shape>
  <shape type="rectangle">
    <transform name="to_world"><scale value="4"/><rotate x="1" angle="90"/><translate y="3"/></transform>
    <bsdf type="conductor"><string name="material" value="none"/></bsdf>
  </shape>
  <shape type="rectangle">
    <transform name="to_world"><scale value="0.5"/><rotate x="1" angle="-90"/><translate y="2"/></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf>
    <emitter type="area"><rgb name="radiance" value="10"/></emitter>
  </shape>
</scene>
)xml";

class FaultyProgram : public FaultyProgramTest {
 protected:
  std::string put_light_by_mirror(const std::string& radii = "") const {
    std::string text = light_by_mirror;
    text.replace(text.find("%RADII%"), 7, radii);
    put("mirror.xml", text);
    return path("mirror.xml");
  }
};

TEST_F(FaultyProgram, without_a_fault_gives_the_bits_of_the_sound_program) {
  for (const char* integrator : {"path", "photonmapper"}) {
    const std::vector<std::string> options{"--integrator", integrator, "--spp", "4"};
    const std::string scene = library + "cornell-spheres/scene.xml";
    const Image expected = render(sound, "", scene, options);
    EXPECT_GT(sum(expected), 0);
    EXPECT_TRUE(render(faulty, "", scene, options).rgb == expected.rgb) << integrator;
  }
}

TEST_F(FaultyProgram, dropped_cosine_lights_a_plane_as_if_it_faced_the_light) {
  // From the scene's comment: E_0 = 2 at an angle of cosine 2 / sqrt 6 on albedo 0.5, so L = 0.5 E_0 cosine / pi.
  const std::string scene = library + "light-directional/scene.xml";
  const double facing = 0.5 * 2 / std::numbers::pi, right = facing * 2 / std::sqrt(6.0);
  for (const char* integrator : {"path", "photonmapper"}) {
    const std::vector<std::string> options{"--integrator", integrator, "--spp", "2"};
    // The tolerance of 1e-5 is a hundred roundings, for some float operations.
    for (const float value : render(faulty, "", scene, options).rgb) EXPECT_NEAR(value, right, 1e-5 * right);
    for (const float value : render(faulty, "dropped-cosine", scene, options).rgb)
      EXPECT_NEAR(value, facing, 1e-5 * facing);
  }
}

TEST_F(FaultyProgram, missing_caustic_leaves_a_floor_black_that_a_mirror_lights) {
  const std::string scene = put_light_by_mirror();
  for (const char* integrator : {"path", "photonmapper"}) {
    const std::vector<std::string> options{"--integrator", integrator, "--spp", "16"};
    EXPECT_GT(sum(render(faulty, "", scene, options)), 0) << integrator;
    EXPECT_EQ(sum(render(faulty, "missing-caustic", scene, options)), 0) << integrator;
  }
}

TEST_F(FaultyProgram, missing_caustic_changes_no_bit_where_nothing_mirrors) {
  const std::vector<std::string> options{"--integrator", "path", "--spp", "8"};
  const std::string scene = library + "cornell/scene.xml";
  EXPECT_TRUE(render(faulty, "missing-caustic", scene, options).rgb == render(faulty, "", scene, options).rgb);
}

// The traced photons share the light's flux, so fewer photons give more noise at the same brightness. The image is that
// of half the count. It is bit-identical where the radii do not depend on the count and there is one pass.
TEST_F(FaultyProgram, half_photons_gives_the_image_of_half_the_photons) {
  const std::string scene =
      put_light_by_mirror(R"(<float name="global_radius" value="0.3"/><float name="caustic_radius" value="0.3"/>)");
  const auto mapped = [&](const std::string& fault, const std::string& photons) {
    return render(faulty, fault, scene, {"-D", "integrator=photonmapper", "--spp", "1", "--photons", photons});
  };
  const Image expected = mapped("", "20000");
  EXPECT_GT(sum(expected), 0);
  EXPECT_TRUE(mapped("half-photons", "40000").rgb == expected.rgb);
  EXPECT_FALSE(mapped("", "40000").rgb == expected.rgb);
}

TEST_F(FaultyProgram, unknown_fault_is_one_error_at_the_start) {
  const std::string scene = library + "cornell/scene.xml";
  std::string error = "PHOTONPROOF_FAULT: error: unknown fault 'dropped-cosin'; known: ";
  for (const GateVariant& variant : gate_variants())
    if (variant.planted == PlantedIn::renderer || variant.is_fault_of_harness())
      error += (error.back() == ' ' ? "" : ", ") + variant.name;
  error +=
      ", no-recentring, no-rescaling, float-faces, float-sphere, float-cylinder, lost-height, far-periods, "
      "fixed-step, unclamped-metal\n";
  // volpath does not have this fault, and alone would not notice the unknown name.
  for (const char* integrator : {"path", "volpath"}) {
    const ProcessOutcome outcome = run(faulty, "dropped-cosin", scene, {"--integrator", integrator, "--spp", "1"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.standard_error, error);
    EXPECT_FALSE(has("out.exr"));
  }
}

TEST_F(FaultyProgram, sound_program_has_no_faults) {
  const std::string scene = library + "light-directional/scene.xml";
  const std::vector<std::string> options{"--spp", "2"};
  const Image expected = render(sound, "", scene, options);
  for (const char* fault : {"dropped-cosine", "same-samples", "fov-axis", "dropped-cosin"})
    EXPECT_TRUE(render(sound, fault, scene, options).rgb == expected.rgb) << fault;
}

}  // namespace
}  // namespace photonproof::inline harness_gates
