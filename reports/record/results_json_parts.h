// What results_json.cpp and conclusions_json.cpp share.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "reports/record/results.h"

namespace photonproof::inline reports_record {

/// The value; std::logic_error when it is not finite.
double finite(double value, const std::string& what);

nlohmann::json budget_to_json(const Budget& budget);
Budget budget_from_json(const nlohmann::json& j);

/// Empty when the key is absent, as undefined quantities are.
template <class T>
std::optional<T> optional_at(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() ? std::nullopt : std::optional<T>(found->get<T>());
}

/// Convergence, gates, changes and caveats, each left out when there are none (conclusions_json.cpp).
void conclusions_to_json(const Results& results, nlohmann::json& document);
void conclusions_from_json(const nlohmann::json& document, Results& results);

}  // namespace photonproof::inline reports_record
