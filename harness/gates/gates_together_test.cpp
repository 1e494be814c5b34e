#include "harness/gates/gates_together.h"

#include <gtest/gtest.h>

namespace photonproof::inline harness_gates {
namespace {

class GatesTogether : public testing::Test {
 protected:
  GatesTogether() {
    suite_.engines = builtin_engines();
    suite_.engines.push_back({"mine", "mine", {"mine", "{scene}", "{output}"}, {}, {"spp"}});
  }
  void add(const std::string& scene, const std::string& engine, GateVerdict verdict,
           std::optional<Status> status = std::nullopt) {
    GateRecord record;
    record.scene = scene;
    record.engine = engine;
    record.verdict = verdict;
    record.status = status;
    gates_.push_back(record);
  }
  std::vector<std::string> said() const { return gates_together(gates_, suite_); }

  SuiteCommon suite_;
  std::vector<GateRecord> gates_;
};

using enum GateVerdict;
using Sentences = std::vector<std::string>;

TEST_F(GatesTogether, what_the_failing_engine_has_and_the_passing_one_has_not_is_named) {
  add("cornell", "path", fail);
  add("cornell", "photonmapper", pass);
  add("cornell", "photonmapper", pass);
  add("furnace", "photonmapper", fail);
  add("furnace", "path", pass);
  add("furnace", "path", pass);
  add("pool", "path", fail);
  add("pool", "bdpt", pass);
  EXPECT_EQ(said(),
            (Sentences{"cornell: path fails where photonmapper passes: look at weights of lights that bounces meet or "
                       "diffuse bounces",
                       "furnace: photonmapper fails where path passes: look at photon paths or densities of photons",
                       "pool: path fails where bdpt passes: look at direct light, weights of lights that bounces meet, "
                       "diffuse bounces or mirrors and glass"}));
}

TEST_F(GatesTogether, where_all_fail_it_is_what_they_share) {
  add("cornell", "path", fail);
  add("cornell", "photonmapper", fail);
  add("cornell", "photonmapper", pass);  // one of its gates is not enough
  EXPECT_EQ(said(),
            (Sentences{"cornell: path and photonmapper fail, and no engine passes: look at what they share: the "
                       "scene or its reference, camera, materials, lights and textures, direct light or mirrors "
                       "and glass"}));
}

TEST_F(GatesTogether, nothing_is_blamed_that_a_passing_engine_runs_too) {
  add("cornell", "path", fail);
  add("cornell", "bdpt", fail);
  add("cornell", "photonmapper", pass);
  add("furnace", "path", pass);
  suite_.engines.push_back(suite_.engine("path"));
  suite_.engines.back().name = "path-2";
  add("furnace", "path-2", fail);
  EXPECT_EQ(said(),
            (Sentences{"cornell: bdpt and path fail where photonmapper passes: the parts that they share run in the "
                       "others, too: more than one cause",
                       "furnace: path-2 fails where path passes: the others run all their parts; the bounds "
                       "may differ more than the engines do"}));
}

TEST_F(GatesTogether, programs_of_others_are_set_against_ours_without_guesses_about_their_insides) {
  add("cornell", "mine", fail);
  add("cornell", "path", pass);
  EXPECT_EQ(said(), Sentences{"cornell: mine fails where path passes: other gates pass with the same reference"});
}

TEST_F(GatesTogether, one_engine_alone_and_what_left_no_images_say_nothing) {
  add("cornell", "path", fail);
  add("furnace", "path", fail, Status::crash);
  add("furnace", "bdpt", pass);
  add("pool", "path", pass);
  add("pool", "bdpt", inconclusive);
  EXPECT_EQ(said(), Sentences{});
}

}  // namespace
}  // namespace photonproof::inline harness_gates
