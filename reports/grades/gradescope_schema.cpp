// The second place that includes valijson (reports/record/results_schema.cpp): for another document, and as slow to
// compile.

#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "gradescope_schema_text.h"
#include "reports/grades/gradescope.h"
#include "scenes/base/input_error.h"

namespace photonproof::inline reports_grades {

void validate_gradescope(const nlohmann::ordered_json& document, const std::string& file) {
  const nlohmann::json schema_json = nlohmann::json::parse(gradescope_schema_text);
  const nlohmann::json plain = nlohmann::json::parse(document.dump());
  valijson::Schema schema;
  valijson::SchemaParser(valijson::SchemaParser::kDraft7)
      .populateSchema(valijson::adapters::NlohmannJsonAdapter(schema_json), schema);
  valijson::ValidationResults problems;
  const valijson::adapters::NlohmannJsonAdapter target(plain);
  if (valijson::Validator().validate(schema, target, &problems)) return;
  valijson::ValidationResults::Error first;  // the innermost
  problems.popError(first);
  nlohmann::json::json_pointer pointer;
  for (std::size_t i = 1; i < first.context.size(); ++i)
    pointer.push_back(first.context[i].substr(1, first.context[i].size() - 2));
  throw InputError(file + "#" + pointer.to_string(), "not as Gradescope documents it: " + first.description);
}

}  // namespace photonproof::inline reports_grades
