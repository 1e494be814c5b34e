// Writes a record that `describe` describes (record_note.h) as JSON.
#pragma once

#include <cmath>
#include <stdexcept>

#include "scenes/records/record_note.h"

namespace photonproof::inline scenes_records {

class RecordWriter {
 public:
  void record(const char*, const char* = "") {}
  void version(const char* name, int number) { json_[name] = number; }

  template <class T>
  void field(const char* name, const T& v, const RecordNote& = {}) {
    json_[name] = value(v, name);
  }
  template <class T>
  void maybe(const char* name, const T& v, const RecordNote& = {}) {
    if (!is_absent(v)) field(name, v);
  }
  template <class T>
  void when(bool is_there, const char* name, const T& v, const RecordNote& = {}) {
    if (is_there) field(name, v);
  }
  template <class T>
  void derived(const char* name, const T& v, const RecordNote& = {}) {
    if constexpr (is_record_optional<T>)
      maybe(name, v);
    else
      field(name, v);
  }
  template <class T>
  void older(const char*, const T&, const RecordNote& = {}) {}
  template <class Describe>
  void object(const char* name, Describe&& describe_it) {
    RecordWriter inner;
    describe_it(inner);
    json_[name] = std::move(inner.json_);
  }

  /// `name` is for the error: std::logic_error on a non-finite number, since JSON has none.
  template <class T>
  static RecordJson value(const T& v, const char* name) {
    if constexpr (std::floating_point<T>) {
      if (!std::isfinite(v)) throw std::logic_error(std::string("a record's '") + name + "' is not finite");
      return v;
    } else if constexpr (std::integral<T> || std::same_as<T, std::string>) {
      return v;
    } else if constexpr (RecordWord<T>) {
      return word_of(v);
    } else if constexpr (is_record_optional<T>) {
      return v ? value(*v, name) : RecordJson();
    } else if constexpr (is_record_list<T>) {
      RecordJson list = RecordJson::array();
      for (const auto& entry : v) list.push_back(value(entry, name));
      return list;
    } else if constexpr (is_record_map<T>) {
      RecordJson object = RecordJson::object();
      for (const auto& [key, entry] : v) object[key] = value(entry, name);
      return object;
    } else if constexpr (RecordTuple<T>) {
      RecordJson list = RecordJson::array();
      std::apply([&](const auto&... entry) { (list.push_back(value(entry, name)), ...); }, v);
      return list;
    } else if constexpr (RecordElements<T>) {
      return value(elements(const_cast<T&>(v)), name);
    } else {  // one `describe` for reader and writer, which changes nothing
      RecordWriter inner;
      describe(inner, const_cast<T&>(v));
      return std::move(inner.json_);
    }
  }

 private:
  RecordJson json_ = RecordJson::object();
};

/// Throws std::logic_error on a number that is not finite.
template <class T>
RecordJson record_json(const T& record) {
  return RecordWriter::value(record, "");
}

}  // namespace photonproof::inline scenes_records
