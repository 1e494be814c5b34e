// Reads a record that `describe` describes (record_note.h) from JSON. Every key must be known, every value of its type
// and within its limits. Errors are InputError "FILE#/JSON/pointer: error: is 3, expected a string".
#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <utility>

#include "scenes/base/input_error.h"
#include "scenes/base/text_numbers.h"
#include "scenes/records/record_note.h"

namespace photonproof::inline scenes_records {

/// Where a value lies: its key or index within the outer value.
struct RecordPlace {
  const RecordPlace* outer = nullptr;
  std::string_view key{};
  std::optional<std::size_t> index{};

  std::string pointer() const {
    if (outer == nullptr) return {};
    std::string text = index ? std::to_string(*index) : "";
    for (const char c : key) text += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    return outer->pointer() + "/" + text;
  }
};

/// The file that is read, and the names of files found in it.
struct RecordSource {
  std::string file;
  std::vector<std::string> files{};

  [[noreturn]] void fail(const RecordPlace& place, const std::string& what) const {
    const std::string pointer = place.pointer();
    throw InputError(pointer.empty() ? file : file + "#" + pointer, what);
  }
  [[noreturn]] void wrong(const RecordJson& found, const RecordPlace& place, const std::string& expected) const {
    std::string text = found.dump(-1, ' ', false, RecordJson::error_handler_t::replace);
    if (text.size() > 60) text = text.substr(0, 57) + "...";
    fail(place, "is " + text + ", expected " + expected);
  }
};

/// "a number of at least 0 and at most 1".
inline std::string number_within(const char* number, const RecordNote& note) {
  std::string text;
  const auto add = [&](const char* how, const std::optional<double>& limit) {
    if (limit) text += (text.empty() ? " " : " and ") + std::string(how) + " " + format_number(*limit);
  };
  add("of at least", note.least);
  add("above", note.above);
  add("of at most", note.most);
  return number + text;
}

class RecordReader {
 public:
  RecordReader(const RecordJson& json, RecordSource& source, const RecordPlace& place)
      : json_(json), source_(source), place_(place) {
    if (!json.is_object()) source.wrong(json, place, "an object");
  }

  void record(const char* name, const char* = "") { name_ = name; }
  void version(const char* name, int number) {
    const RecordJson* found = find(name);
    if (found == nullptr || !found->is_number_integer())
      throw InputError(source_.file, "is no record of " + std::string(name_) + ": it has no " + name);
    if (*found != number)
      throw InputError(source_.file, "has " + std::string(name) + " " + found->dump() + "; this program reads " +
                                         std::to_string(number));
  }

  template <class T>
  void field(const char* name, T& v, const RecordNote& note = {}) {
    const RecordJson* found = find(name);
    if (found == nullptr) source_.fail(place_, std::string("has no '") + name + "'");
    read(*found, v, note, {&place_, name});
  }
  template <class T>
  void maybe(const char* name, T& v, const RecordNote& note = {}) {
    const RecordJson* found = find(name);
    if (found == nullptr) return;
    if constexpr (is_record_optional<T>)
      read(*found, v.emplace(), note, {&place_, name});
    else
      read(*found, v, note, {&place_, name});
  }
  template <class T>
  void when(bool, const char* name, T& v, const RecordNote& note = {}) {
    maybe(name, v, note);
  }
  template <class T>
  void older(const char* name, T& v, const RecordNote& note = {}) {
    maybe(name, v, note);
  }
  template <class T>
  void derived(const char* name, T v, const RecordNote& note = {}) {
    maybe(name, v, note);
  }
  template <class Describe>
  void object(const char* name, Describe&& describe_it) {
    const RecordJson* found = find(name);
    if (found == nullptr) source_.fail(place_, std::string("has no '") + name + "'");
    const RecordPlace place{&place_, name};
    RecordReader inner(*found, source_, place);
    describe_it(inner);
    inner.refuse_others();
  }
  /// After `describe`: keys that it did not name.
  void refuse_others() const {
    if (json_.size() == known_.size()) return;
    for (const auto& [key, value] : json_.items())
      if (std::find(known_.begin(), known_.end(), key) == known_.end())
        source_.fail(place_, "has '" + key + "', which is not known");
  }

