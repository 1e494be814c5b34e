// Ten mistakes, each planted in one of several engines: verify must name that engine and the pass of light with the
// mistake.

#include <gtest/gtest.h>

#include "harness/verify/test_verify_folder.h"

namespace photonproof::inline harness_verify {
namespace {

class PlantedFaults : public VerifyTest {
 protected:
  const std::string sound = PHOTONPROOF_BINARY;

  /// An engine "odd": the integrator with a mistake that test_planted_engine.cpp makes.
  std::string odd_row(const std::string& fault, const std::string& integrator) const {
    return row("odd", render_command("'" PLANTED_ENGINE "', '" + fault + "', '" + sound + "'", integrator));
  }

  void expect_blamed(const std::string& rows, const std::vector<std::string>& others, const std::string& pass,
                     const std::string& message = "", const std::string& power = "0.02") const {
    put("rows.toml", rows);
    std::vector<std::string> options{"--engines", path("rows.toml"), "--engine", "odd", "--power", power};
    for (const std::string& other : others) options.insert(options.end(), {"--engine", other});
    const ProcessOutcome outcome = verify(options);
    ASSERT_EQ(outcome.exit_code, 1) << outcome.standard_output << outcome.standard_error;
    const VerifyScene scene = verified();
    EXPECT_EQ(scene.verdict, "differ") << outcome.standard_output;
    ASSERT_EQ(scene.faults.size(), 1u) << outcome.standard_output;
    EXPECT_EQ(scene.faults[0].engine, "odd");
    EXPECT_EQ(scene.faults[0].pass, pass) << outcome.standard_output << scene.faults[0].pass_words;
    EXPECT_EQ(scene.believed, others) << outcome.standard_output;
    EXPECT_NE(scene.sentence.find(message), std::string::npos) << scene.sentence;
  }
};

TEST_F(PlantedFaults, povray_with_lights_that_are_2_percent_brighter) {
  put_scene(walls(diffuse("0.5")) + point_light());
  put("expect.toml",
      "purpose = 'test'\nexposure = 0\n[[tolerance]]\nengine = 'odd'\nmetric = 'bias'\nvalue = 0.005\n"
      "reason = 'test'\n");
  const std::string command = "'" PLANTED_ENGINE "', 'brighter-light', '" + sound +
                              "', 'povray', '{scene}', '-o', '{output}', '--stats', '{stats}', '--size', "
                              "'{width}x{height}', '--seed', '{seed}', "
                              "'--allow-outside', '{budget}'";
  expect_blamed(row("odd", command, "biased", "quality"), {"path", "bdpt"}, "direct", "+2 % over the whole image");
}

TEST_F(PlantedFaults, diffuse_surfaces_without_the_cosine) {
  put_scene(walls(diffuse("0.5")) + light());
  const std::string before = "'env', 'PHOTONPROOF_FAULT=dropped-cosine', '" + sound + "-faulty'";
  expect_blamed(row("odd", render_command(before, "path") + ", '--isa', 'v2'"), {"bdpt", "volpath"}, "direct");
}

// A 32nd of the albedos leaves a trace of the missing light in the pass before, in a few blocks.
TEST_F(PlantedFaults, light_after_two_reflections_that_is_left_out) {
  put_scene(walls(diffuse("0.9")) + light());
  expect_blamed(row("odd", render_command("'" + sound + "'", "direct")), {"path", "volpath"}, "indirect");
}

TEST_F(PlantedFaults, caustic_map_at_half_its_power) {
  put_scene(walls(diffuse("0.5")) + light() + glass_ball());
  const std::string command = render_command("'" PLANTED_ENGINE "', 'half-caustic', '" + sound + "'", "photonmapper");
  expect_blamed(row("odd", command, "biased"), {"path", "bdpt"}, "caustic");
}

TEST_F(PlantedFaults, normal_that_is_flipped) {
  put_scene(walls(diffuse("0.5")) + light());
  expect_blamed(odd_row("flipped-normal", "path"), {"bdpt", "volpath"}, "shapes");
}

TEST_F(PlantedFaults, camera_that_is_shifted_by_half_a_pixel) {
  put_scene(walls(diffuse("0.5")) + light() +
            rectangle(R"(<scale value="0.3"/><translate x="0.5" y="-0.5" z="0.1"/>)", diffuse("0.05")));
  expect_blamed(odd_row("shifted-camera", "path"), {"bdpt", "volpath"}, "camera");
}

TEST_F(PlantedFaults, gamma_where_values_are_linear) {
  put_scene(walls(diffuse("0.5")) + light());
  expect_blamed(odd_row("gamma", "path"), {"bdpt", "volpath"}, "tone");
}

// Nothing is diffuse, so the only noise of glass is that of its two light paths.
TEST_F(PlantedFaults, index_of_refraction_of_1_52_in_place_of_1_5) {
  const std::string bars = rectangle(R"(<scale x="0.08" y="2"/><translate x="-0.5" z="0.1"/>)", glow("2,3,4")) +
                           rectangle(R"(<scale x="0.08" y="2"/><translate x="0.3" z="0.1"/>)", glow("3,1,1"));
  put_scene(rectangle(R"(<scale value="2"/>)", glow("0.2,0.4,0.3")) + bars + glass_ball());
  expect_blamed(odd_row("ior", "path"), {"bdpt", "volpath"}, "glass", "glass sphere", "0.015");
}

TEST_F(PlantedFaults, roughness_that_is_squared_twice) {
  put_scene(walls(R"(<bsdf type="roughconductor"><string name="material" value="none"/>
    <float name="alpha" value="0.4"/></bsdf>)") +
            light());
  expect_blamed(odd_row("alpha", "path"), {"bdpt", "volpath"}, "mirror", "", "0.05");
}

// Two engines of ours share materials and thus a mistake in one. Cycles has microfacets of its own.
TEST_F(PlantedFaults, roughness_that_is_squared_twice_by_a_witness_that_shares_no_code) {
  if (!run_process({"blender", "--version"}).ok())
    GTEST_SKIP() << "Blender is not installed: ./run --with-cycles installs it";
  put_scene(walls(R"(<bsdf type="roughconductor"><string name="material" value="none"/>
    <float name="alpha" value="0.4"/></bsdf>)") +
            light());
  expect_blamed(odd_row("alpha", "path"), {"bdpt", "cycles"}, "mirror", "", "0.05");
}

TEST_F(PlantedFaults, texture_that_is_mirrored) {
  put_scene(walls(R"(<bsdf type="diffuse"><texture name="reflectance" type="checkerboard">
    <rgb name="color0" value="0.8,0.5,0.1"/><rgb name="color1" value="0.1,0.2,0.3"/></texture></bsdf>)") +
            light());
  expect_blamed(odd_row("mirrored-texture", "path"), {"bdpt", "volpath"}, "texture");
}

TEST_F(PlantedFaults, absorption_per_half_a_unit) {
  put_scene(R"(<medium type="homogeneous" id="ink"><rgb name="sigma_t" value="0.5,1,2"/><rgb name="albedo" value="0"/>
    </medium><shape type="cube"><transform name="to_world"><scale x="1" y="1" z="0.3"/><translate z="1"/></transform>
    <bsdf type="null"/><ref name="interior" id="ink"/></shape>)" +
            walls(diffuse("0")) + rectangle(R"(<scale value="1.5"/><translate z="0.2"/>)", glow("1")));
  expect_blamed(odd_row("half-absorption", "volpath"), {"bdpt", "volpath"}, "medium");
}

}  // namespace
}  // namespace photonproof::inline harness_verify
