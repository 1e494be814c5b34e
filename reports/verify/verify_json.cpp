#include <cmath>
#include <concepts>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "reports/record/results_schema.h"
#include "reports/verify/verify_record.h"
#include "scenes/base/input_error.h"
#include "scenes/base/json_text.h"
#include "scenes/files/atomic_file.h"
#include "verify_schema_text.h"

namespace photonproof::inline reports_verify {
namespace {

using Json = nlohmann::ordered_json;

/// Members that writing and reading visit in one order, so that neither can forget one.
template <class Visit>
void members(VerifyEngineRecord& r, Visit&& v) {
  v("name", r.name), v("title", r.title), v("version", r.version), v("problem", r.problem);
}
template <class Visit>
void members(VerifyPicture& r, Visit&& v) {
  v("engine", r.engine), v("status", r.status), v("detail", r.detail), v("command", r.command);
  v("seconds", r.seconds), v("samples", r.samples), v("mean", r.mean);
  v("declared_whole", r.declared_whole), v("declared_block", r.declared_block);
  v("declared_reason", r.declared_reason), v("losses", r.losses), v("picture", r.picture);
}
template <class Visit>
void members(VerifyPair& r, Visit&& v) {
  v("first", r.first), v("second", r.second), v("verdict", r.verdict), v("sentence", r.sentence);
  v("shift", r.shift), v("whole_shift", r.whole_shift), v("would_see", r.would_see), v("relmse", r.relmse),
      v("ssim", r.ssim);
}
template <class Visit>
void members(VerifyFault& r, Visit&& v) {
  v("engine", r.engine), v("sentence", r.sentence), v("place", r.place), v("pass", r.pass);
  v("pass_words", r.pass_words), v("pass_sentence", r.pass_sentence);
  v("right_picture", r.right_picture), v("odd_picture", r.odd_picture), v("difference_picture", r.difference_picture);
}
template <class Visit>
void members(VerifyProbe& r, Visit&& v) {
  v("engine", r.engine), v("kind", r.kind), v("what", r.what), v("verdict", r.verdict), v("sentence", r.sentence);
  v("gain", r.gain), v("gain_error", r.gain_error), v("offset", r.offset);
}
template <class Visit>
void members(VerifyScene& r, Visit&& v) {
  v("name", r.name), v("path", r.path), v("purpose", r.purpose), v("width", r.width), v("height", r.height);
  v("exposure", r.exposure), v("seconds", r.seconds), v("verdict", r.verdict), v("sentence", r.sentence);
  v("believed", r.believed), v("pictures", r.pictures), v("pairs", r.pairs), v("faults", r.faults);
  v("notes", r.notes);
}
template <class Visit>
void members(VerifyRecord& r, Visit&& v) {
  v("created", r.created), v("program", r.program), v("host", r.host), v("command", r.command);
  v("power", r.power), v("seconds", r.seconds), v("interrupted", r.interrupted);
  v("engines", r.engines), v("probes", r.probes), v("scenes", r.scenes);
}

template <class Record>
Json json_of(Record record);

struct Writer {
  Json& to;
  template <class Value>
  void operator()(const char* name, const Value& value) const {
    to[name] = value;
  }
  void operator()(const char* name, const std::optional<double>& value) const {
    if (value && std::isfinite(*value)) to[name] = *value;  // what is undefined is absent
  }
  template <class Record>
  requires std::is_class_v<Record> &&(!std::same_as<Record, std::string>)void operator()(
      const char* name, const std::vector<Record>& list) const {
    to[name] = Json::array();
    for (const Record& record : list) to[name].push_back(json_of(record));
  }
};

template <class Record>
Json json_of(Record record) {
  Json json = Json::object();
  members(record, Writer{json});
  return json;
}

struct Reader {
  const Json& from;
  template <class Value>
  void operator()(const char* name, Value& value) const {
    from.at(name).get_to(value);
  }
  void operator()(const char* name, std::optional<double>& value) const {
    if (from.contains(name)) value = from.at(name).get<double>();
  }
  template <class Record>
  requires std::is_class_v<Record> &&(!std::same_as<Record, std::string>)void operator()(
      const char* name, std::vector<Record>& list) const {
    for (const Json& entry : from.at(name)) members(list.emplace_back(), Reader{entry});
  }
};

void validate(const Json& json, const std::string& file) {
  validate_document(verify_schema_text, nlohmann::json(json), file, "of verify");
}

}  // namespace

std::string verify_record_text(const VerifyRecord& record) {
  Json json = {{"schema_version", 1}};
  json.update(json_of(record));
  return json_text(json) + "\n";
}

std::string verify_probe_text(const VerifyProbe& probe) { return json_text(json_of(probe)) + "\n"; }

std::optional<VerifyProbe> verify_probe_from(const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) return std::nullopt;
  try {
    VerifyProbe probe;
    members(probe, Reader{json});
    return probe;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

VerifyRecord read_verify_record(const std::filesystem::path& file) {
  const Json json = Json::parse(read_file(file), nullptr, false);
  if (json.is_discarded()) throw InputError(file.string(), "is not JSON");
  validate(json, file.string());
  VerifyRecord record;
  members(record, Reader{json});
  return record;
}

void write_verify_record(const VerifyRecord& record, const std::filesystem::path& file) {
  const std::string text = verify_record_text(record);
  validate(Json::parse(text), file.string());
  write_file_atomically(file, text);
}

}  // namespace photonproof::inline reports_verify
