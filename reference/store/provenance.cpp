#include "reference/store/provenance.h"

#include <algorithm>

#include "reference/store/provenance_fields.h"
#include "scenes/base/json_text.h"
#include "scenes/base/percent_text.h"
#include "scenes/records/record_reader.h"
#include "scenes/records/record_writer.h"

namespace photonproof::inline reference_store {
namespace {

using Facts = std::map<std::string, std::string>;

}  // namespace

double freedom_of(const Provenance& provenance) {
  constexpr std::size_t least_batches = 2, stated_batches = 32;
  std::size_t batches = provenance.seeds.size();
  if (provenance.given)
    batches = provenance.given->noise == noise_of_images ? static_cast<std::size_t>(provenance.given->images)
                                                         : stated_batches;
  return static_cast<double>(std::max(least_batches, batches) - 1);
}

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
  if (p.given) {
    told["images"] = std::to_string(p.given->images) + ", noise " + p.given->noise;
    for (const std::string& file : p.given->files) {
      std::string& all = told["files"];
      all += (all.empty() ? "" : ", ") + file;
    }
  }
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
