// Results as JSON values, field by field; the shape is reports/record/results.schema.json's.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "reports/record/results.h"

namespace photonproof::inline reports_record {

/// Throws std::logic_error on a number that is not finite: JSON has none, and the record must not.
nlohmann::json results_to_json(const Results& results);
nlohmann::json result_to_json(const Result& result);

/// Precondition: validated (reports/record/results_schema.h).
Results results_from_json(const nlohmann::json& document);
Result result_from_json(const nlohmann::json& document);

}  // namespace photonproof::inline reports_record
