// Scene text as a tree of elements with their positions. Only xml_source.cpp uses pugixml. Files are untrusted, so
// everything a hostile file could grow (size, nesting, number of elements) is bounded here.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/base/input_error.h"

namespace photonproof::scene_xml {

constexpr std::size_t kMaxFileBytes = std::size_t{64} << 20;
constexpr std::size_t kMaxElements = 1'000'000;  ///< over all files of a scene
constexpr int kMaxNesting = 64;                  ///< depth of elements, counted through includes

/// A byte of one of the scene's files.
struct Position {
  int file = 0;
  std::size_t offset = 0;
};

struct Attribute {
  std::string name;
  std::string value;  ///< entities decoded
  Position at;        ///< of the name
  std::string raw;    ///< as written when `$name` was replaced in it, else empty
};

struct Element {
  std::string tag;
  Position at;  ///< of '<'
  std::vector<Attribute> attributes;
  std::vector<Element> children;

  const Attribute* find(std::string_view name) const;
};

/// The texts a scene was read from; turns positions into messages.
class Sources {
 public:
  /// Returns the new file's index.
  int add(std::string name, std::string text);
  const std::string& name(int file) const { return files_[static_cast<std::size_t>(file)].name; }
  const std::string& text(int file) const { return files_[static_cast<std::size_t>(file)].text; }
  std::vector<std::string> names() const;
  SourceLoc loc(const Position& at) const;
  [[noreturn]] void fail(const Position& at, const std::string& message) const;

 private:
  struct File {
    std::string name;
    std::string text;
    std::vector<std::size_t> line_starts;
  };
  std::vector<File> files_;
};

/// Parses one file of `sources` and returns its root element. `elements` counts over all files. Throws InputError when
/// the text is not well-formed UTF-8 XML with one root, has a DOCTYPE, entities of its own, text between elements, a
/// repeated attribute, or exceeds a limit.
Element parse_xml(const Sources& sources, int file, std::size_t& elements);

/// Throws unless every attribute is one of `allowed`; names the nearest.
void check_attributes(const Sources& sources, const Element& element, const std::vector<std::string>& allowed);

/// The value of an attribute that must be there.
const Attribute& require(const Sources& sources, const Element& element, std::string_view name);

/// Throws at the attribute; mentions its value after `$name` was replaced.
[[noreturn]] void fail_at(const Sources& sources, const Attribute& attribute, const std::string& message);

}  // namespace photonproof::scene_xml
