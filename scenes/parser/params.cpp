#include "scenes/parser/params.h"

#include <algorithm>
#include <array>

#include "scenes/base/edit_distance.h"
#include "scenes/base/text_numbers.h"
#include "scenes/parser/plugins.h"
#include "scenes/parser/scene_objects.h"
#include "scenes/parser/spectrum_value.h"
#include "scenes/parser/typed_spectrum.h"
#include "scenes/xml/values.h"

namespace photonproof::scene_xml {
namespace {

/// Rec. 709, Mitsuba's digits.
double luminance(const RgbD& c) { return 0.212671 * c.x + 0.715160 * c.y + 0.072169 * c.z; }

const std::vector<std::string>& tags_of(ParamType type) {
  static const std::map<ParamType, std::vector<std::string>> table = {
      {ParamType::boolean, {"boolean"}},
      {ParamType::integer, {"integer"}},
      {ParamType::number, {"float", "integer"}},
      {ParamType::string, {"string"}},
      {ParamType::ior, {"float", "integer", "string"}},
      {ParamType::colour, {"rgb", "spectrum", "float"}},
      {ParamType::emission, {"rgb", "spectrum", "float"}},
      {ParamType::colour_map, {"rgb", "spectrum", "float", "texture"}},
      {ParamType::emission_map, {"rgb", "spectrum", "float", "texture"}},
      {ParamType::number_map, {"float", "integer", "rgb", "spectrum", "texture"}},
      {ParamType::texture, {"texture"}},
      {ParamType::volume, {"rgb", "spectrum", "float", "volume"}},
      {ParamType::point, {"point", "vector"}},
      {ParamType::transform, {"transform"}}};
  return table.at(type);
}

bool is_emission(ParamType type) { return type == ParamType::emission || type == ParamType::emission_map; }

std::string in_brackets(const std::vector<std::string>& tags) {
  std::vector<std::string> shown;
  shown.reserve(tags.size());
  for (const std::string& tag : tags) shown.push_back("<" + tag + ">");
  return join_or(shown);
}

std::string range(double low, double high) {
  return high < std::numeric_limits<double>::infinity() ? "from " + format_number(low) + " to " + format_number(high)
                                                        : "at least " + format_number(low);
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

Params::Params(SceneObjects& objects, const Element& object, std::string title, const std::vector<ParamSpec>& specs,
               const std::vector<NestedSpec>& nested)
    : objects_(objects), sources_(objects.sources()), object_(object), title_(std::move(title)) {
  for (const Element& child : object.children)
    objects.obstacles().attempt([&] {
      try {
        if (is_parameter_tag(child.tag))
          add(child, specs);
        else
          add_nested(child, specs, nested);
      } catch (const InputError& error) {
        if (const Attribute* name = child.find("name"); name && !given_twice(child)) refuse(name->value, error);
        throw;
      }
    });
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
  const std::string& tag = objects_.target(parameter).tag;
  if (std::find(tags.begin(), tags.end(), tag) == tags.end())
    sources_.fail(parameter.at,
                  "parameter '" + spec->name + "' of " + title_ + " is <" + tag + ">, expected " + in_brackets(tags));
  if (!given_.emplace(name.value, &parameter).second)
    fail_at(sources_, name, "parameter '" + spec->name + "' of " + title_ + " is given twice");
  if (is_emission(spec->type)) emissions_.insert(spec->name);
  if (tag == "texture" || tag == "volume") return;  // its own reader checks it
  if (spec->type == ParamType::point)
    check_attributes(sources_, parameter, {"name", "x", "y", "z", "value"});
  else if (spec->type == ParamType::transform)
    check_attributes(sources_, parameter, {"name"});
  else if (parameter.tag == "spectrum" && parameter.find("type"))
    return check_attributes(sources_, parameter, {"name", "type", "id"});  // its reader checks the rest
  else if (parameter.tag == "spectrum")
    check_attributes(sources_, parameter, {"name", "value", "filename"});
  else
    check_attributes(sources_, parameter, {"name", "value"});
  if (spec->type != ParamType::transform && !parameter.children.empty())
    sources_.fail(parameter.children.front().at, "<" + parameter.tag + "> cannot contain elements");
}

void Params::add_nested(const Element& child, const std::vector<ParamSpec>& specs,
                        const std::vector<NestedSpec>& nested) {
  const std::string& tag = objects_.target(child).tag;
  const auto spec = std::find_if(nested.begin(), nested.end(), [&](const NestedSpec& s) { return s.tag == tag; });
  const bool is_parameter =
      (tag == "texture" || tag == "volume") &&
      std::any_of(specs.begin(), specs.end(), [&](const ParamSpec& s) { return tags_of(s.type).back() == tag; });
  if (is_parameter && spec == nested.end()) return add(child, specs);
  if (spec == nested.end()) {
    std::vector<std::string> expected = {"parameters"}, tags;
    for (const NestedSpec& known : nested) {
      tags.push_back(known.tag);
      expected.push_back("<" + known.tag + ">");
    }
    const std::string found = child.tag == "ref"
                                  ? in_quotes(require(sources_, child, "id").value) + " is a <" + tag + ">, which"
                                  : "<" + tag + ">";
    sources_.fail(child.at, found + " is not supported in " + title_ + did_you_mean(tag, tags) + ", expected " +
                                join_or(expected));
  }
  std::vector<const Element*>& known = nested_[tag];
  if (known.size() == spec->most)
    sources_.fail(child.at,
                  title_ + (spec->most == 1 ? " has a second <" + tag + ">, expected one"
                                            : " has more than " + std::to_string(spec->most) + " of <" + tag + ">"));
  known.push_back(&child);
}

const Element& Params::only_nested(const std::string& tag) {
  if (nested(tag).empty()) sources_.fail(object_.at, title_ + " has no <" + tag + ">, expected one");
  return *nested(tag).front();
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

bool Params::given_twice(const Element& parameter) const {
  const auto found = given_.find(require(sources_, parameter, "name").value);
  return found != given_.end() && found->second != &parameter;
}

void Params::refuse(const std::string& name, const InputError& error) {
  given_.erase(name);
  refused_.emplace(name, error);
}

const Attribute& Params::value_of(const std::string& name) const {
  if (const auto refused = refused_.find(name); refused != refused_.end()) throw refused->second;
  return require(sources_, *given_.at(name), "value");
}

void Params::expect_given(const std::string& name, const std::string& what) const {
  if (const auto refused = refused_.find(name); refused != refused_.end()) throw refused->second;
  expect(has(name), name, "is missing, expected " + what);
}

template <class Value, class Read>
Value Params::value_or(const std::string& name, Value fallback, Read read_element) {
  read_.insert(name);
  const auto found = given_.find(name);
  if (found != given_.end()) objects_.obstacles().attempt([&] { fallback = read_element(*found->second); });
  return fallback;
}

bool Params::boolean(const std::string& name, bool fallback) {
  return value_or(name, fallback, [&](const Element& element) {
    const std::string value = lower(require(sources_, element, "value").value);
    expect(value == "true" || value == "false", name, "is " + in_quotes(value) + ", expected true or false");
    return value == "true";
  });
}

std::int64_t Params::integer(const std::string& name, std::int64_t fallback, std::int64_t low, std::int64_t high) {
  return value_or(name, fallback, [&](const Element& element) {
    const auto parsed = parse_integer(require(sources_, element, "value").value);
    if (!parsed.value) fail(name, parsed.problem);
    expect(*parsed.value >= low && *parsed.value <= high, name,
           "is " + std::to_string(*parsed.value) + ", expected " + std::to_string(low) + " to " + std::to_string(high));
    return *parsed.value;
  });
}

double Params::checked_number(const std::string& name, double fallback,
                              const std::function<void(double value)>& check) {
  return value_or(name, fallback, [&](const Element& element) {
    const auto parsed = parse_number(require(sources_, element, "value").value);
    if (!parsed.value) fail(name, parsed.problem);
    check(*parsed.value);
    return *parsed.value;
  });
}

double Params::number(const std::string& name, double fallback) {
  return checked_number(name, fallback, [](double) {});
}

double Params::positive(const std::string& name, double fallback) {
  return checked_number(name, fallback, [&](double value) {
    expect(static_cast<float>(value) > 0, name, "is " + format_number(value) + ", expected more than 0");
  });
}

std::string Params::string(const std::string& name, const std::string& fallback) {
  return value_or(name, fallback, [&](const Element& element) { return require(sources_, element, "value").value; });
}

double Params::number_in(const std::string& name, double fallback, double low, double high) {
  return checked_number(name, fallback, [&](double value) {
    expect(value >= low && value <= high, name, "is " + format_number(value) + ", expected " + range(low, high));
  });
}

RgbD Params::colour(const std::string& name, const RgbD& fallback, double low, double high) {
  return value_or(name, fallback, [&](const Element& element) {
    RgbD colour;
    if (element.tag == "spectrum" && element.find("type"))
      colour = typed_spectrum_of(objects_, element,
                                 emissions_.count(name) ? SpectrumKind::emission : SpectrumKind::reflectance, high);
    else if (element.tag == "spectrum")
      colour = spectrum_of(objects_, element,
                           emissions_.count(name) ? SpectrumKind::emission : SpectrumKind::reflectance, high);
    else if (element.tag == "rgb")
      colour = rgb_of(sources_, require(sources_, element, "value"));
    else
      colour = RgbD(number_of(sources_, require(sources_, element, "value")));
    for (const double c : {colour.x, colour.y, colour.z})
      expect(c >= low && c <= high, name, "has the component " + format_number(c) + ", expected " + range(low, high));
    return colour;
  });
}

bool Params::is_texture(const std::string& name) const {
  const auto found = given_.find(name);
  return found != given_.end() && objects_.target(*found->second).tag == "texture";
}

TextureIndex Params::texture_up_to(const std::string& name, double low, double high) {
  const TextureIndex index = *texture(name);
  const double most = objects_.largest_value(index);
  objects_.obstacles().attempt([&] {
    expect(most <= high, name, "has texels up to " + format_number(most) + ", expected " + range(low, high));
  });
  return index;
}

Colour Params::colour_map(const std::string& name, const RgbD& fallback, double low, double high) {
  if (!is_texture(name)) return colour(name, fallback, low, high);
  return texture_up_to(name, low, high);
}

Scalar Params::number_map(const std::string& name, double fallback, double low, double high) {
  if (is_texture(name)) return texture_up_to(name, low, high);
  return number_or_luminance(name, fallback, low, high);
}

double Params::number_or_luminance(const std::string& name, double fallback, double low, double high) {
  if (tag(name) != "rgb" && tag(name) != "spectrum") return number_in(name, fallback, low, high);
  const RgbD c = colour(name, RgbD(fallback), low, high);
  return luminance(c);
}

std::optional<TextureIndex> Params::texture(const std::string& name) {
  return value_or(name, std::optional<TextureIndex>(),
                  [&](const Element& element) { return std::optional(objects_.texture(element)); });
}

VolumeColour Params::volume(const std::string& name, const RgbD& fallback, double low, double high) {
  if (!is_volume(name)) return colour(name, fallback, low, high);
  return value_or(name, VolumeColour(fallback), [&](const Element& element) -> VolumeColour {
    VolumeColour volume = read_volume(objects_, objects_.target(element));
    const double largest = max_component(most(volume));
    expect(largest <= high, name, "has values up to " + format_number(largest) + ", expected " + range(low, high));
    return volume;
  });
}

bool Params::is_volume(const std::string& name) const {
  const auto found = given_.find(name);
  return found != given_.end() && objects_.target(*found->second).tag == "volume";
}

VolumeNumber Params::volume_number(const std::string& name, double fallback, double low, double high) {
  if (!is_volume(name)) return number_or_luminance(name, fallback, low, high);
  const VolumeColour given = volume(name, RgbD(fallback), low, high);
  if (const RgbD* constant = constant_of(given)) return luminance(*constant);
  const auto& grid = std::get<GridVolumeDescription>(given);
  expect(grid.grid->channels == 1, name, "has values of three channels, expected one");
  return grid;
}

Vec3d Params::point(const std::string& name, const Vec3d& fallback) {
  return value_or(name, fallback, [&](const Element& element) { return xyz_of(sources_, element, std::nullopt); });
}

Transform Params::transform(const std::string& name) {
  return value_or(name, Transform(), [&](const Element& element) { return transform_of(sources_, element); });
}

void Params::finish() const {
  for (const auto& given : given_)
    if (!read_.count(given.first))
      objects_.obstacles().attempt([&] {
        const Attribute& attribute = require(sources_, *given.second, "name");
        fail_at(sources_, attribute, "parameter '" + given.first + "' of " + title_ + " has no effect here");
      });
}

}  // namespace photonproof::scene_xml
