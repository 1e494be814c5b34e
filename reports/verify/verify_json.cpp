#include "reports/verify/verify_fields.h"
#include "scenes/base/json_text.h"
#include "scenes/files/atomic_file.h"
#include "scenes/records/record_reader.h"
#include "scenes/records/record_writer.h"

namespace photonproof::inline reports_verify {
namespace {

VerifyRecord verify_record_of(const RecordJson& json, const std::filesystem::path& file) {
  RecordSource source{file.string()};
  return read_record<VerifyRecord>(json, source);
}

}  // namespace

std::string verify_record_text(const VerifyRecord& record) { return json_text(record_json(record)) + "\n"; }

std::string verify_probe_text(const VerifyProbe& probe) { return json_text(record_json(probe)) + "\n"; }

std::optional<VerifyProbe> verify_probe_from(const std::string& text) try {
  RecordSource source{"probe"};
  return read_record<VerifyProbe>(parse_record(text, source.file), source);
} catch (const InputError&) {
  return std::nullopt;
}

VerifyRecord read_verify_record(const std::filesystem::path& file) {
  return verify_record_of(parse_record(read_file(file), file.string()), file);
}

void write_verify_record(const VerifyRecord& record, const std::filesystem::path& file) {
  const RecordJson json = record_json(record);
  verify_record_of(json, file);
  write_file_atomically(file, json_text(json) + "\n");
}

}  // namespace photonproof::inline reports_verify
