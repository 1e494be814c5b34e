#include "scenes/parser/expand.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>

#include "scenes/base/edit_distance.h"
#include "scenes/base/text_numbers.h"
#include "scenes/base/utf8.h"
#include "scenes/dialect/upgrade.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::scene_xml {
namespace {

namespace fs = std::filesystem;

struct Value {
  std::string text;
  bool from_command_line = false;
  bool used = false;
};

class Expander {
 public:
  Expander(Sources& sources, SceneFolders& folders, const ParseOptions& options)
      : sources_(sources), folders_(folders) {
    for (const auto& [name, text] : options.defines) {
      if (!is_name(name))
        throw InputError("-D " + printable(name), in_quotes(name) + " is not a name, expected letters, digits and _");
      if (find_invalid_utf8(text) != std::string::npos || std::any_of(text.begin(), text.end(), is_control_character))
        throw InputError("-D " + name, "the value " + in_quotes(text) + " is not printable UTF-8 text");
      values_[name] = {text, true, false};
    }
  }

  Element run(int file) {
    std::error_code ignored;
    open_files_.push_back(fs::weakly_canonical(sources_.name(file), ignored));
    Element root = read_root(file);
    expand_children(root, 1);
    check_defines();
    return root;
  }

 private:
  Element read_root(int file) {
    Element root = parse_xml(sources_, file, elements_);
    if (root.tag != "scene")
      sources_.fail(root.at, "the root element is <" + root.tag + ">, expected <scene version=\"3.0.0\">");
    for (Attribute& attribute : root.attributes) substitute(attribute);
    check_attributes(sources_, root, {"version", "id"});
    const Attribute& version = require(sources_, root, "version");
    check_version(version);
    if (version.value[0] < '2') upgrade_names(root);
    return root;
  }

  void check_version(const Attribute& version) const {
    const std::string& text = version.value;
    const bool digits_and_dots = text.find_first_not_of("0123456789.") == std::string::npos;
    const bool shaped = digits_and_dots && text.find("..") == std::string::npos && text.size() >= 3 &&
                        text.size() <= 20 && text[1] == '.' && text.back() != '.' &&
                        std::count(text.begin(), text.end(), '.') <= 2;
    if (!shaped || text[0] > '3')
      fail_at(sources_, version, "version " + in_quotes(text) + " is not supported, expected 0.x to 3.x");
  }

  void expand_children(Element& parent, int depth) {
    if (depth > kMaxNesting)
      sources_.fail(parent.at, "elements are nested more than " + std::to_string(kMaxNesting) + " deep");
    std::vector<Element> expanded;
    for (Element& child : parent.children) {
      for (Attribute& attribute : child.attributes) substitute(attribute);
      if (child.tag == "default") {
        define_default(child);
      } else if (child.tag == "include") {
        std::vector<Element> included = include(child, depth);
        std::move(included.begin(), included.end(), std::back_inserter(expanded));
      } else if (child.tag == "path" && parent.tag == "scene") {
        add_folder(child);
      } else {
        expand_children(child, depth + 1);
        expanded.push_back(std::move(child));
      }
    }
    parent.children = std::move(expanded);
  }

  void check_leaf(const Element& element) const {
    if (!element.children.empty())
      sources_.fail(element.children.front().at, "<" + element.tag + "> cannot contain elements");
  }

  void define_default(const Element& element) {
    check_attributes(sources_, element, {"name", "value"});
    check_leaf(element);
    const Attribute& name = require(sources_, element, "name");
    const Attribute& value = require(sources_, element, "value");
    if (!is_name(name.value))
      fail_at(sources_, name, in_quotes(name.value) + " is not a name, expected letters, digits and _");
    values_.try_emplace(name.value, Value{value.value, false, false});  // the first one counts, -D before all
  }

  void add_folder(const Element& element) {
    check_attributes(sources_, element, {"value"});
    check_leaf(element);
    if (++paths_ > kMaxFolders) sources_.fail(element.at, "more than " + std::to_string(kMaxFolders) + " of <path>");
    folders_.add(require(sources_, element, "value"));
  }

  static bool is_name(const std::string& text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), is_name_byte);
  }

  static bool is_name_byte(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

  /// Replaces `$name` by its value and `\$` by a dollar sign.
  void substitute(Attribute& attribute) {
    const std::string source = attribute.value;
    if (source.find('$') == std::string::npos) return;
    std::string result;
    for (std::size_t i = 0; i < source.size();) {
      if (source[i] == '\\' && i + 1 < source.size() && source[i + 1] == '$') {
        result += '$';
        i += 2;
      } else if (source[i] == '$') {
        const auto begin = source.begin() + static_cast<std::ptrdiff_t>(i) + 1;
        const std::string name(begin, std::find_if_not(begin, source.end(), is_name_byte));
        result += value_of(name, attribute);
        i += 1 + name.size();
      } else {
        result += source[i++];
      }
      if (substituted_bytes_ + result.size() > kMaxSubstitutedBytes)
        sources_.fail(attribute.at, "the scene's values grow past " + std::to_string(kMaxSubstitutedBytes) +
                                        " bytes when their $names are replaced");
    }
    substituted_bytes_ += result.size();
    attribute.raw = source;
    attribute.value = std::move(result);
  }

  const std::string& value_of(const std::string& name, const Attribute& attribute) {
    const auto found = values_.find(name);
    if (found == values_.end())
      sources_.fail(attribute.at, in_quotes("$" + name) + " is not defined" + did_you_mean(name, names()) +
                                      ", expected a <default> before it or -D " + name + "=...");
    found->second.used = true;
    return found->second.text;
  }

  std::vector<std::string> names(bool of_command_line_too = true) const {
    std::vector<std::string> result;
    for (const auto& [name, value] : values_)
      if (of_command_line_too || !value.from_command_line) result.push_back(name);
    return result;
  }

  void check_defines() const {
    for (const auto& [name, value] : values_)
      if (value.from_command_line && !value.used)
        throw InputError("-D " + name, "the scene has no " + in_quotes("$" + name) + did_you_mean(name, names(false)));
  }

  std::vector<Element> include(const Element& element, int depth) {
    check_attributes(sources_, element, {"filename"});
    check_leaf(element);
    const Attribute& filename = require(sources_, element, "filename");
    if (++includes_ > kMaxIncludes)
      sources_.fail(element.at, "more than " + std::to_string(kMaxIncludes) + " includes");
    const SceneFolders::File found = folders_.find_included(filename);
    if (std::find(open_files_.begin(), open_files_.end(), found.real) != open_files_.end())
      fail_at(sources_, filename, in_quotes(filename.value) + " includes itself");
    const int file = sources_.add(found.shown.string(), read_included(found.shown, filename));
    open_files_.push_back(found.real);
    Element root = read_root(file);
    expand_children(root, depth + 1);
    open_files_.pop_back();
    return std::move(root.children);
  }

  std::string read_included(const fs::path& path, const Attribute& filename) const {
    try {
      return read_file(path, kMaxFileBytes);
    } catch (const InputError& error) {
      fail_at(sources_, filename, "cannot include " + error.summary());
    }
  }

  Sources& sources_;
  SceneFolders& folders_;
  std::map<std::string, Value> values_;
  std::vector<fs::path> open_files_;
  std::size_t includes_ = 0;
  std::size_t paths_ = 0;
  std::size_t elements_ = 0;
  std::size_t substituted_bytes_ = 0;
};

}  // namespace

Element expand_scene(Sources& sources, int file, SceneFolders& folders, const ParseOptions& options) {
  return Expander(sources, folders, options).run(file);
}

}  // namespace photonproof::scene_xml
