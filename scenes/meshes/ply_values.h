// Reads the values after a PLY header in sequence: the same interface over text and over bytes of either order.
#pragma once

#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <string>
#include <string_view>

#include "scenes/base/input_error.h"
#include "scenes/base/text_numbers.h"
#include "scenes/base/text_position.h"
#include "scenes/base/utf8.h"
#include "scenes/meshes/ply_header.h"

namespace photonproof::ply {

static_assert(std::endian::native == std::endian::little, "loading and storing PLY assume a little-endian machine");

/// The row of an element that is being read, for messages.
struct Row {
  const std::string* element = nullptr;
  std::uint64_t number = 0;  ///< from 0
  /// "face 7"; the name comes from the file, so it is cut and made printable.
  std::string text() const { return printable(element->substr(0, 60)) + " " + std::to_string(number); }
};

template <bool kBigEndian>
class BinaryValues {
 public:
  BinaryValues(const std::string& file, std::string_view bytes, std::size_t start)
      : file_(file), bytes_(bytes), next_(start) {}

  Row row;

  /// An integer value.
  std::int64_t integer(Type type) {
    const char* p = take(size_of(type));
    switch (type) {
      case Type::int8:
        return load<std::int8_t>(p);
      case Type::uint8:
        return load<std::uint8_t>(p);
      case Type::int16:
        return load<std::int16_t>(p);
      case Type::uint16:
        return load<std::uint16_t>(p);
      case Type::int32:
        return load<std::int32_t>(p);
      default:
        return load<std::uint32_t>(p);
    }
  }
  /// A floating-point value.
  double number(Type type) {
    const char* p = take(size_of(type));
    return type == Type::float32 ? double{load<float>(p)} : load<double>(p);
  }
  void skip(Type type, std::uint64_t count) {
    if (count > (bytes_.size() - next_) / size_of(type)) fail_at_end();
    next_ += count * size_of(type);
  }

  /// Throws about the last value: "<element> <row> <what>".
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(file_, "at byte " + std::to_string(last_) + ": " + row.text() + " " + what);
  }
  /// The fewest bytes of a value of a type in the file.
  static std::size_t least_bytes(Type type) { return size_of(type); }
  std::size_t remaining() const { return bytes_.size() - next_; }
  /// Throws unless the file ends here.
  void finish() const {
    if (remaining() > 0)
      throw InputError(file_, "at byte " + std::to_string(next_) + ": " + std::to_string(remaining()) +
                                  " bytes follow the last element, expected none");
  }

 private:
  const char* take(std::size_t size) {
    if (size > bytes_.size() - next_) fail_at_end();
    last_ = next_;
    next_ += size;
    return bytes_.data() + last_;
  }
  [[noreturn]] void fail_at_end() const {
    throw InputError(file_, "at byte " + std::to_string(bytes_.size()) + ": the file ends within " + row.text());
  }
  template <class T>
  static T load(const char* p) {
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), p, sizeof(T));
    if constexpr (kBigEndian)
      for (std::size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(raw[i], raw[sizeof(T) - 1 - i]);
    return std::bit_cast<T>(raw);
  }

  const std::string& file_;
  std::string_view bytes_;
  std::size_t next_;
  std::size_t last_ = 0;  // where the last value starts
};

class TextValues {
 public:
  TextValues(const std::string& file, std::string_view text, std::size_t start)
      : file_(file), text_(text), next_(start) {}

  Row row;

  std::int64_t integer(Type) {
    const std::string_view word = take();
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size())
      fail("has " + in_quotes(word) + ", expected an integer");
    return value;
  }
  double number(Type) {
    const std::string_view word = take();
    const char* first = word.data() + (word.size() > 1 && word[0] == '+' ? 1 : 0);
    double value = 0;
    const auto [end, error] = std::from_chars(first, word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size())
      fail("has " + in_quotes(word) + ", expected a number in the range of double precision");
    return value;
  }
  void skip(Type, std::uint64_t count) {
    for (; count > 0; --count) take();
  }
  [[noreturn]] void fail(const std::string& what) const {
    fail_at_offset(file_, text_, last_, row.text() + " " + what);
  }
  static std::size_t least_bytes(Type) { return 2; }  // a digit and white space
  /// One more than remain: the last value needs no white space after it.
  std::size_t remaining() const { return text_.size() - next_ + 1; }
  void finish() const {
    const std::size_t more = text_.find_first_not_of(kSpace, next_);
    if (more != std::string_view::npos)
      fail_at_offset(file_, text_, more, "unexpected text after the last element, expected the end of the file");
  }

 private:
  static constexpr std::string_view kSpace = " \t\r\n";
  static bool is_space(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }

  std::string_view take() {
    const std::size_t size = text_.size();
    while (next_ < size && is_space(text_[next_])) ++next_;
    if (next_ == size) fail_at_offset(file_, text_, size, "the file ends within " + row.text());
    last_ = next_;
    while (next_ < size && !is_space(text_[next_])) ++next_;
    return text_.substr(last_, next_ - last_);
  }

  const std::string& file_;
  std::string_view text_;
  std::size_t next_;
  std::size_t last_ = 0;
};

}  // namespace photonproof::ply
