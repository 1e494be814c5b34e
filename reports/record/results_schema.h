// The contract of results.json (reports/record/results.schema.json, carried inside the program) applied to a document.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace photonproof::inline reports_record {

/// What the file holds: a whole run, or one result {"schema_version": 1, "comparison_key": ..., "result": ...} as a
/// cell's folder keeps it.
enum class ResultsDocument { run, single_result };

/// Throws InputError "<file>#<JSON pointer>" at the first place that breaks the schema, with the value found there.
void validate_results(const nlohmann::json& document, ResultsDocument kind, const std::string& file);

/// The same of any document and JSON schema (draft 7); `what` it is the schema of, "of results, version 1", is in the
/// message.
void validate_document(std::string_view schema_text, const nlohmann::json& document, const std::string& file,
                       const std::string& what);

}  // namespace photonproof::inline reports_record