  template <class T>
  void read(const RecordJson& json, T& v, const RecordNote& note, const RecordPlace& place) {
    if constexpr (std::same_as<T, bool>) {
      if (!json.is_boolean()) source_.wrong(json, place, "true or false");
      v = json.get<bool>();
    } else if constexpr (std::integral<T>) {
      read_whole(json, v, note, place);
    } else if constexpr (std::floating_point<T>) {
      if (!json.is_number() || !is_within(json.get<double>(), note))
        source_.wrong(json, place, number_within("a number", note));
      v = json.get<T>();
    } else if constexpr (std::same_as<T, std::string>) {
      read_text(json, v, note, place);
    } else if constexpr (RecordWord<T>) {
      std::string word;
      read_text(json, word, {.words = note.words.empty() ? names_of(T{}) : note.words}, place);
      v = *value_of_word<T>(word);
    } else if constexpr (is_record_optional<T>) {
      if (json.is_null()) return v.reset();
      read(json, v.emplace(), note, place);
    } else if constexpr (is_record_list<T>) {
      if (!json.is_array()) source_.wrong(json, place, "a list");
      v.clear();
      for (std::size_t i = 0; i < json.size(); ++i) read(json[i], v.emplace_back(), note, {&place, {}, i});
    } else if constexpr (is_record_map<T>) {
      if (!json.is_object()) source_.wrong(json, place, "an object");
      v.clear();
      for (const auto& [key, entry] : json.items()) read(entry, v[key], note, {&place, key});
    } else if constexpr (RecordTuple<T>) {
      read_tuple(json, v, note, place);
    } else if constexpr (RecordElements<T>) {
      auto all = elements(v);
      read_tuple(json, all, note, place);
    } else {
      RecordReader inner(json, source_, place);
      describe(inner, v);
      inner.refuse_others();
    }
  }

 private:
  const RecordJson* find(const char* name) {
    const auto found = json_.find(name);
    if (found == json_.end()) return nullptr;
    known_.emplace_back(name);
    return &*found;
  }
  static bool is_within(double v, const RecordNote& note) {
    return (!note.least || v >= *note.least) && (!note.above || v > *note.above) && (!note.most || v <= *note.most);
  }
  template <class T>
  void read_whole(const RecordJson& json, T& v, RecordNote note, const RecordPlace& place) {
    if (std::unsigned_integral<T> && !note.least) note.least = 0;
    const bool fits =
        json.is_number_integer() && (json.is_number_unsigned() ? std::in_range<T>(json.get<std::uint64_t>())
                                                               : std::in_range<T>(json.get<std::int64_t>()));
    if (!fits || !is_within(json.get<double>(), note))
      source_.wrong(json, place, number_within("a whole number", note));
    v = json.get<T>();
  }
  void read_text(const RecordJson& json, std::string& v, const RecordNote& note, const RecordPlace& place) {
    if (!json.is_string()) source_.wrong(json, place, "a string");
    v = json.get<std::string>();
    if (note.filled && v.empty()) source_.wrong(json, place, "a string that is not empty");
    if (note.checksum && (v.size() != 16 || v.find_first_not_of("0123456789abcdef") != std::string::npos))
      source_.wrong(json, place, "16 hexadecimal digits");
    if (!note.words.empty() && std::find(note.words.begin(), note.words.end(), v) == note.words.end())
      source_.wrong(json, place, "one of " + quoted_words(note.words));
    if (note.file) source_.files.push_back(v);
  }
  template <class T>
  void read_tuple(const RecordJson& json, T& v, const RecordNote& note, const RecordPlace& place) {
    constexpr std::size_t size = std::tuple_size_v<T>;
    if (!json.is_array() || json.size() != size) source_.wrong(json, place, "a list of " + std::to_string(size));
    std::size_t i = 0;
    std::apply([&](auto&... entry) { (read_entry(json, i++, entry, note, place), ...); }, v);
  }
  template <class T>
  void read_entry(const RecordJson& json, std::size_t i, T& v, const RecordNote& note, const RecordPlace& place) {
    read(json[i], v, note, {&place, {}, i});
  }
  static std::string quoted_words(std::span<const char* const> words) {
    std::string all;
    for (const char* word : words) all += (all.empty() ? "" : ", ") + ("\"" + std::string(word) + "\"");
    return all;
  }

  const RecordJson& json_;
  RecordSource& source_;
  const RecordPlace& place_;
  const char* name_ = "";
  std::vector<std::string_view> known_{};
};

/// Throws InputError. The file names in the record are added to the source's.
template <class T>
T read_record(const RecordJson& json, RecordSource& source) {
  T record{};
  const RecordPlace root;
  RecordReader(json, source, root).read(json, record, {}, root);
  return record;
}

/// Throws InputError, with line and column, where the text is not JSON.
inline RecordJson parse_record(const std::string& text, const std::string& file) try {
  return RecordJson::parse(text);
} catch (const RecordJson::parse_error& error) {
  // nlohmann counts the offending byte from 1.
  const std::size_t at = std::min(text.size(), error.byte == 0 ? 0 : error.byte - 1);
  const std::size_t line_start = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;  // npos + 1 is 0
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  throw InputError(file, static_cast<int>(line), static_cast<int>(at - line_start) + 1,
                   at == text.size() ? "not valid JSON: the file ends in the middle" : "not valid JSON");
} catch (const RecordJson::out_of_range&) {
  throw InputError(file, "not valid JSON: a number is too large for a double");
}

}  // namespace photonproof::inline scenes_records
