// The program itself, as a CI job treats it: verdicts, exit codes, annotations, what it leaves behind.

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "harness/gates/test_gates.h"
#include "harness/metrics/metrics.h"
#include "reports/record/results.h"
#include "scenes/base/process.h"

namespace photonproof::inline harness_verbs {
namespace {

class GateVerb : public FakeGateTest {
 protected:
  ProcessOutcome run_gate(const std::string& gates, const std::vector<std::string>& more = {}) const {
    put("gates.toml", gates_text(gates));
    std::vector<std::string> argv{PHOTONPROOF_BINARY, "gate", folder_ / "gates.toml", "-o", folder_ / "out"};
    argv.insert(argv.end(), more.begin(), more.end());
    return run_process(argv, {.wall_limit_seconds = 60});
  }
  GateRecord only_gate() const {
    const Results results = read_results((folder_ / "out" / "results.json").string());
    EXPECT_EQ(results.gates.size(), 1u);
    return results.gates.at(0);
  }
  long images_drawn() const {
    const std::string log = has("log") ? get("log") : "";
    return std::count(log.begin(), log.end(), '\n');
  }
};

TEST_F(GateVerb, a_right_engine_passes_every_kind_of_gate_at_its_first_look) {
  put_reference();
  const ProcessOutcome outcome = run_gate(gate("good", "agreement", 0.05) + gate("good", "bias", 0.05) +
                                          gate("good", "block_bias", 0.1) + gate("good", "relmse", 0.01));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.standard_error << outcome.standard_output;
  EXPECT_EQ(outcome.standard_output.rfind("fake: 4 pass, 0 fail, 0 inconclusive\n", 0), 0u) << outcome.standard_output;
  EXPECT_TRUE(has("out/report.html"));
  EXPECT_EQ(images_drawn(), 8);  // shared by all four
}

// The engine "good" writes the whole film, "dim" the crop with its place. Judged with the black around it, the crop's
// relmse is a quarter of this.
TEST_F(GateVerb, relmse_of_a_scene_with_a_crop_is_that_of_the_crop_by_hand) {
  put_cropped_scene();
  put_reference();
  const Image reference =
      crop_of_scene(read_image(committed_reference_path(folder_ / "scene.xml", width, height))).mean;
  std::vector<Rendering> parts;
  for (int i = 0; i < prepared; ++i) {
    const std::string number = std::to_string(i) + ".exr";
    parts.push_back(crop_of_scene(read_image(folder_ / ("good-" + number))));
    write_exr(folder_ / ("dim-" + number), parts.back());
  }
  for (const char* engine : {"good", "dim"}) {
    put("log", "");
    EXPECT_EQ(run_gate(gate(engine, "relmse", 0.01), {"--fresh"}).exit_code, 0) << engine;
    std::istringstream log(get("log"));
    double sum = 0, images = 0;
    std::string name;
    for (std::size_t seed = 0; log >> name >> seed; ++images)
      sum += error_by_hand(reference, parts.at(seed % prepared).mean, 0.01);
    ASSERT_GT(images, 0);
    EXPECT_NEAR(only_gate().observed->value, sum / images, 1e-6 * sum / images) << engine;
  }
}

// Faults of the harness are planted by photonproof-faulty, which the program becomes.
TEST_F(GateVerb, self_test_plants_faults_in_itself) {
  put_reference();
  const ProcessOutcome outcome = run_gate(gate("good", "agreement", 0.05), {"--self-test", "--runs", "5", "--pool", "8",
                                                                            "--pool", "good=16", "--other-pool", "8"});
  const std::string& table = outcome.standard_output;
  EXPECT_EQ(table.rfind("# What the gates of `fake` find\n", 0), 0u) << table << outcome.standard_error;
  for (const char* part : {" --self-test --runs 5 --pool 8 --pool good=16 --other-pool 8 --seed 1\n",
                           "| **upside-down**: engines' images are read upside down | 100 | good/agreement: scene |\n",
                           "| scene/good/agreement | 16 | 0 |"})
    EXPECT_NE(table.find(part), std::string::npos) << part << "\n" << table;
  EXPECT_EQ(get("out/self-test/power.md"), table);
}

TEST_F(GateVerb, self_test_refuses_a_pool_that_is_none) {
  put_reference();
  const ProcessOutcome outcome = run_gate(gate("good", "agreement", 0.05), {"--self-test", "--pool", "good=1"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.standard_error.rfind("--pool: error: is 'good=1', expected a number of images from 2 to", 0), 0u)
      << outcome.standard_error;
}

TEST_F(GateVerb, a_dim_place_fails_and_is_named) {
  put_reference();
  const ProcessOutcome outcome = run_gate(gate("dim", "agreement", 0.05), {"--annotations"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.standard_error;
  const GateRecord record = only_gate();
  EXPECT_EQ(record.verdict, GateVerdict::fail);
  EXPECT_EQ(record.looks, 1);
  EXPECT_EQ(record.samples, 512u);  // 8 images of 64
  // Half of the light of 3 x 4 pixels is gone.
  EXPECT_EQ(record.sentence, "-50 % over 48 px at (6, 8); 8 images of spp=64");
  ASSERT_EQ(record.tiles.size(), 1u);
  EXPECT_EQ(record.tiles[0].x, 6);
  EXPECT_EQ(record.tiles[0].y, 8);
  EXPECT_TRUE(has("out/" + record.image));
  for (const auto& [role, picture] : record.pictures) EXPECT_TRUE(has("out/" + picture)) << role;
  EXPECT_NE(outcome.standard_output.find("gates.toml,title=gate scene/dim/agreement::-50 %25 over 48 px at (6, 8)"),
            std::string::npos)
      << outcome.standard_output;
}

TEST_F(GateVerb, each_kind_of_gate_can_fail) {
  put_reference();
  // 48 of 768 pixels lose half: some -3 % overall, -25 % of a block, and relmse 48/768 0.25 = 0.016.
  for (const auto& [metric, bound] :
       {std::pair{"bias", 0.005}, std::pair{"block_bias", 0.02}, std::pair{"relmse", 0.01}, std::pair{"psnr", 60.0}})
    EXPECT_EQ(run_gate(gate("dim", metric, bound)).exit_code, 1) << metric;
}

TEST_F(GateVerb, each_kind_of_gate_says_when_it_cannot_tell) {
  put_reference();
  // 64 images leave 0.02/sqrt(64 768) = 0.009 % overall; relmse of one image is near 4e-4, but not to 1e-7.
  for (const auto& [metric, bound] :
       {std::pair{"agreement", 0.00001}, std::pair{"bias", 0.00001}, std::pair{"block_bias", 0.00001}}) {
    const ProcessOutcome outcome = run_gate(gate("good", metric, bound));
    EXPECT_EQ(outcome.exit_code, 3) << metric << outcome.standard_error;
    EXPECT_EQ(only_gate().looks, 4);
    EXPECT_EQ(only_gate().sentence.rfind("too noisy to tell: ", 0), 0u) << only_gate().sentence;
  }
  double relmse = 0;
  run_gate(gate("good", "relmse", 1.0));
  relmse = only_gate().observed->value;
  put("near.toml",
      gates_text("[[gate]]\nscene = 'scene'\nengine = 'good'\nbudget = 'spp=64'\nmetric = 'relmse'\nlooks = 1"
                 "\nbound = " +
                 std::to_string(relmse) + "\n"));
  EXPECT_EQ(run_process({PHOTONPROOF_BINARY, "gate", folder_ / "near.toml", "-o", folder_ / "near"}).exit_code, 3);
}

TEST_F(GateVerb, hdr_flip_is_judged_at_the_exposures_that_the_scene_pins) {
  put_reference();
  put("expect.toml", get("expect.toml") + "hdr_flip_exposures = [-3, 0.5, 3]\n");
  const ProcessOutcome outcome = run_gate(gate("good", "hdr_flip", 0.9));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.standard_error << outcome.standard_output;
  const Results results = read_results((folder_ / "out" / "results.json").string());
  EXPECT_EQ(results.scenes.at(0).hdr_exposures, (ExposureRange{-3, 0.5, 3}));
  // Observed is the mean over the images drawn, each compared with the stored reference.
  const StoredReference reference = load_reference(folder_ / "scene.xml", width, height);
  std::istringstream log(get("log"));
  double sum = 0, images = 0;
  for (std::string engine, seed; log >> engine >> seed; ++images) {
    const std::string image = "good-" + std::to_string(std::stoul(seed) % prepared) + ".exr";
    sum += compute_metrics(reference.rendering.mean, read_image((folder_ / image).string()),
                           {.parameters = {.hdr_exposures = ExposureRange{-3, 0.5, 3}}, .only = {"hdr_flip"}})
               .at(0)
               .value;
  }
  EXPECT_EQ(images, 8);
  EXPECT_GT(sum, 0);
  EXPECT_NEAR(results.gates.at(0).observed->value, sum / images, 1e-12);
}

TEST_F(GateVerb, a_gate_with_an_exposure_of_its_own_has_its_flip_map_at_that_and_its_picture_at_the_scenes) {
  put_reference();
  const auto pictures = [&](const std::string& more) {
    run_gate(gate("dim", "flip", 0.9) + more);
    const GateRecord record = only_gate();
    return std::pair(get("out/" + record.pictures.at("image")), get("out/" + record.pictures.at("flip")));
  };
  const auto scene = pictures(""), own = pictures("exposure = -3\n");
  EXPECT_EQ(own.first, scene.first);
  EXPECT_NE(own.second, scene.second);
  EXPECT_EQ(only_gate().sentence.rfind("flip (exposure=-3) is ", 0), 0u) << only_gate().sentence;
}

TEST_F(GateVerb, crashes_and_bad_images_fail_with_their_reason) {
  put_reference();
  EXPECT_EQ(run_gate(gate("nan", "agreement", 0.05)).exit_code, 1);
  EXPECT_NE(only_gate().sentence.find("pixel (0, 0) of the test image is NaN"), std::string::npos)
      << only_gate().sentence;
  EXPECT_EQ(run_gate(gate("segfaults", "agreement", 0.05)).exit_code, 1);
  EXPECT_NE(only_gate().sentence.find("killed by SIGSEGV"), std::string::npos) << only_gate().sentence;
}

TEST_F(GateVerb, a_missing_reference_is_an_error_that_says_how_to_make_it) {
  const ProcessOutcome outcome = run_gate(gate("good", "agreement", 0.05));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.standard_error.find("photonproof reference "), std::string::npos) << outcome.standard_error;
  EXPECT_EQ(images_drawn(), 0);
}

TEST_F(GateVerb, the_same_seed_gives_the_same_verdict_and_another_seed_other_images) {
  put_reference();
  run_gate(gate("good", "agreement", 0.05));
  const GateRecord first = only_gate();
  run_gate(gate("good", "agreement", 0.05), {"--fresh"});
  EXPECT_EQ(only_gate().observed, first.observed);
  EXPECT_EQ(only_gate().sentence, first.sentence);
  EXPECT_EQ(images_drawn(), 16);  // nothing is taken from the first run
  put("log", "");
  run_gate(gate("good", "agreement", 0.05), {"--seed", "3"});
  EXPECT_NE(get("log").find("good 3000000\n"), std::string::npos) << get("log");  // a million apart
  EXPECT_EQ(get("log").find("good 1000000\n"), std::string::npos) << get("log");
}

TEST_F(GateVerb, resume_takes_the_images_that_are_there) {
  put_reference();
  run_gate(gate("good", "agreement", 0.05));
  EXPECT_EQ(images_drawn(), 8);
  EXPECT_EQ(run_gate(gate("good", "agreement", 0.05), {"--resume"}).exit_code, 0);
  EXPECT_EQ(images_drawn(), 8);
}

TEST_F(GateVerb, images_of_an_accepted_verdict_pass_at_once_and_say_so) {
  put_reference();
  const std::string gates = gate("good", "agreement", 0.05);
  run_gate(gates);
  const GateRecord decided = only_gate();
  EXPECT_EQ(decided.accepted, "");
  EXPECT_EQ(images_drawn(), 8);
  put("version", "fake 2\n");  // another build, the same images
  const ProcessOutcome outcome = run_gate(gates, {"--json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.standard_error;
  EXPECT_EQ(images_drawn(), 8 + 2);
  const GateRecord accepted = only_gate();
  EXPECT_EQ(accepted.verdict, GateVerdict::pass);
  EXPECT_EQ(accepted.observed, decided.observed);
  EXPECT_EQ(accepted.would_see, decided.would_see);
  EXPECT_EQ(accepted.sentence,
            decided.sentence + "; decided " + accepted.accepted + ", and the first 2 images are the same, bit for bit");
  EXPECT_TRUE(has("out/" + accepted.image));
  const auto json = nlohmann::json::parse(outcome.standard_output);
  EXPECT_EQ(json.at("accepted"), 1);
  EXPECT_EQ(json.at("gates").at(0).at("accepted"), accepted.accepted);
  EXPECT_NE(run_gate(gates).standard_output.find("1 of these passes were decided before, by the same images"),
            std::string::npos);
  EXPECT_EQ(only_gate().sentence, accepted.sentence);  // of the verdict itself, not of its repetition
}

TEST_F(GateVerb, what_differs_from_an_accepted_verdict_is_judged_anew) {
  put_reference();
  const std::string gates = gate("good", "agreement", 0.05);
  run_gate(gates);
  const auto images_of = [&](const std::string& changed, const std::vector<std::string>& more = {}) {
    const long before = images_drawn();
    run_gate(changed, more);
    EXPECT_EQ(only_gate().accepted, "");
    return images_drawn() - before;
  };
  EXPECT_EQ(images_of(gate("good", "agreement", 0.06)), 8);
  EXPECT_EQ(images_of(gate("good", "agreement", 0.05) + "alpha = 0.002\n"), 8);
  EXPECT_EQ(images_of(gate("good", "agreement", 0.05) + "seeds = 4\n"), 4);
  EXPECT_EQ(images_of(gate("good", "bias", 0.05)), 8);
  EXPECT_EQ(images_of(gates, {"--seed", "2"}), 8);
  put("expect.toml", "purpose = 'to be measured'\nexposure = 1.5\n");
  EXPECT_EQ(images_of(gates), 8);
  put("expect.toml", "purpose = 'to be measured'\nexposure = 0.5\n");
  run_gate(gate("good", "flip", 0.9));
  EXPECT_EQ(images_of(gate("good", "flip", 0.9) + "exposure = 2\n"), 8);
  // The last of the first two, by one bit of one value.
  Image second = read_image((folder_ / "good-1.exr").string());
  const Image kept = second;
  second.rgb[100] = std::nextafter(second.rgb[100], 1.0f);
  write_image("good-1.exr", second);
  EXPECT_EQ(images_of(gates), 8);
  write_image("good-1.exr", kept);
  // The same images of another reference.
  std::filesystem::remove(folder_ / "reference-32x24.exr");
  std::filesystem::remove(folder_ / "reference-32x24.json");
  put_reference(2e-4);
  EXPECT_EQ(images_of(gates), 8);
}

TEST_F(GateVerb, only_the_first_stream_of_an_engine_shows_again_that_seeds_count) {
  put_reference();
  const std::string first = gate("good", "agreement", 0.05), coarse = gate("good", "bias", 0.05, "spp=8");
  EXPECT_EQ(run_gate(first + coarse).exit_code, 0);
  EXPECT_EQ(images_drawn(), 8 + 8);
  run_gate(first + coarse);
  EXPECT_EQ(images_drawn(), 16 + 2 + 1);
  const auto results = read_results((folder_ / "out/results.json").string());
  EXPECT_TRUE(results.gates.at(0).sentence.ends_with("the first 2 images are the same, bit for bit"));
  EXPECT_TRUE(results.gates.at(1).sentence.ends_with("the first image is the same, bit for bit"));
  run_gate(first + coarse, {"--only", "bias"});  // alone it is the same verdict still
  EXPECT_EQ(images_drawn(), 19 + 1);
  EXPECT_NE(only_gate().accepted, "");
}

TEST_F(GateVerb, an_engine_that_no_longer_heeds_its_seed_is_not_taken_for_unchanged) {
  put_reference();
  const std::string gates = gate("good", "agreement", 0.05);
  EXPECT_EQ(run_gate(gates).exit_code, 0);
  const Image first = read_image((folder_ / "good-0.exr").string());
  for (int i = 1; i < prepared; ++i) write_image("good-" + std::to_string(i) + ".exr", first);
  EXPECT_EQ(run_gate(gates).exit_code, 1);
  EXPECT_NE(only_gate().sentence.find("All 8 images are identical. The command probably ignores {seed}"),
            std::string::npos)
      << only_gate().sentence;
}

TEST_F(GateVerb, only_passes_are_accepted) {
  put_reference();
  for (int run = 1; run <= 2; ++run) {
    EXPECT_EQ(run_gate(gate("dim", "agreement", 0.05)).exit_code, 1);
    EXPECT_EQ(images_drawn(), 8 * run);
  }
}

TEST_F(GateVerb, a_damaged_cache_is_judged_anew_and_one_that_cannot_be_written_is_noted) {
  put_reference();
  const std::string gates = gate("good", "agreement", 0.05);
  run_gate(gates);
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "cache" / "verdicts"))
    put(std::filesystem::relative(entry.path(), folder_).string(), "{\"suite\": ");
  EXPECT_EQ(run_gate(gates).exit_code, 0);
  EXPECT_EQ(images_drawn(), 16);
  EXPECT_EQ(run_gate(gates).exit_code, 0);
  EXPECT_EQ(images_drawn(), 18);  // the damaged one was replaced
  std::filesystem::remove_all(folder_ / "cache");
  put("cache", "a file where the folder would be");
  const ProcessOutcome outcome = run_gate(gates);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.standard_error;
  EXPECT_NE(outcome.standard_output.find("note: passes are not kept for the next run: "), std::string::npos)
      << outcome.standard_output;
}

TEST_F(GateVerb, json_has_every_verdict) {
  put_reference();
  const ProcessOutcome outcome =
      run_gate(gate("good", "agreement", 0.05) + gate("dim", "agreement", 0.05), {"--json", "--only", "dim"});
  const nlohmann::json json = nlohmann::json::parse(outcome.standard_output);
  EXPECT_EQ(json.at("fail"), 1);
  EXPECT_EQ(json.at("pass"), 0);
  EXPECT_EQ(json.at("gates").at(0).at("name"), "scene/dim/agreement");
}

TEST_F(GateVerb, says_regression_only_where_the_engine_made_its_own_reference) {
  // A sky of radiance 1 and nothing else: every engine's image is exactly 1.
  put("scene.xml", R"xml(<scene version="3.0.0">
  <sensor type="perspective"><film type="hdrfilm"><rfilter type="box"/></film></sensor>
  <emitter type="constant"><rgb name="radiance" value="1"/></emitter>
</scene>
)xml");
  Rendering sky{Image(width, height), Image(width, height), {}};
  std::fill(sky.mean.rgb.begin(), sky.mean.rgb.end(), 1.0f);
  const auto run_with_reference_by = [&](const std::string& estimator) {
    for (const char* extension : {".exr", ".json"})
      std::filesystem::remove(
          committed_reference_path(folder_ / "scene.xml", width, height).replace_extension(extension));
    Provenance provenance;
    provenance.scene_hash = scene_hash(parse_scene_file((folder_ / "scene.xml").string()));
    provenance.width = width;
    provenance.height = height;
    provenance.estimator = estimator;
    provenance.samples = 64;
    provenance.seeds = {1, 2, 3, 4};
    provenance.date = "2026-01-01T00:00:00Z";
    commit_reference(folder_ / "scene.xml", sky, provenance, "");
    return run_gate(gate("path", "agreement", 0.02), {"--json"});
  };
  const std::string words = "the reference is by path, whose sampling is the engine's";

  const ProcessOutcome own = run_with_reference_by("path");
  EXPECT_EQ(own.exit_code, 0) << own.standard_error;
  EXPECT_NE(own.standard_error.find("; regression only: " + words), std::string::npos) << own.standard_error;
  const auto own_gate = nlohmann::json::parse(own.standard_output).at("gates").at(0);
  EXPECT_EQ(own_gate.at("regression_only"), words);
  // Without noise what would be seen is a few times what counts as rounding, 1e-5 of the value.
  EXPECT_LT(own_gate.at("would_see"), 0.001);
  EXPECT_LT(own_gate.at("would_see_in_a_block"), 0.01);
  EXPECT_EQ(only_gate().regression_only, words);
  EXPECT_EQ(only_gate().would_see, own_gate.at("would_see").get<double>());
  for (const char* report : {"out/report.html", "out/junit.xml"})
    EXPECT_NE(get(report).find("regression only: the reference is by path"), std::string::npos) << report;
  EXPECT_NE(get("out/junit.xml").find("<property name=\"scene/path/agreement: would see\""), std::string::npos);

  const ProcessOutcome independent = run_with_reference_by("bdpt");
  EXPECT_EQ(independent.exit_code, 0) << independent.standard_error;
  EXPECT_EQ((independent.standard_error + independent.standard_output).find("regression only"), std::string::npos);
  EXPECT_EQ(only_gate().regression_only, "");
  for (const char* report : {"out/report.html", "out/junit.xml"})
    EXPECT_EQ(get(report).find("regression only"), std::string::npos) << report;
}

TEST_F(GateVerb, accepting_needs_a_reason_and_keeps_it_with_old_and_new) {
  put_reference();
  put("gates.toml", gates_text(gate("good", "agreement", 0.05)));
  const std::vector<std::string> accept{PHOTONPROOF_BINARY, "gate", folder_ / "gates.toml", "--accept",
                                        "scene/good/agreement"};
  const ProcessOutcome without = run_process(accept);
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_NE(without.standard_error.find("say why"), std::string::npos) << without.standard_error;

  std::vector<std::string> with = accept;
  with.insert(with.end(), {"--reason", "the light is a sphere now", "--standard-error", "0.05"});
  const ProcessOutcome outcome = run_process(with, {.wall_limit_seconds = 120});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.standard_error;
  const StoredReference now = load_reference(folder_ / "scene.xml", width, height);
  ASSERT_EQ(now.provenance.acceptances.size(), 1u);
  const Acceptance& acceptance = now.provenance.acceptances[0];
  EXPECT_EQ(acceptance.reason.rfind("the light is a sphere now (accepted by ", 0), 0u) << acceptance.reason;
  EXPECT_NE(acceptance.reason.find("relmse"), std::string::npos) << acceptance.reason;
  EXPECT_NE(acceptance.before, acceptance.after);
  ASSERT_TRUE(now.provenance.witness) << "a second estimator agrees, as --commit demands";
  EXPECT_NE(now.provenance.witness->estimator, now.provenance.estimator);
}

}  // namespace
}  // namespace photonproof::inline harness_verbs
