#include "reference/store/provenance.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "scenes/base/input_error.h"
#include "scenes/base/json_text.h"
#include "scenes/base/percent_text.h"

namespace photonproof::inline reference_store {
namespace {

using nlohmann::ordered_json;

constexpr int format_version = 1;

/// An object whose every key is asked for; throws InputError about the rest.
class Reader {
 public:
  Reader(const ordered_json& object, const std::string& file, std::string where)
      : object_(object), file_(file), where_(std::move(where)) {
    if (!object.is_object()) fail("is not an object");
  }
  template <class T>
  T get(const char* key) {
    ++used_;
    const auto found = object_.find(key);
    if (found == object_.end()) fail(std::string("has no '") + key + "'");
    check_kind<T>(*found, key);
    try {
      return found->template get<T>();
    } catch (const ordered_json::exception&) {
      fail(std::string("'") + key + "' is of another type than it should be");
    }
  }
  bool has(const char* key) const { return object_.contains(key); }
  const ordered_json& list(const char* key) {
    ++used_;
    const auto found = object_.find(key);
    if (found == object_.end() || !found->is_array()) fail(std::string("has no list '") + key + "'");
    return *found;
  }
  void check_no_other_keys() const {
    if (object_.size() != used_) fail("has keys that are not known");
  }
  [[noreturn]] void fail(const std::string& what) const { throw InputError(file_, where_ + " " + what); }

 private:
  // The library would turn -1 into a large count and 1.5 into 1.
  template <class T>
  void check_kind(const ordered_json& value, const char* key) const {
    if constexpr (std::is_integral_v<T>)
      if (!value.is_number_unsigned()) fail(std::string("'") + key + "' is no whole number from 0 on");
    if constexpr (std::is_same_v<T, std::vector<std::uint64_t>>)
      if (!value.is_array() ||
          !std::all_of(value.begin(), value.end(), [](const auto& v) { return v.is_number_unsigned(); }))
        fail(std::string("'") + key + "' is no list of whole numbers from 0 on");
  }

  const ordered_json& object_;
  const std::string& file_;
  std::string where_;
  std::size_t used_ = 0;
};

using Facts = std::map<std::string, std::string>;

ReferenceWitness read_witness(Reader& provenance, const std::string& file) {
  const ordered_json json = provenance.get<ordered_json>("witness");
  Reader reader(json, file, "the provenance's witness");
  ReferenceWitness witness;
  witness.estimator = reader.get<std::string>("estimator");
  witness.samples = reader.get<std::uint64_t>("samples");
  witness.standard_error = reader.get<double>("standard_error");
  if (reader.has("would_see")) witness.would_see = reader.get<double>("would_see");
  reader.check_no_other_keys();
  return witness;
}

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

std::string provenance_text(const Provenance& p) {
  ordered_json history = ordered_json::array();
  for (const Acceptance& a : p.history)
    history.push_back({{"date", a.date}, {"reason", a.reason}, {"before", a.before}, {"after", a.after}});
  ordered_json json = {{"format", format_version},
                       {"scene_hash", p.scene_hash},
                       {"width", p.width},
                       {"height", p.height},
                       {"estimator", p.estimator},
                       {"samples", p.samples},
                       {"standard_error", p.standard_error},
                       {"date", p.date},
                       {"host", p.host},
                       {"versions", p.versions},
                       {"pixels", p.pixels},
                       {"history", history},
                       {"seeds", p.seeds}};
  if (p.bias > 0) json["bias"] = p.bias;
  if (p.witness) {
    json["witness"] = {{"estimator", p.witness->estimator},
                       {"samples", p.witness->samples},
                       {"standard_error", p.witness->standard_error}};
    if (p.witness->would_see) json["witness"]["would_see"] = *p.witness->would_see;
  }
  if (!p.definitions.empty()) json["definitions"] = p.definitions;
  return json_text(json) + "\n";
}

Provenance parse_provenance(const std::string& text, const std::string& file) {
  const ordered_json json = ordered_json::parse(text, nullptr, false);
  if (json.is_discarded()) throw InputError(file, "the provenance is not JSON");
  Reader reader(json, file, "the provenance");
  if (reader.get<int>("format") != format_version) reader.fail("is of another format than this program writes");
  Provenance p;
  p.scene_hash = reader.get<std::string>("scene_hash");
  p.width = reader.get<int>("width");
  p.height = reader.get<int>("height");
  p.estimator = reader.get<std::string>("estimator");
  p.samples = reader.get<std::uint64_t>("samples");
  p.standard_error = reader.get<double>("standard_error");
  p.date = reader.get<std::string>("date");
  p.host = reader.get<std::string>("host");
  p.versions = reader.get<Facts>("versions");
  p.pixels = reader.get<std::string>("pixels");
  p.seeds = reader.get<std::vector<std::uint64_t>>("seeds");
  if (reader.has("bias")) p.bias = reader.get<double>("bias");
  if (reader.has("witness")) p.witness = read_witness(reader, file);
  if (reader.has("definitions")) p.definitions = reader.get<std::vector<std::string>>("definitions");
  for (const ordered_json& entry : reader.list("history")) {
    Reader acceptance(entry, file, "an entry of the provenance's history");
    p.history.push_back({acceptance.get<std::string>("date"), acceptance.get<std::string>("reason"),
                         acceptance.get<Facts>("before"), acceptance.get<Facts>("after")});
    acceptance.check_no_other_keys();
  }
  reader.check_no_other_keys();
  return p;
}

}  // namespace photonproof::inline reference_store
