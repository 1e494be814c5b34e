#include "scenes/xml/values.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include "scenes/base/edit_distance.h"
#include "scenes/base/srgb.h"
#include "scenes/base/text_numbers.h"

namespace photonproof::scene_xml {
namespace {

void check_leaf(const Sources& sources, const Element& element) {
  if (!element.children.empty())
    sources.fail(element.children.front().at, "<" + element.tag + "> cannot contain elements");
}

Vec3d vector_of(const Sources& sources, const Attribute& attribute) {
  const auto v = numbers_of(sources, attribute, {3});
  return {v[0], v[1], v[2]};
}

Transform translate_of(const Sources& sources, const Element& element) {
  check_attributes(sources, element, {"x", "y", "z", "value"});
  return Transform::translate(xyz_of(sources, element, 0.0));
}

Transform scale_of(const Sources& sources, const Element& element) {
  check_attributes(sources, element, {"x", "y", "z", "value"});
  return Transform::scale(xyz_of(sources, element, 1.0));
}

Transform rotate_of(const Sources& sources, const Element& element) {
  check_attributes(sources, element, {"x", "y", "z", "value", "angle"});
  const double degrees = number_of(sources, require(sources, element, "angle"));
  const Vec3d axis = xyz_of(sources, element, 0.0);
  if (axis == Vec3d(0.0)) sources.fail(element.at, "the rotation axis is zero, expected x, y or z");
  return Transform::rotate(axis, degrees);
}

/// The first tangent of Duff et al. 2017, "Building an orthonormal basis, revisited", which Mitsuba takes for `up`
/// where a lookat has none.
Vec3d perpendicular_to(const Vec3d& n) {
  const double sign = std::copysign(1.0, n.z), a = -1 / (sign + n.z);
  return {1 + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x};
}

Transform look_at_of(const Sources& sources, const Element& element) {
  check_attributes(sources, element, {"origin", "target", "up"});
  const Vec3d origin = vector_of(sources, require(sources, element, "origin"));
  const Vec3d target = vector_of(sources, require(sources, element, "target"));
  if (origin == target) sources.fail(element.at, "origin and target are the same point");
  const Attribute* given_up = element.find("up");
  Vec3d up = given_up ? vector_of(sources, *given_up) : Vec3d(0.0);
  if (up == Vec3d(0.0)) up = perpendicular_to(normalize(target - origin));
  const Vec3d across = cross(normalize(up), normalize(target - origin));
  if (!(length(across) > 1e-9)) sources.fail(element.at, "'up' is zero or parallel to the viewing direction");
  return Transform::look_at(origin, target, up);
}

Transform matrix_of(const Sources& sources, const Element& element) {
  check_attributes(sources, element, {"value"});
  const Attribute& value = require(sources, element, "value");
  const auto v = numbers_of(sources, value, {9, 16});
  Transform t;
  if (v.size() == 9) {
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) t.m[4 * r + c] = v[3 * r + c];
    return t;
  }
  std::copy(v.begin(), v.end(), t.m.begin());
  if (v[12] != 0 || v[13] != 0 || v[14] != 0 || v[15] != 1)
    fail_at(sources, value, "the matrix is not affine: its last row must be 0 0 0 1");
  return t;
}

struct Operation {
  std::string tag;
  Transform (*read)(const Sources&, const Element&);
};

const std::vector<Operation>& operations() {
  static const std::vector<Operation> table = {{"translate", translate_of},
                                               {"rotate", rotate_of},
                                               {"scale", scale_of},
                                               {"lookat", look_at_of},
                                               {"matrix", matrix_of}};
  return table;
}

}  // namespace

double number_in(const Sources& sources, const Attribute& attribute, std::string_view text, const std::string& what) {
  const auto parsed = parse_number(text);
  if (!parsed.value) fail_at(sources, attribute, what + " " + parsed.problem);
  return *parsed.value;
}

double number_of(const Sources& sources, const Attribute& attribute) {
  return number_in(sources, attribute, attribute.value, "attribute '" + attribute.name + "'");
}

std::vector<double> numbers_of(const Sources& sources, const Attribute& attribute,
                               std::initializer_list<std::size_t> counts) {
  const auto parts = split_list(attribute.value);
  if (std::find(counts.begin(), counts.end(), parts.size()) == counts.end()) {
    std::vector<std::string> expected;
    for (const std::size_t count : counts) expected.push_back(std::to_string(count));
    fail_at(sources, attribute,
            "attribute '" + attribute.name + "' has " + std::to_string(parts.size()) +
                (parts.size() == 1 ? " value" : " values") + ", expected " + join_or(expected));
  }
  std::vector<double> values;
  values.reserve(parts.size());
  for (const std::string_view part : parts)
    values.push_back(number_in(sources, attribute, part, "attribute '" + attribute.name + "'"));
  return values;
}

Vec3d xyz_of(const Sources& sources, const Element& element, std::optional<double> missing) {
  const Attribute* value = element.find("value");
  double xyz[3] = {0, 0, 0};
  const char* const names[3] = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i) {
    const Attribute* component = element.find(names[i]);
    if (component && value)
      fail_at(sources, *component, "both 'value' and 'x', 'y', 'z', expected one of the two forms");
    if (component)
      xyz[i] = number_of(sources, *component);
    else if (!missing && !value)
      require(sources, element, names[i]);
    else
      xyz[i] = missing.value_or(0);
  }
  if (!value) return {xyz[0], xyz[1], xyz[2]};
  const auto v = numbers_of(sources, *value, {1, 3});
  return v.size() == 1 ? Vec3d(v[0]) : Vec3d(v[0], v[1], v[2]);
}

RgbD rgb_of(const Sources& sources, const Attribute& attribute) {
  const auto parts = split_list(attribute.value);
  if (parts.size() != 1 || parts[0][0] != '#') {
    const auto v = numbers_of(sources, attribute, {1, 3});
    return v.size() == 1 ? RgbD(v[0]) : RgbD(v[0], v[1], v[2]);
  }
  const std::string digits(parts[0].substr(1));
  const bool hex = std::all_of(digits.begin(), digits.end(), [](unsigned char c) { return std::isxdigit(c) != 0; });
  if (digits.size() != 6 || !hex)
    fail_at(sources, attribute, in_quotes(parts[0]) + " is not a colour, expected #rrggbb");
  const auto channel = [&](std::size_t at) {
    return decode_srgb(std::stoi(digits.substr(at, 2), nullptr, 16) / 255.0);
  };
  return {channel(0), channel(2), channel(4)};
}

Transform transform_of(const Sources& sources, const Element& element) {
  Transform total;
  for (const Element& child : element.children) {
    const auto& table = operations();
    const auto row = std::find_if(table.begin(), table.end(), [&](const Operation& o) { return o.tag == child.tag; });
    if (row == table.end()) {
      std::vector<std::string> tags;
      tags.reserve(table.size());
      for (const Operation& operation : table) tags.push_back(operation.tag);
      sources.fail(child.at, "<" + child.tag + "> is not supported in <transform>" + did_you_mean(child.tag, tags) +
                                 ", expected " + join_or(tags));
    }
    check_leaf(sources, child);
    total = row->read(sources, child) * total;
    if (!std::all_of(total.m.begin(), total.m.end(), [](double v) { return std::isfinite(static_cast<float>(v)); }))
      sources.fail(child.at, "the transform overflows");
  }
  return total;
}

}  // namespace photonproof::scene_xml
