// Strict reading of TOML: every key is read by its type, and a key that no reader reads is an error with its place.
// Keeps the toml++ header, which is slow to compile, in one source file.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/base/input_error.h"

namespace photonproof::inline harness_suites {

/// A view of one table of a parsed document. Copies see the same table and share the record of the keys that were read.
/// Every reading function throws InputError with file:line:col when the key is missing (unless optional) or its value
/// has another type.
class TomlTable {
 public:
  /// `file` stands for the text in messages. Throws InputError on a syntax error.
  static TomlTable parse(std::string_view text, const std::string& file);

  std::string string(const std::string& key) const;  ///< not empty
  std::int64_t integer(const std::string& key) const;
  double number(const std::string& key) const;  ///< integer or float, finite
  bool boolean(const std::string& key) const;
  std::vector<std::string> strings(const std::string& key) const;
  std::vector<std::int64_t> integers(const std::string& key) const;
  std::vector<double> numbers(const std::string& key) const;  ///< integers or floats, finite
  std::vector<std::vector<std::string>> string_lists(const std::string& key) const;
  TomlTable table(const std::string& key) const;

  bool has(const std::string& key) const;
  bool is_array(const std::string& key) const;
  bool is_string(const std::string& key) const;
  bool is_integer(const std::string& key) const;
  std::vector<std::string> keys() const;  ///< all keys of the table
  /// An array of tables; empty when the key is absent.
  std::vector<TomlTable> tables(const std::string& key) const;

  /// Throws for the first key that none of the above has read, and names those that were.
  void expect_no_other_keys() const;

  int line() const;  ///< where the table begins, from 1

  /// An error at the value of `key`, at element `index` of the array that is its value, or at the table itself.
  InputError error(const std::string& key, const std::string& message) const;
  InputError error(const std::string& key, std::size_t index, const std::string& message) const;
  InputError error(const std::string& message) const;

 private:
  struct View;
  explicit TomlTable(std::shared_ptr<View> view) : view_(std::move(view)) {}
  std::shared_ptr<View> view_;
};

}  // namespace photonproof::inline harness_suites
