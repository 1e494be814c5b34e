#include "scenes/xml/xml_source.h"

#include <algorithm>
#include <cctype>
#include <pugixml.hpp>
#include <unordered_set>

#include "scenes/base/edit_distance.h"
#include "scenes/base/text_numbers.h"
#include "scenes/base/utf8.h"

namespace photonproof::scene_xml {
namespace {

/// Walks the start tag of an element that pugixml has accepted, to find data that pugixml does not keep: the places of
/// attributes and their text before decoding.
class StartTag {
 public:
  StartTag(std::string_view text, std::size_t after_name) : text_(text), at_(after_name) {}

  struct Raw {
    std::size_t offset;
    std::string_view value;
    std::size_t value_offset;
  };
  Raw next() {
    skip_space();
    const std::size_t name = at_;
    at_ = std::min(text_.find('=', at_), text_.size());
    const std::size_t open = std::min(text_.find_first_of("\"'", at_), text_.size() - 1);
    const std::size_t close = std::min(text_.find(text_[open], open + 1), text_.size());
    at_ = std::min(close + 1, text_.size());
    return {name, text_.substr(open + 1, close - open - 1), open + 1};
  }

 private:
  void skip_space() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  std::string_view text_;
  std::size_t at_;
};

/// True for "&lt;" and similar references, and for references to characters that XML allows.
bool is_known_reference(std::string_view reference) {
  if (reference == "lt" || reference == "gt" || reference == "amp" || reference == "quot" || reference == "apos")
    return true;
  if (reference.size() < 2 || reference[0] != '#') return false;
  const bool hex = reference[1] == 'x';
  const std::string_view digits = reference.substr(hex ? 2 : 1);
  if (digits.empty() || digits.size() > 7) return false;
  unsigned value = 0;
  for (const char c : digits) {
    const auto u = static_cast<unsigned char>(c);
    if (hex ? !std::isxdigit(u) : !std::isdigit(u)) return false;
    const int digit = std::isdigit(u) ? c - '0' : std::tolower(u) - 'a' + 10;
    value = value * (hex ? 16u : 10u) + static_cast<unsigned>(digit);
  }
  if (value < 32) return value == 9 || value == 10 || value == 13;
  return value <= 0x10FFFF && !(value >= 0xD800 && value <= 0xDFFF);
}

class TreeBuilder {
 public:
  TreeBuilder(const Sources& sources, int file, std::size_t& elements)
      : sources_(sources), file_(file), elements_(elements) {}

  Element build(const pugi::xml_node& node, int depth) {
    Element element;
    element.tag = node.name();
    element.at = at(static_cast<std::size_t>(node.offset_debug()) - 1);
    if (++elements_ > kMaxElements)
      sources_.fail(element.at, "the scene has more than " + std::to_string(kMaxElements) + " elements");
    if (depth > kMaxNesting)
      sources_.fail(element.at, "elements are nested more than " + std::to_string(kMaxNesting) + " deep");
    read_attributes(node, element);
    for (const pugi::xml_node& child : node.children()) {
      if (child.type() == pugi::node_element)
        element.children.push_back(build(child, depth + 1));
      else
        fail_at_node(child, "unexpected text inside <" + element.tag + ">, expected elements only");
    }
    return element;
  }

  [[noreturn]] void fail_at_node(const pugi::xml_node& node, const std::string& message) const {
    const std::string& text = sources_.text(file_);
    const auto offset = static_cast<std::size_t>(std::max<std::ptrdiff_t>(node.offset_debug(), 0));
    const bool is_text = node.type() == pugi::node_pcdata || node.type() == pugi::node_cdata;
    const std::size_t start = is_text ? text.find_first_not_of(" \t\r\n", offset) : text.rfind('<', offset);
    sources_.fail(at(std::min(start, text.size())), message);
  }

 private:
  Position at(std::size_t offset) const { return {file_, offset}; }

  void read_attributes(const pugi::xml_node& node, Element& element) const {
    const std::string_view text = sources_.text(file_);
    StartTag tag(text, element.at.offset + 1 + element.tag.size());
    std::unordered_set<std::string_view> names;
    for (const pugi::xml_attribute& attribute : node.attributes()) {
      const StartTag::Raw raw = tag.next();
      check_references(raw);
      if (!names.insert(attribute.name()).second)
        sources_.fail(at(raw.offset), "attribute " + in_quotes(attribute.name()) + " is given twice");
      element.attributes.push_back({attribute.name(), attribute.value(), at(raw.offset), {}});
    }
  }

  void check_references(const StartTag::Raw& raw) const {
    for (auto amp = raw.value.find('&'); amp != std::string_view::npos; amp = raw.value.find('&', amp + 1)) {
      const auto end = raw.value.find(';', amp);
      const std::string_view reference =
          end == std::string_view::npos ? raw.value.substr(amp + 1) : raw.value.substr(amp + 1, end - amp - 1);
      if (end == std::string_view::npos || !is_known_reference(reference))
        sources_.fail(at(raw.value_offset + amp), "unknown entity " + in_quotes("&" + std::string(reference) + ";") +
                                                      ", expected &lt; &gt; &amp; &quot; &apos; or a character number");
    }
  }

