// The one place that includes valijson: it costs more than ten seconds of compile time.

#include "reports/record/results_schema.h"

#include <memory>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "reports/record/results.h"
#include "results_schema_text.h"
#include "scenes/base/input_error.h"

namespace photonproof::inline reports_record {
namespace {

using nlohmann::json;

json schema_document(ResultsDocument kind) {
  json schema = json::parse(results_schema_text);
  if (kind == ResultsDocument::run) return schema;
  const json version = schema["properties"]["schema_version"];
  schema["properties"] = {{"schema_version", version},
                          {"comparison_key", {{"type", "string"}}},
                          {"result", {{"$ref", "#/definitions/result"}}}};
  schema["required"] = {"schema_version", "comparison_key", "result"};
  return schema;
}

// valijson's context is {"<root>", "[results]", "[1]", "[status]"}.
json::json_pointer pointer_of(const std::vector<std::string>& context) {
  json::json_pointer pointer;
  for (std::size_t i = 1; i < context.size(); ++i) pointer.push_back(context[i].substr(1, context[i].size() - 2));
  return pointer;
}

std::string abbreviated(const json& value) {
  const std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  return text.size() <= 60 ? text : text.substr(0, 57) + "...";
}

/// Takes many times as long as holding a document against it.
std::unique_ptr<const valijson::Schema> schema_of(const json& schema_json) {
  auto schema = std::make_unique<valijson::Schema>();
  valijson::SchemaParser(valijson::SchemaParser::kDraft7)
      .populateSchema(valijson::adapters::NlohmannJsonAdapter(schema_json), *schema);
  return schema;
}

void validate_by(const valijson::Schema& schema, const json& document, const std::string& file,
                 const std::string& what) {
  valijson::ValidationResults problems;
  const valijson::adapters::NlohmannJsonAdapter target(document);
  if (valijson::Validator().validate(schema, target, &problems)) return;
  valijson::ValidationResults::Error first;  // the innermost; the others only say where it lies
  problems.popError(first);
  const json::json_pointer pointer = pointer_of(first.context);
  throw InputError(file + "#" + pointer.to_string(), "not by the schema " + what + ": " + first.description +
                                                         " Found: " + abbreviated(document.at(pointer)));
}

}  // namespace

void validate_results(const json& document, ResultsDocument kind, const std::string& file) {
  static const std::unique_ptr<const valijson::Schema> of_run = schema_of(schema_document(ResultsDocument::run)),
                                                       of_single =
                                                           schema_of(schema_document(ResultsDocument::single_result));
  validate_by(kind == ResultsDocument::run ? *of_run : *of_single, document, file,
              "of results, version " + std::to_string(results_schema_version));
}

void validate_document(std::string_view schema_text, const json& document, const std::string& file,
                       const std::string& what) {
  validate_by(*schema_of(json::parse(schema_text)), document, file, what);
}

}  // namespace photonproof::inline reports_record
