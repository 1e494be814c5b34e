// Tests which references can prove an engine wrong.
#include "harness/gates/independence.h"

#include <gtest/gtest.h>

#include "harness/gates/gate_suite.h"
#include "harness/suites/suite_rows.h"

namespace photonproof::inline harness_gates {
namespace {

/// Every pixel `value`, with a standard error of one in a hundred: the mean over 64 pixels is known to 0.125 %.
StoredReference grey(const std::string& estimator, float value) {
  StoredReference reference;
  reference.rendering = {Image(8, 8), Image(8, 8), {}};
  for (float& v : reference.rendering.mean.rgb) v = value;
  for (float& v : reference.rendering.variance->rgb) v = 1e-4f * value * value;
  reference.provenance.estimator = estimator;
  return reference;
}

std::string words(const std::string& engine, const StoredReference& reference, const std::optional<Expect>& expect) {
  const std::vector<Engine> engines = builtin_engines();
  return regression_only(*find_named(engines, engine), reference, expect);
}

TEST(independence, is_of_sampling_code) {
  for (const char* engine : {"path", "photonmapper"}) {
    EXPECT_EQ(words(engine, grey("path", 1), {}), "the reference is by path, whose sampling is the engine's");
    for (const char* other : {"bdpt", "ptracer", "volpath"}) EXPECT_EQ(words(engine, grey(other, 1), {}), "") << other;
  }
  EXPECT_EQ(words("bdpt", grey("bdpt", 1), {}), "the reference is by bdpt, whose sampling is the engine's");
  EXPECT_EQ(words("bdpt", grey("ptracer", 1), {}), "");
  EXPECT_EQ(words("povray", grey("path", 1), {}), "");  // another program
}

TEST(independence, is_given_by_a_closed_form_that_the_reference_keeps) {
  Expect expect;
  expect.analytic = Analytic{"L = 1", RgbD(1)};
  EXPECT_EQ(words("path", grey("path", 1.004f), expect), "");  // 3.2 standard errors
  EXPECT_NE(words("path", grey("path", 1.006f), expect), "");  // 4.8
  EXPECT_NE(words("path", grey("path", 0.994f), expect), "");
  expect.analytic->mean.reset();
  EXPECT_NE(words("path", grey("path", 1), expect), "");
  // The closed form holds for the unchanged scene.
  expect.analytic->mean = RgbD(1);
  StoredReference defined = grey("path", 1);
  defined.provenance.definitions = {"albedo=0.3"};
  EXPECT_NE(words("path", defined, expect), "");
}

TEST(independence, is_what_the_gates_of_this_program_have) {
  for (const char* file : {"gates.toml", "gates-features.toml"}) {
    const GateSuite suite = read_gate_suite(PHOTONPROOF_SOURCE_DIR "/harness/suites/" + std::string(file));
    for (const Gate& gate : suite.gates) {
      if (gate.engine == "volpath") continue;  // no other engine renders media that scatter: its gates state that
      const SuiteScene& scene = suite.scene(gate.scene);
      const StoredReference reference = load_reference(scene.path, scene.width, scene.height);
      const Expect expect = read_expect(expect_path_of(scene.path.string()));
      EXPECT_EQ(regression_only(suite.engine(gate.engine), reference, expect), "") << gate.name;
    }
  }
}

}  // namespace
}  // namespace photonproof::inline harness_gates
