// A gate suite whose engines are a shell script that copies prepared images, and a stored reference for them.
#pragma once

#include <cmath>
#include <cstdlib>
#include <random>

#include "harness/suites/test_suite.h"
#include "reference/store/reference_store.h"
#include "scenes/description/scene_hash.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline harness_gates {

class FakeGateTest : public FakeSuiteTest {
 protected:
  static constexpr int prepared = 64;  ///< images: seed n is image n modulo 64

  void SetUp() override {
    FakeSuiteTest::SetUp();
    // The tests need their own cache of accepted verdicts, not the user's.
    setenv("PHOTONPROOF_CACHE", (folder_ / "cache").c_str(), 1);
    put("gate.sh", gate_script);
    std::mt19937_64 random(1);
    for (int i = 0; i < prepared; ++i) {
      const std::string number = std::to_string(i) + ".exr";
      const Image good = noisy(random);
      Image dim = good;
      for (int y = 8; y < 16; ++y)
        for (int x = 6; x < 12; ++x)
          for (int c = 0; c < 3; ++c) dim.pixel(x, y)[c] *= 0.5f;
      write_image("good-" + number, good);
      write_image("dim-" + number, dim);
    }
  }

  void write_image(const std::string& name, const Image& image) const {
    Rendering rendering;
    rendering.mean = image;
    write_exr((folder_ / name).string(), rendering);
  }

  static double expected(int x, int y, int c) { return (x < 7 ? 0.2 : 0.6) + 0.02 * y + 0.1 * c; }

  /// An image with a normal noise of 2 % a value.
  static Image noisy(std::mt19937_64& random) {
    Image image(width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (int c = 0; c < 3; ++c)
          image.pixel(x, y)[c] =
              static_cast<float>(expected(x, y, c) * (1 + 0.02 * std::normal_distribution<double>()(random)));
    return image;
  }

  /// The exact expectation. Its standard error is 1e-4 of each value, as from a large number of samples.
  void put_reference(double standard_error = 1e-4) const {
    Rendering exact{Image(width, height), Image(width, height), {}};
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (int c = 0; c < 3; ++c) {
          exact.mean.pixel(x, y)[c] = static_cast<float>(expected(x, y, c));
          exact.variance->pixel(x, y)[c] = static_cast<float>(std::pow(standard_error * expected(x, y, c), 2));
        }
    Provenance provenance;
    provenance.scene_hash = scene_hash(parse_scene_file((folder_ / "scene.xml").string()));
    provenance.width = width;
    provenance.height = height;
    provenance.estimator = "path";
    provenance.samples = 1 << 20;
    provenance.seeds = {1, 2, 3, 4, 5, 6, 7, 8};
    provenance.date = "2026-01-01T00:00:00Z";
    commit_reference(folder_ / "scene.xml", exact, provenance, "");
  }

  static std::string gate(const std::string& engine, const std::string& metric, double bound,
                          const std::string& budget = "spp=64") {
    return "[[gate]]\nscene = 'scene'\nengine = '" + engine + "'\nbudget = '" + budget + "'\nmetric = '" + metric +
           "'\nbound = " + std::to_string(bound) + "\n";
  }

  std::string gates_text(const std::string& gates, int seconds = 20) const {
    std::string text = "name = 'fake'\ntitle = 'Fake'\n[limits]\nseconds = " + std::to_string(seconds) +
                       "\n[[scene]]\nname = 'scene'\n"
                       "path = 'scene.xml'\nwidth = " +
                       std::to_string(width) + "\nheight = " + std::to_string(height) + "\n";
    for (const char* engine : {"good", "dim", "nan", "segfaults", "sleeps", "slow-at-one"})
      text += "[[engine]]\nname = '" + std::string(engine) +
              "'\ntitle = 'fake'\ncommand = ['sh', '{suite}/gate.sh', '" + engine +
              "', '{suite}', '{output}', '{seed}', '{scene}']\nversions = [['cat', '{suite}/version']]\n"
              "budgets = ['spp']\ntrust = 'unbiased'\n";
    put("version", "fake 1\n");
    return text + gates;
  }

  static constexpr const char* gate_script = R"script(
echo "$1 $4" >> "$2/log"
case $1 in
  good|dim) cp "$2/$1-$(($4 % 64)).exr" "$3" ;;
  nan) cp "$2/nan.exr" "$3" ;;
  segfaults) kill -SEGV $$ ;;
  slow-at-one) [ "$4" = 1 ] && sleep 60; cp "$2/good-$(($4 % 64)).exr" "$3" ;;
  sleeps) echo $$ > "$2/pid"; sleep 0.5; cp "$2/good-0.exr" "$3" ;;
esac
)script";
};

}  // namespace photonproof::inline harness_gates