  const Sources& sources_;
  int file_;
  std::size_t& elements_;
};

/// Cheap checks on the raw text, so that pugixml never allocates for more nodes than the limits allow.
void check_text(const Sources& sources, int file) {
  const std::string& text = sources.text(file);
  if (const auto bad = find_invalid_utf8(text); bad != std::string::npos)
    sources.fail({file, bad}, "not a valid UTF-8 character");
  std::size_t tags = 0, attributes = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (is_control_character(c))
      sources.fail({file, i}, "control character " + std::to_string(int{c}) + ", expected text");
    if (c == '<' && i + 1 < text.size() && text[i + 1] != '/') ++tags;
    if (c == '=') ++attributes;
    if (tags > kMaxElements + 100 || attributes > 8 * kMaxElements)
      sources.fail({file, i}, "the scene has more than " + std::to_string(kMaxElements) + " elements");
  }
}

std::string lower_first(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

}  // namespace

const Attribute* Element::find(std::string_view name) const {
  const auto found = std::find_if(attributes.begin(), attributes.end(), [&](const auto& a) { return a.name == name; });
  return found == attributes.end() ? nullptr : &*found;
}

int Sources::add(std::string name, std::string text) {
  File file{std::move(name), std::move(text), {0}};
  for (std::size_t i = 0; i < file.text.size(); ++i)
    if (file.text[i] == '\n') file.line_starts.push_back(i + 1);
  files_.push_back(std::move(file));
  return static_cast<int>(files_.size()) - 1;
}

std::vector<std::string> Sources::names() const {
  std::vector<std::string> names;
  for (const File& file : files_) names.push_back(file.name);
  return names;
}

SourceLoc Sources::loc(const Position& at) const {
  const File& file = files_[static_cast<std::size_t>(at.file)];
  const auto after = std::upper_bound(file.line_starts.begin(), file.line_starts.end(), at.offset);
  const auto line = static_cast<int>(after - file.line_starts.begin());
  return {at.file, line, static_cast<int>(at.offset - *std::prev(after)) + 1};
}

void Sources::fail(const Position& at, const std::string& message) const {
  const File& file = files_[static_cast<std::size_t>(at.file)];
  const SourceLoc where = loc({at.file, std::min(at.offset, file.text.size())});
  const std::size_t start = file.line_starts[static_cast<std::size_t>(where.line - 1)];
  std::string line = file.text.substr(start, file.text.find('\n', start) - start);
  if (!line.empty() && line.back() == '\r') line.pop_back();
  throw InputError(file.name, where.line, where.column, message, line);
}

Element parse_xml(const Sources& sources, int file, std::size_t& elements) {
  check_text(sources, file);
  const std::string& text = sources.text(file);
  pugi::xml_document document;
  // Fragments and the document type are kept, so that stray text and definitions of a DOCTYPE are seen and refused.
  const unsigned flags = pugi::parse_default | pugi::parse_doctype | pugi::parse_fragment;
  const auto result = document.load_buffer(text.data(), text.size(), flags, pugi::encoding_utf8);
  if (!result) {
    const auto offset = static_cast<std::size_t>(std::max<std::ptrdiff_t>(result.offset, 0));
    const bool at_end = text.find('>', offset) == std::string::npos;
    sources.fail({file, offset}, at_end ? "the file ends in the middle of an element (truncated?)"
                                        : "not well-formed XML: " + lower_first(result.description()));
  }
  TreeBuilder builder(sources, file, elements);
  pugi::xml_node root;
  for (const pugi::xml_node& node : document.children()) {
    if (node.type() == pugi::node_doctype) {
      if (std::string_view(node.value()).find('[') != std::string_view::npos)
        builder.fail_at_node(node, "a DOCTYPE with definitions is not allowed in a scene");
      continue;
    }
    if (node.type() != pugi::node_element) builder.fail_at_node(node, "unexpected text outside the root element");
    if (root) builder.fail_at_node(node, "a second root element, expected one");
    root = node;
  }
  if (!root) sources.fail({file, 0}, "no element found, expected <scene version=\"3.0.0\">");
  return builder.build(root, 1);
}

void check_attributes(const Sources& sources, const Element& element, const std::vector<std::string>& allowed) {
  for (const Attribute& attribute : element.attributes)
    if (std::find(allowed.begin(), allowed.end(), attribute.name) == allowed.end())
      sources.fail(attribute.at, "<" + element.tag + "> has no attribute " + in_quotes(attribute.name) +
                                     did_you_mean(attribute.name, allowed) + ", expected " + join_or(allowed));
}

const Attribute& require(const Sources& sources, const Element& element, std::string_view name) {
  const Attribute* attribute = element.find(name);
  if (!attribute) sources.fail(element.at, "<" + element.tag + "> needs the attribute " + in_quotes(name));
  return *attribute;
}

void fail_at(const Sources& sources, const Attribute& attribute, const std::string& message) {
  const std::string from = attribute.raw.empty() ? "" : " (from " + in_quotes(attribute.raw) + ")";
  sources.fail(attribute.at, message + from);
}

}  // namespace photonproof::scene_xml
