#include "reference/store/provenance.h"

#include "reference/store/provenance_fields.h"
#include "scenes/base/json_text.h"
#include "scenes/base/percent_text.h"
#include "scenes/records/record_reader.h"
#include "scenes/records/record_writer.h"

namespace photonproof::inline reference_store {
namespace {

using Facts = std::map<std::string, std::string>;

}  // namespace

Facts facts(const Provenance& p) {
  const auto version = p.versions.find("photonproof");
  Facts told = {{"estimator", p.estimator},
                {"samples", std::to_string(p.samples)},
                {"batches", std::to_string(p.seeds.size())},
                {"standard_error", percent_text(p.standard_error)},
                {"scene_hash", p.scene_hash},
                {"pixels", p.pixels},
                {"date", p.date},
                {"host", p.host},
                {"version", version == p.versions.end() ? "unknown" : version->second}};
  if (p.bias > 0) told["bias"] = percent_text(p.bias);
  if (p.witness)
    told["witness"] = p.witness->estimator + ", " + std::to_string(p.witness->samples) + " samples: agrees" +
                      (p.witness->would_see ? "; would have seen " + percent_text(*p.witness->would_see) : "");
  for (const std::string& definition : p.definitions) {
    std::string& all = told["definitions"];
    all += (all.empty() ? "" : ", ") + definition;
  }
  return told;
}

std::string provenance_text(const Provenance& provenance) { return json_text(record_json(provenance)) + "\n"; }

Provenance parse_provenance(const std::string& text, const std::string& file) {
  RecordSource source{file};
  return read_record<Provenance>(parse_record(text, file), source);
}

}  // namespace photonproof::inline reference_store
