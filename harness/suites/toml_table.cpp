#include "harness/suites/toml_table.h"

#include <cmath>
#include <set>
#include <sstream>

#include "harness/suites/toml_library.h"
#include "scenes/base/edit_distance.h"

namespace photonproof::inline harness_suites {
namespace {

struct Document {
  std::string file;
  std::vector<std::string> lines;
  toml::table root;

  InputError error(const toml::source_position& place, const std::string& message) const {
    const auto line = static_cast<std::size_t>(place.line);
    return {file, static_cast<int>(place.line), static_cast<int>(place.column), message,
            line >= 1 && line <= lines.size() ? lines[line - 1] : std::string{}};
  }
};

std::vector<std::string> split_lines(std::string_view text) {
  std::vector<std::string> lines;
  std::istringstream in{std::string(text)};
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::string type_name(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a float";
    case toml::node_type::boolean:
      return "a boolean";
    default:
      return "a date or time";
  }
}

}  // namespace

struct TomlTable::View {
  std::shared_ptr<const Document> document;
  const toml::table* table = nullptr;
  std::set<std::string> asked{};

  const toml::node& node(const std::string& key) {
    asked.insert(key);
    const toml::node* found = table->get(key);
    if (found == nullptr) throw document->error(table->source().begin, "'" + key + "' is missing");
    return *found;
  }
  InputError wrong_type(const std::string& key, const toml::node& found, const std::string& expected) const {
    return document->error(found.source().begin, "'" + key + "' must be " + expected + ", not " + type_name(found));
  }
  std::string string(const std::string& key, const toml::node& value) const {
    if (!value.is_string()) throw wrong_type(key, value, "a string");
    const std::string& text = value.as_string()->get();
    if (text.empty()) throw document->error(value.source().begin, "'" + key + "' must not be empty");
    return text;
  }
  std::int64_t integer(const std::string& key, const toml::node& value) const {
    if (!value.is_integer()) throw wrong_type(key, value, "an integer");
    return value.as_integer()->get();
  }
  double number(const std::string& key, const toml::node& value) const {
    const std::optional<double> number = value.is_number() ? value.value<double>() : std::nullopt;
    if (!number || !std::isfinite(*number)) throw wrong_type(key, value, "a finite number");
    return *number;
  }
  const toml::array& array(const std::string& key, const toml::node& value, const std::string& of) const {
    if (!value.is_array()) throw wrong_type(key, value, "an array of " + of);
    return *value.as_array();
  }
  std::vector<std::string> strings(const std::string& key, const toml::node& value) const {
    std::vector<std::string> list;
    for (const toml::node& element : array(key, value, "strings")) list.push_back(string(key, element));
    return list;
  }
};

TomlTable TomlTable::parse(std::string_view text, const std::string& file) {
  auto document = std::make_shared<Document>();
  document->file = file;
  document->lines = split_lines(text);
  try {
    document->root = toml::parse(text, file);
  } catch (const toml::parse_error& problem) {
    throw document->error(problem.source().begin, "not valid TOML: " + std::string(problem.description()));
  }
  auto view = std::make_shared<View>();
  view->table = &document->root;
  view->document = std::move(document);
  return TomlTable(std::move(view));
}

std::string TomlTable::string(const std::string& key) const { return view_->string(key, view_->node(key)); }

std::int64_t TomlTable::integer(const std::string& key) const { return view_->integer(key, view_->node(key)); }

double TomlTable::number(const std::string& key) const { return view_->number(key, view_->node(key)); }

bool TomlTable::boolean(const std::string& key) const {
  const toml::node& value = view_->node(key);
  if (!value.is_boolean()) throw view_->wrong_type(key, value, "true or false");
  return value.as_boolean()->get();
}

std::vector<double> TomlTable::numbers(const std::string& key) const {
  std::vector<double> list;
  for (const toml::node& element : view_->array(key, view_->node(key), "numbers"))
    list.push_back(view_->number(key, element));
  return list;
}

std::vector<std::string> TomlTable::strings(const std::string& key) const {
  return view_->strings(key, view_->node(key));
}

std::vector<std::int64_t> TomlTable::integers(const std::string& key) const {
  std::vector<std::int64_t> list;
  for (const toml::node& element : view_->array(key, view_->node(key), "integers"))
    list.push_back(view_->integer(key, element));
  return list;
}

std::vector<std::vector<std::string>> TomlTable::string_lists(const std::string& key) const {
  std::vector<std::vector<std::string>> lists;
  for (const toml::node& element : view_->array(key, view_->node(key), "arrays of strings"))
    lists.push_back(view_->strings(key, element));
  return lists;
}

TomlTable TomlTable::table(const std::string& key) const {
  const toml::node& value = view_->node(key);
  if (!value.is_table()) throw view_->wrong_type(key, value, "a table");
  return TomlTable(std::make_shared<View>(View{view_->document, value.as_table()}));
}

bool TomlTable::is_array(const std::string& key) const { return view_->node(key).is_array(); }

bool TomlTable::is_string(const std::string& key) const { return view_->node(key).is_string(); }

bool TomlTable::is_integer(const std::string& key) const { return view_->node(key).is_integer(); }

int TomlTable::line() const { return static_cast<int>(view_->table->source().begin.line); }

std::vector<std::string> TomlTable::keys() const {
  std::vector<std::string> names;
  for (const auto& [key, value] : *view_->table) names.emplace_back(key.str());
  return names;
}

bool TomlTable::has(const std::string& key) const {
  view_->asked.insert(key);
  return view_->table->contains(key);
}

std::vector<TomlTable> TomlTable::tables(const std::string& key) const {
  std::vector<TomlTable> list;
  if (!has(key)) return list;
  for (const toml::node& element : view_->array(key, view_->node(key), "tables")) {
    if (!element.is_table()) throw view_->wrong_type(key, element, "an array of tables");
    list.push_back(TomlTable(std::make_shared<View>(View{view_->document, element.as_table()})));
  }
  return list;
}

void TomlTable::expect_no_other_keys() const {
  for (const auto& [key, value] : *view_->table) {
    if (view_->asked.count(std::string(key.str())) != 0) continue;
    const std::string name(key.str());
    std::string known;
    for (const std::string& other : view_->asked) known += (known.empty() ? "" : ", ") + other;
    throw view_->document->error(key.source().begin,
                                 "unknown key '" + name + "'" +
                                     did_you_mean(name, {view_->asked.begin(), view_->asked.end()}) +
                                     "; known here: " + known);
  }
}

InputError TomlTable::error(const std::string& key, const std::string& message) const {
  return view_->document->error(view_->node(key).source().begin, message);
}

InputError TomlTable::error(const std::string& key, std::size_t index, const std::string& message) const {
  return view_->document->error(view_->node(key).as_array()->at(index).source().begin, message);
}

InputError TomlTable::error(const std::string& message) const {
  return view_->document->error(view_->table->source().begin, message);
}

}  // namespace photonproof::inline harness_suites
