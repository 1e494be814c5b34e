// Records that are written as JSON. A function beside a type describes its members.
// ```
//   template <class V>
//   void describe(V& v, Cell& cell) {
//     v.record("cell", "what was measured");
//     v.field("scene", cell.scene, {.filled = true});
//     v.maybe("title", cell.title, {.says = "a report's heading"});
//   }
// ```
// RecordWriter (record_writer.h) writes such a type, RecordReader (record_reader.h) reads and checks it, and
// RecordSchema (record_schema.h) prints its JSON schema. A visitor has these functions.
//   `record(name, says)`       The type's name in a schema; the first call.
//   `version(name, number)`    A constant that a reader requires.
//   `field(name, member)`      Always present; an empty std::optional is null.
//   `maybe(name, member)`      Left out where it is empty, 0, false or the first word.
//   `when(is_there, name, m)`  Left out where the condition, which may read other members, does not hold.
//   `derived(name, value)`     Follows from members: for other readers, since RecordReader only checks it.
//   `older(name, value)`       In older records only: never written.
//   `object(name, function)`   An object whose members are the record's own: function(visitor).
// Members are numbers, strings, booleans, enumerations with `names_of`, and types with `describe`. Types with
// `elements` are lists of fixed length. Also allowed are std::optional, std::vector, std::array, std::tuple and
// std::map of those.
#pragma once

#include <concepts>
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

namespace photonproof::inline scenes_records {

using RecordJson = nlohmann::ordered_json;

/// Conditions on a member beyond its type. Numbers in lists and maps have the limits, too.
struct RecordNote {
  const char* says = "";                           ///< For people, in the schema.
  std::optional<double> least{}, above{}, most{};  ///< Limits of a number.
  bool filled = false;                             ///< A string that is not empty.
  bool checksum = false;                           ///< A string of 16 hexadecimal digits.
  bool file = false;                               ///< Names of files, relative to the record's folder.
  std::span<const char* const> words{};            ///< The only strings, or the only words of an enumeration.
};

/// An enumeration whose words, in the order of its values from 0 on, `names_of` returns.
template <class E>
concept RecordWord = std::is_enum_v<E> && requires(E e) {
  std::span<const char* const>(names_of(e));
};

template <RecordWord E>
std::string word_of(E value) {
  return names_of(value)[static_cast<std::size_t>(value)];
}

/// Empty where the text is not one of the words.
template <RecordWord E>
std::optional<E> value_of_word(const std::string& text) {
  const std::span<const char* const> words = names_of(E{});
  for (std::size_t i = 0; i < words.size(); ++i)
    if (text == words[i]) return static_cast<E>(i);
  return std::nullopt;
}

template <class T>
concept RecordTuple = requires {
  std::tuple_size<T>::value;
};
template <class T>
concept RecordElements = requires(T& t) {
  elements(t);
};

template <class T>
inline constexpr bool is_record_list = false;
template <class T>
inline constexpr bool is_record_list<std::vector<T>> = true;
template <class T>
inline constexpr bool is_record_map = false;
template <class T>
inline constexpr bool is_record_map<std::map<std::string, T>> = true;
template <class T>
inline constexpr bool is_record_optional = false;
template <class T>
inline constexpr bool is_record_optional<std::optional<T>> = true;

/// Whether `maybe` leaves the value out.
template <class T>
bool is_absent(const T& value) {
  if constexpr (is_record_optional<T>)
    return !value.has_value();
  else if constexpr (requires { value.empty(); })
    return value.empty();
  else
    return value == T{};
}

}  // namespace photonproof::inline scenes_records
