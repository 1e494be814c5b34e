// Prints the JSON schema (draft 7) of a record that `describe` describes (record_note.h).
#pragma once

#include <cstdint>
#include <utility>

#include "scenes/records/record_note.h"

namespace photonproof::inline scenes_records {

class RecordSchema {
 public:
  /// `definitions` receives the types within the record.
  explicit RecordSchema(RecordJson& definitions) : definitions_(definitions) {}

  void record(const char* name, const char* says = "") {
    name_ = name;
    if (*says != 0) describe_as(object_, says);
  }
  void version(const char* name, int number) { add(name, {{"const", number}}, true); }
  template <class T>
  void field(const char* name, const T& v, const RecordNote& note = {}) {
    add(name, type_of(v, note), true);
  }
  template <class T>
  void maybe(const char* name, const T& v, const RecordNote& note = {}) {
    if constexpr (is_record_optional<T>)
      add(name, type_of(typename T::value_type{}, note), false);
    else
      add(name, type_of(v, note), false);
  }
  template <class T>
  void when(bool, const char* name, const T& v, const RecordNote& note = {}) {
    maybe(name, v, note);
  }
  template <class T>
  void older(const char* name, const T& v, const RecordNote& note = {}) {
    maybe(name, v, note);
  }
  template <class T>
  void derived(const char* name, const T& v, const RecordNote& note = {}) {
    maybe(name, v, note);
  }
  template <class Describe>
  void object(const char* name, Describe&& describe_it) {
    RecordSchema inner(definitions_);
    describe_it(inner);
    add(name, inner.schema(), true);
  }

  const std::string& name() const { return name_; }
  RecordJson schema() const {
    RecordJson json = {{"type", "object"}, {"additionalProperties", false}};
    json.update(object_);
    json["required"] = required_;
    json["properties"] = properties_;
    return json;
  }

 private:
  static void describe_as(RecordJson& json, const char* says) { json["description"] = says; }

  void add(const char* name, RecordJson type, bool required) {
    properties_[name] = std::move(type);
    if (required) required_.push_back(name);
  }
  template <class T>
  RecordJson type_of(const T& v, const RecordNote& note) {
    RecordJson json = bare_type_of(v, note);
    if (*note.says != 0) describe_as(json, note.says);
    return json;
  }
  template <class T>
  RecordJson bare_type_of(const T& v, RecordNote note) {
    note.says = "";
    if constexpr (std::same_as<T, bool>) {
      return {{"type", "boolean"}};
    } else if constexpr (std::is_arithmetic_v<T>) {
      if (std::unsigned_integral<T> && !note.least) note.least = 0;
      return number(std::integral<T> ? "integer" : "number", note);
    } else if constexpr (std::same_as<T, std::string>) {
      return text(note);
    } else if constexpr (RecordWord<T>) {
      return one_of(note.words.empty() ? names_of(v) : note.words);
    } else if constexpr (is_record_optional<T>) {
      return {{"anyOf", {type_of(typename T::value_type{}, note), {{"type", "null"}}}}};
    } else if constexpr (is_record_list<T>) {
      return {{"type", "array"}, {"items", type_of(typename T::value_type{}, note)}};
    } else if constexpr (is_record_map<T>) {
      return {{"type", "object"}, {"additionalProperties", type_of(typename T::mapped_type{}, note)}};
    } else if constexpr (RecordTuple<T>) {
      constexpr std::size_t size = std::tuple_size_v<T>;
      return {{"type", "array"}, {"items", type_of(std::get<0>(v), note)}, {"minItems", size}, {"maxItems", size}};
    } else if constexpr (RecordElements<T>) {
      T record{};
      return type_of(elements(record), note);
    } else {
      T record{};
      RecordSchema inner(definitions_);
      describe(inner, record);
      definitions_[inner.name()] = inner.schema();
      return {{"$ref", "#/definitions/" + inner.name()}};
    }
  }
  static RecordJson number(const char* type, const RecordNote& note) {
    RecordJson json = {{"type", type}};
    const auto add_limit = [&](const char* key, const std::optional<double>& limit) {
      if (limit) json[key] = static_cast<std::int64_t>(*limit);  // all are whole
    };
    add_limit("minimum", note.least);
    add_limit("exclusiveMinimum", note.above);
    add_limit("maximum", note.most);
    return json;
  }
  static RecordJson text(const RecordNote& note) {
    if (!note.words.empty()) return one_of(note.words);
    RecordJson json = {{"type", "string"}};
    if (note.filled) json["minLength"] = 1;
    if (note.checksum) json["pattern"] = "^[0-9a-f]{16}$";
    return json;
  }
  static RecordJson one_of(std::span<const char* const> words) {
    return {{"enum", std::vector<std::string>(words.begin(), words.end())}};
  }

  RecordJson& definitions_;
  std::string name_{};
  RecordJson object_ = RecordJson::object(), properties_ = RecordJson::object(), required_ = RecordJson::array();
};

/// Text of the JSON; an object or list that fits a line of 120 characters stands on one.
inline std::string wrapped_json(const RecordJson& json, std::size_t indent, std::size_t before) {
  const std::string line = json.dump();
  if (!json.is_structured() || indent + before + line.size() <= 119) return line;
  std::string text;
  for (const auto& [key, value] : json.items()) {
    const std::string name = json.is_object() ? RecordJson(key).dump() + ": " : "";
    text += (text.empty() ? "\n" : ",\n") + std::string(indent + 2, ' ') + name +
            wrapped_json(value, indent + 2, name.size());
  }
  const bool is_list = json.is_array();
  return (is_list ? "[" : "{") + text + "\n" + std::string(indent, ' ') + (is_list ? "]" : "}");
}

/// The schema of a T, whose name is the title.
template <class T>
std::string schema_text() {
  RecordJson definitions = RecordJson::object();
  T record{};
  RecordSchema schema(definitions);
  describe(schema, record);
  RecordJson json = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", schema.name()}};
  json.update(schema.schema());
  if (!definitions.empty()) json["definitions"] = std::move(definitions);
  return wrapped_json(json, 0, 0) + "\n";
}

}  // namespace photonproof::inline scenes_records
