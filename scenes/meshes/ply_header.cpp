#include "scenes/meshes/ply_header.h"

#include <algorithm>
#include <array>
#include <utility>

#include "scenes/base/edit_distance.h"
#include "scenes/base/text_numbers.h"
#include "scenes/base/text_position.h"

namespace photonproof::ply {
namespace {

constexpr std::size_t kMaxHeaderBytes = std::size_t{64} << 10;

struct TypeRow {
  const char* name;
  const char* sized_name;
  Type type;
  std::size_t size;
};
constexpr std::array<TypeRow, 8> kTypes{{{"char", "int8", Type::int8, 1},
                                         {"uchar", "uint8", Type::uint8, 1},
                                         {"short", "int16", Type::int16, 2},
                                         {"ushort", "uint16", Type::uint16, 2},
                                         {"int", "int32", Type::int32, 4},
                                         {"uint", "uint32", Type::uint32, 4},
                                         {"float", "float32", Type::float32, 4},
                                         {"double", "float64", Type::float64, 8}}};

const TypeRow& row_of(Type type) { return kTypes[static_cast<std::size_t>(type)]; }

struct Word {
  std::string_view text;
  std::size_t offset = 0;
};

class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, const std::string& file)
      : text_(bytes.substr(0, kMaxHeaderBytes)), file_(file), whole_file_(bytes.size() <= kMaxHeaderBytes) {}

  Header run() {
    if (!next_line() || words_.size() != 1 || words_[0].text != "ply")
      fail_at_offset(file_, text_, 0, "not a PLY file: the first line is not 'ply'");
    bool has_line = next_line();
    while (has_line && says_nothing()) has_line = next_line();
    if (!has_line || words_.empty() || words_[0].text != "format")
      fail_here("expected 'format' as the second line of a PLY file");
    read_format();
    while (true) {
      if (!next_line())
        fail_here(whole_file_ ? "the file ends before its header does: 'end_header' is missing"
                              : "the header does not end within its first 65536 bytes: 'end_header' is missing");
      if (words_.empty() || says_nothing()) continue;
      if (words_[0].text == "end_header") break;
      read_declaration();
    }
    header_.size = next_;
    return std::move(header_);
  }

 private:
  bool says_nothing() const { return !words_.empty() && (words_[0].text == "comment" || words_[0].text == "obj_info"); }

  /// Splits the next line into words; false when there is no whole line left.
  bool next_line() {
    line_ = next_;
    words_.clear();
    const std::size_t end = text_.find('\n', line_);
    if (end == std::string_view::npos) return false;
    next_ = end + 1;
    constexpr std::string_view kSpace = " \t\r";
    for (std::size_t at = text_.find_first_not_of(kSpace, line_); at < end;) {
      const std::size_t stop = std::min(text_.find_first_of(" \t\r\n", at), end);
      words_.push_back({text_.substr(at, stop - at), at});
      at = text_.find_first_not_of(kSpace, stop);
    }
    return true;
  }

  [[noreturn]] void fail_here(const std::string& message) const { fail_at_offset(file_, text_, line_, message); }
  [[noreturn]] void fail(const Word& word, const std::string& message) const {
    fail_at_offset(file_, text_, word.offset, message);
  }

  /// Throws unless the line has `count` words; `form` is the expected form.
  void expect_words(std::size_t count, const std::string& form) const {
    if (words_.size() > count) fail(words_[count], "unexpected " + in_quotes(words_[count].text) + " after " + form);
    if (words_.size() < count) fail_here("the line ends early, expected " + form);
  }

  void read_format() {
    expect_words(3, "'format <encoding> 1.0'");
    const std::array<std::pair<const char*, Format>, 3> formats{{{"ascii", Format::ascii},
                                                                 {"binary_little_endian", Format::little_endian},
                                                                 {"binary_big_endian", Format::big_endian}}};
    const auto* const found = std::find_if(formats.begin(), formats.end(),
                                           [&](const auto& format) { return format.first == words_[1].text; });
    if (found == formats.end())
      fail(words_[1], "format " + in_quotes(words_[1].text) +
                          " is not known, expected ascii, binary_little_endian or binary_big_endian");
    header_.format = found->second;
    if (words_[2].text != "1.0")
      fail(words_[2], "version " + in_quotes(words_[2].text) + " is not known, expected 1.0");
  }

  void read_declaration() {
    const Word& keyword = words_[0];
    if (keyword.text == "element") {
      read_element();
    } else if (keyword.text == "property") {
      read_property();
    } else {
      const std::vector<std::string> known = {"element", "property", "comment", "obj_info", "end_header"};
      fail(keyword, in_quotes(keyword.text) + " is not known in a PLY header" +
                        did_you_mean(std::string(keyword.text), known) + ", expected " + join_or(known));
    }
  }

  void read_element() {
    expect_words(3, "'element <name> <count>'");
    const std::string name(words_[1].text);
    for (const Element& element : header_.elements)
      if (element.name == name) fail(words_[1], "a second element " + in_quotes(name));
    const auto count = parse_integer(words_[2].text);
    if (!count.value || *count.value < 0)
      fail(words_[2], "the count of element " + in_quotes(name) + " is " + in_quotes(words_[2].text) +
                          ", expected a whole number from 0");
    header_.elements.push_back({name, static_cast<std::uint64_t>(*count.value), {}, line_});
  }

  void read_property() {
    if (header_.elements.empty()) fail(words_[0], "a property before the first element");
    Property property;
    property.offset = line_;
    const bool is_list = words_.size() > 1 && words_[1].text == "list";
    if (is_list) {
      expect_words(5, "'property list <count type> <type> <name>'");
      property.count_type = type_of(words_[2]);
      if (is_floating(*property.count_type))
        fail(words_[2], "a list's count is of type " + in_quotes(words_[2].text) + ", expected an integer type");
    } else {
      expect_words(3, "'property <type> <name>'");
    }
    property.type = type_of(words_[words_.size() - 2]);
    property.name = words_.back().text;
    Element& element = header_.elements.back();
    for (const Property& known : element.properties)
      if (known.name == property.name)
        fail(words_.back(), "a second property " + in_quotes(property.name) + " of element " + in_quotes(element.name));
    element.properties.push_back(std::move(property));
  }

  Type type_of(const Word& word) const {
    std::vector<std::string> names;
    for (const TypeRow& row : kTypes) {
      if (word.text == row.name || word.text == row.sized_name) return row.type;
      names.emplace_back(row.name);
    }
    fail(word, "type " + in_quotes(word.text) + " is not known" + did_you_mean(std::string(word.text), names) +
                   ", expected " + join_or(names));
  }

  std::string_view text_;
  const std::string& file_;
  bool whole_file_;
  std::size_t line_ = 0;  // where the current line starts
  std::size_t next_ = 0;  // where the next one does
  std::vector<Word> words_;
  Header header_;
};

}  // namespace

std::size_t size_of(Type type) { return row_of(type).size; }

const char* name_of(Type type) { return row_of(type).name; }

Header read_header(std::string_view bytes, const std::string& file) { return HeaderReader(bytes, file).run(); }

}  // namespace photonproof::ply
