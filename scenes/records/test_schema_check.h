// JSON documents checked against a JSON schema by another library, for tests of schemas and of their writers.
#pragma once

#include <memory>
#include <string>

namespace photonproof::inline scenes_records {

class SchemaCheck {
 public:
  /// A JSON schema (draft 7).
  explicit SchemaCheck(const std::string& schema);
  ~SchemaCheck();
  /// Empty where the document conforms; else "#/JSON/pointer: why not" of the innermost place.
  std::string problem(const std::string& document) const;

 private:
  struct Compiled;
  std::unique_ptr<Compiled> compiled_;
};

/// The same of one document.
inline std::string schema_problem(const std::string& schema, const std::string& document) {
  return SchemaCheck(schema).problem(document);
}

}  // namespace photonproof::inline scenes_records
