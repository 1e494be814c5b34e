// Records that are written as JSON. One function beside a type says its members:
//
//   template <class V>
//   void describe(V& v, Cell& cell) {
//     v.record("cell", "what was measured");
//     v.field("scene", cell.scene, {.filled = true});
//     v.maybe("title", cell.title, {.says = "a report's heading"});
//   }
//
// RecordWriter (record_writer.h) writes such a type, RecordReader (record_reader.h) reads and checks it, and
// RecordSchema (record_schema.h) prints its JSON schema. A visitor has:
//   record(name, says)        the type's name in a schema; the first call
//   version(name, number)     a constant that a reader demands
//   field(name, member)       always there; an empty std::optional is null
//   maybe(name, member)       left out where it is empty, 0, false or the first word
//   when(is_there, name, m)   left out where the condition, which may read other members, does not hold
//   derived(name, value)      follows from members: for other readers, since RecordReader only checks it
//   older(name, value)        in older records only: never written
//   object(name, function)    an object whose members are the record's own: function(visitor)
// Members are numbers, strings, booleans, enumerations with `words_of`, types with `elements` (written as a list of
// fixed length), types with `describe`, and std::optional, std::vector, std::array, std::tuple and std::map of those.
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
  const char* says = "";                           ///< for people, in the schema
  std::optional<double> least{}, above{}, most{};  ///< limits of a number
  bool filled = false;                             ///< a string that is not empty
  bool checksum = false;                           ///< a string of 16 hexadecimal digits
  bool file = false;                               ///< names of files, relative to the record's folder
  std::span<const char* const> words{};            ///< the only strings, or the only words of an enumeration
};

/// An enumeration whose words, in the order of its values from 0 on, `words_of` returns.
template <class E>
concept RecordWord = std::is_enum_v<E> && requires(E e) {
  std::span<const char* const>(words_of(e));
};

template <RecordWord E>
std::string word_of(E value) {
  return words_of(value)[static_cast<std::size_t>(value)];
}

/// Empty where the text is none of the words.
template <RecordWord E>
std::optional<E> value_of_word(const std::string& text) {
  const std::span<const char* const> words = words_of(E{});
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
