#include "scenes/params.h"

#include <algorithm>
#include <array>

#include "scenes/edit_distance.h"
#include "scenes/text_numbers.h"
#include "scenes/values.h"

namespace photonproof::scene_xml {
namespace {

const std::vector<std::string>& tags_of(ParamType type) {
  static const std::map<ParamType, std::vector<std::string>> table = {{ParamType::boolean, {"boolean"}},
                                                                      {ParamType::integer, {"integer"}},
                                                                      {ParamType::number, {"float", "integer"}},
                                                                      {ParamType::string, {"string"}},
                                                                      {ParamType::ior, {"float", "integer", "string"}},
                                                                      {ParamType::colour, {"rgb", "spectrum", "float"}},
                                                                      {ParamType::point, {"point", "vector"}},
                                                                      {ParamType::transform, {"transform"}}};
  return table.at(type);
}

std::string in_brackets(const std::vector<std::string>& tags) {
  std::vector<std::string> shown;
  shown.reserve(tags.size());
  for (const std::string& tag : tags) shown.push_back("<" + tag + ">");
  return join_or(shown);
}

std::string lower(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

}  // namespace

bool is_parameter_tag(std::string_view tag) {
  constexpr std::array<std::string_view, 9> kTags = {"boolean", "float",    "integer", "point",    "rgb",
                                                     "string",  "spectrum", "vector",  "transform"};
  return std::find(kTags.begin(), kTags.end(), tag) != kTags.end();
}

Params::Params(const Sources& sources, const Element& object, std::string title, const std::vector<ParamSpec>& specs)
    : sources_(sources), object_(object), title_(std::move(title)) {
  for (const Element& child : object.children)
    if (is_parameter_tag(child.tag)) add(child, specs);
}

void Params::add(const Element& parameter, const std::vector<ParamSpec>& specs) {
  const Attribute& name = require(sources_, parameter, "name");
  const auto spec = std::find_if(specs.begin(), specs.end(), [&](const ParamSpec& s) { return s.name == name.value; });
  if (spec == specs.end()) {
    std::vector<std::string> names;
    names.reserve(specs.size());
    for (const ParamSpec& known : specs) names.push_back(known.name);
    fail_at(sources_, name,
            title_ + " has no parameter " + in_quotes(name.value) + did_you_mean(name.value, names) + ", expected " +
                join_or(names));
  }
  const auto& tags = tags_of(spec->type);
  if (std::find(tags.begin(), tags.end(), parameter.tag) == tags.end())
    sources_.fail(parameter.at, "parameter '" + spec->name + "' of " + title_ + " is <" + parameter.tag +
                                    ">, expected " + in_brackets(tags));
  if (!given_.emplace(name.value, &parameter).second)
    fail_at(sources_, name, "parameter '" + spec->name + "' of " + title_ + " is given twice");
  if (spec->type == ParamType::point)
    check_attributes(sources_, parameter, {"name", "x", "y", "z", "value"});
  else if (spec->type == ParamType::transform)
    check_attributes(sources_, parameter, {"name"});
  else
    check_attributes(sources_, parameter, {"name", "value"});
  if (spec->type != ParamType::transform && !parameter.children.empty())
    sources_.fail(parameter.children.front().at, "<" + parameter.tag + "> cannot contain elements");
}

const Element* Params::read(const std::string& name) {
  read_.insert(name);
  const auto found = given_.find(name);
  return found == given_.end() ? nullptr : found->second;
}

std::string Params::tag(const std::string& name) const {
  const auto found = given_.find(name);
  return found == given_.end() ? "" : found->second->tag;
}

void Params::fail(const std::string& name, const std::string& message) const {
  const std::string text = "parameter '" + name + "' of " + title_ + " " + message;
  const auto found = given_.find(name);
  if (found == given_.end()) sources_.fail(object_.at, text);
  const Attribute* value = found->second->find("value");
  if (!value) sources_.fail(found->second->at, text);
  fail_at(sources_, *value, text);
}

bool Params::boolean(const std::string& name, bool fallback) {
  const Element* element = read(name);
  if (!element) return fallback;
  const std::string value = lower(require(sources_, *element, "value").value);
  expect(value == "true" || value == "false", name, "is " + in_quotes(value) + ", expected true or false");
  return value == "true";
}

std::int64_t Params::integer(const std::string& name, std::int64_t fallback, std::int64_t low, std::int64_t high) {
  const Element* element = read(name);
  if (!element) return fallback;
  const auto parsed = parse_integer(require(sources_, *element, "value").value);
  if (!parsed.value) fail(name, parsed.problem);
  expect(*parsed.value >= low && *parsed.value <= high, name,
         "is " + std::to_string(*parsed.value) + ", expected " + std::to_string(low) + " to " + std::to_string(high));
  return *parsed.value;
}

double Params::number(const std::string& name, double fallback) {
  const Element* element = read(name);
  if (!element) return fallback;
  const auto parsed = parse_number(require(sources_, *element, "value").value);
  if (!parsed.value) fail(name, parsed.problem);
  return *parsed.value;
}

double Params::positive(const std::string& name, double fallback) {
  const double value = number(name, fallback);
  expect(static_cast<float>(value) > 0, name, "is " + format_number(value) + ", expected more than 0");
  return value;
}

std::string Params::string(const std::string& name, const std::string& fallback) {
  const Element* element = read(name);
  return element ? require(sources_, *element, "value").value : fallback;
}

RgbD Params::colour(const std::string& name, const RgbD& fallback, double low, double high) {
  const Element* element = read(name);
  if (!element) return fallback;
  const Attribute& value = require(sources_, *element, "value");
  if (element->tag == "spectrum" && value.value.find(':') != std::string::npos)
    fail(name, "is a spectrum over wavelengths, which is not supported, expected one number or <rgb>");
  const RgbD colour = element->tag == "rgb" ? rgb_of(sources_, value) : RgbD(number_of(sources_, value));
  for (const double c : {colour.x, colour.y, colour.z}) {
    const std::string range = high < std::numeric_limits<double>::infinity()
                                  ? "from " + format_number(low) + " to " + format_number(high)
                                  : "at least " + format_number(low);
    expect(c >= low && c <= high, name, "has the component " + format_number(c) + ", expected " + range);
  }
  return colour;
}

Vec3d Params::point(const std::string& name, const Vec3d& fallback) {
  const Element* element = read(name);
  return element ? xyz_of(sources_, *element, std::nullopt) : fallback;
}

Transform Params::transform(const std::string& name) {
  const Element* element = read(name);
  return element ? transform_of(sources_, *element) : Transform();
}

void Params::finish() const {
  for (const auto& [name, element] : given_)
    if (!read_.count(name)) {
      const Attribute& attribute = require(sources_, *element, "name");
      fail_at(sources_, attribute, "parameter '" + name + "' of " + title_ + " has no effect here");
    }
}

}  // namespace photonproof::scene_xml
