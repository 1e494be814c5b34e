#include "reference/store/provenance.h"

#include <gtest/gtest.h>

#include "reference/store/provenance_fields.h"
#include "scenes/files/test_folder.h"
#include "scenes/records/test_record.h"

namespace photonproof::inline reference_store {
namespace {

Provenance sample() {
  Provenance p;
  p.scene_hash = "0123456789abcdef";
  p.width = 64;
  p.height = 48;
  p.estimator = "bdpt";
  p.samples = 32 * 128;
  p.seeds = {7, 18446744073709551615u};  // 2^64 - 1: no double holds it
  p.standard_error = 0.1 + 0.2;          // needs 17 digits
  p.pixels = "fedcba9876543210";
  p.versions = {{"photonproof", "photonproof 0.1.0 (abc)"}, {"embree", "3.13.5"}};
  p.host = "A \"CPU\", 2 cores";
  p.date = "2026-01-31T12:00:00Z";
  p.acceptances = {{"2026-02-01T00:00:00Z", "the light moved", {{"pixels", "1"}}, {{"pixels", "2"}}}};
  return p;
}

TEST(Provenance, comes_back_as_it_was_written) {
  EXPECT_EQ(parse_provenance(provenance_text(sample()), "p.json"), sample());
}

TEST(Provenance, has_the_definitions_of_a_scene_that_was_given_some) {
  EXPECT_EQ(provenance_text(sample()).find("definitions"), std::string::npos);
  EXPECT_EQ(facts(sample()).count("definitions"), 0u);
  Provenance p = sample();
  p.definitions = {"albedo=0.5", "size=3"};
  EXPECT_EQ(parse_provenance(provenance_text(p), "p.json"), p);
  EXPECT_EQ(facts(p).at("definitions"), "albedo=0.5, size=3");
}

TEST(Provenance, has_the_bias_of_an_estimator_that_has_some) {
  EXPECT_EQ(provenance_text(sample()).find("bias"), std::string::npos);
  EXPECT_EQ(facts(sample()).count("bias"), 0u);
  Provenance p = sample();
  p.bias = 0.0025;
  EXPECT_EQ(parse_provenance(provenance_text(p), "p.json"), p);
  EXPECT_EQ(facts(p).at("bias"), "0.25 %");
}

TEST(Provenance, has_the_witness_that_agrees_and_what_it_would_have_seen) {
  EXPECT_EQ(provenance_text(sample()).find("witness"), std::string::npos);
  EXPECT_EQ(facts(sample()).count("witness"), 0u);
  Provenance p = sample();
  p.witness = {"path", 8192, 0.02, 0.0125};
  EXPECT_EQ(parse_provenance(provenance_text(p), "p.json"), p);
  EXPECT_EQ(facts(p).at("witness"), "path, 8192 samples: agrees; would have seen 1.2 %");
  p.witness->would_see.reset();
  EXPECT_EQ(parse_provenance(provenance_text(p), "p.json"), p);
  EXPECT_EQ(facts(p).at("witness"), "path, 8192 samples: agrees");
}

TEST(Provenance, is_told_in_words) {
  // 0.3 is 30 %; two seeds are two batches.
  const auto told = facts(sample());
  EXPECT_EQ(told.at("standard_error"), "30 %");
  EXPECT_EQ(told.at("batches"), "2");
  EXPECT_EQ(told.at("version"), "photonproof 0.1.0 (abc)");
}

TEST(Provenance, has_the_schema_that_is_printed) {
  expect_schema_in<Provenance>("reference/store/provenance.schema.json");
  Provenance p = sample();
  p.seeds = {7, 8};  // the other library takes those above 2^63 for negative ones
  p.witness = ReferenceWitness{"path", 64, 0.01, 0.002};
  expect_reader_agrees_with_schema(p);
}

TEST(Provenance, text_that_is_none_is_refused_by_name) {
  const auto error_with = [](const std::string& from, const std::string& to) {
    std::string text = provenance_text(sample());
    if (const auto at = text.find(from); at != std::string::npos) text.replace(at, from.size(), to);
    return input_error_of([&] { parse_provenance(text, "p.json"); });
  };
  EXPECT_EQ(error_with("{", ""), "p.json:2:11: error: not valid JSON");
  EXPECT_EQ(error_with("\"samples\": 4096,", ""), "p.json: error: has no 'samples'");
  EXPECT_EQ(error_with("4096", "-1"), "p.json#/samples: error: is -1, expected a whole number of at least 0");
  EXPECT_EQ(error_with("4096", "\"many\""),
            "p.json#/samples: error: is \"many\", expected a whole number of at least 0");
  EXPECT_EQ(error_with("\"bdpt\"", "3"), "p.json#/estimator: error: is 3, expected a string");
  EXPECT_EQ(error_with("\"width\"", "\"note\": 1, \"width\""), "p.json: error: has 'note', which is not known");
  EXPECT_EQ(error_with("\"format\": 1", "\"format\": 2"), "p.json: error: has format 2; this program reads 1");
  EXPECT_EQ(error_with("\"reason\": \"the light moved\",", ""), "p.json#/history/0: error: has no 'reason'");
  EXPECT_EQ(input_error_of([] { parse_provenance("[]", "p.json"); }), "p.json: error: is [], expected an object");
}

}  // namespace
}  // namespace photonproof::inline reference_store
