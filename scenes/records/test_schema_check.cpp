// The one place that includes valijson: it takes half a minute to compile.

#include "scenes/records/test_schema_check.h"

#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

namespace photonproof::inline scenes_records {

using valijson::adapters::NlohmannJsonAdapter;

struct SchemaCheck::Compiled {
  valijson::Schema schema;
};

SchemaCheck::SchemaCheck(const std::string& schema) : compiled_(std::make_unique<Compiled>()) {
  const auto json = nlohmann::json::parse(schema);
  valijson::SchemaParser(valijson::SchemaParser::kDraft7).populateSchema(NlohmannJsonAdapter(json), compiled_->schema);
}

SchemaCheck::~SchemaCheck() = default;

std::string SchemaCheck::problem(const std::string& document) const {
  const auto json = nlohmann::json::parse(document);
  valijson::ValidationResults problems;
  if (valijson::Validator().validate(compiled_->schema, NlohmannJsonAdapter(json), &problems)) return "";
  valijson::ValidationResults::Error first;  // the innermost; the others only say where it lies
  problems.popError(first);
  // The context is {"<root>", "[results]", "[1]", "[status]"}.
  nlohmann::json::json_pointer pointer;
  for (std::size_t i = 1; i < first.context.size(); ++i)
    pointer.push_back(first.context[i].substr(1, first.context[i].size() - 2));
  return "#" + pointer.to_string() + ": " + first.description;
}

}  // namespace photonproof::inline scenes_records
