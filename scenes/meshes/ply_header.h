// The head of a PLY file (Turk 1994): the elements that follow, their properties, and the encoding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace photonproof::ply {

enum class Format { ascii, little_endian, big_endian };
enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

constexpr bool is_floating(Type type) { return type == Type::float32 || type == Type::float64; }
std::size_t size_of(Type type);  ///< bytes in a binary file
const char* name_of(Type type);

struct Property {
  std::string name;
  Type type = Type::float32;
  std::optional<Type> count_type;  ///< of a list
  std::size_t offset = 0;          ///< of the line in the file
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
  std::size_t offset = 0;  ///< of the line in the file
};

struct Header {
  Format format = Format::ascii;
  std::vector<Element> elements;
  std::size_t size = 0;  ///< bytes; the elements' values follow
};

/// Throws InputError with file:line:col on anything but a valid PLY header; repeated elements or properties are
/// invalid.
Header read_header(std::string_view bytes, const std::string& file);

}  // namespace photonproof::ply
