// Values as spelt in single elements: numbers, colours, points, transforms.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/base/vec.h"
#include "scenes/description/transform.h"
#include "scenes/xml/xml_source.h"

namespace photonproof::scene_xml {

/// The number in `text`, a part of the attribute; errors are thrown there and call it `what`.
double number_in(const Sources& sources, const Attribute& attribute, std::string_view text, const std::string& what);
/// The number in an attribute; throws there.
double number_of(const Sources& sources, const Attribute& attribute);

/// `count` numbers in an attribute, between white space or commas.
std::vector<double> numbers_of(const Sources& sources, const Attribute& attribute,
                               std::initializer_list<std::size_t> counts);

/// The x, y, z attributes, or the one or three numbers of a `value` attribute. A missing x, y or z is `missing`, or an
/// error without it.
Vec3d xyz_of(const Sources& sources, const Element& element, std::optional<double> missing);

/// "a, b, c", one value for all three, or "#rrggbb" decoded from sRGB to linear.
RgbD rgb_of(const Sources& sources, const Attribute& attribute);

/// The product of a <transform>'s children; the first child is applied first.
Transform transform_of(const Sources& sources, const Element& element);

}  // namespace photonproof::scene_xml
