#include "scenes/ellipsoids/ellipsoid_cloud.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "scenes/base/text_numbers.h"
#include "scenes/base/text_position.h"
#include "scenes/meshes/ply_header.h"
#include "scenes/meshes/ply_values.h"

namespace photonproof::inline scenes_ellipsoids {
namespace {

constexpr std::array<const char*, 6> kFirst{"x", "y", "z", "nx", "ny", "nz"};
constexpr std::array<const char*, 7> kLast{"scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"};
constexpr std::size_t kFew = kFirst.size() + kLast.size();

/// Neighbouring properties between kFirst and kLast.
struct Columns {
  std::size_t first = 0, count = 0;
};

/// The part of a name before its last underscore; the whole name without one.
std::string_view prefix_of(std::string_view name) { return name.substr(0, name.rfind('_')); }

/// The place of the opacities and harmonics among the properties of a row.
class CloudLayout {
 public:
  CloudLayout(const ply::Header& header, std::string_view bytes, const std::string& file)
      : text_(bytes.substr(0, header.size)), file_(file) {
    if (header.elements.empty()) throw InputError(file, "has no elements, expected ellipsoids");
    element_ = &header.elements.front();
    check_frame();
    const auto& all = properties();
    is_splatting_ = all.size() > kFew && all[kFirst.size()].name == "f_dc_0" && name_before_last() == "opacity";
    if (is_splatting_) {
      opacity_ = Columns{all.size() - kLast.size() - 1, 1};
      harmonics_ = Columns{kFirst.size(), all.size() - kFew - 1};
    } else {
      opacity_ = columns_of("opacities");
      harmonics_ = columns_of("sh_coeffs");
    }
    if (opacity_ && opacity_->count != 1)
      fail(opacity_->first, "'opacities' has " + std::to_string(opacity_->count) + " values, expected one");
    if (harmonics_) check_harmonics();
  }

  const std::vector<ply::Property>& properties() const { return element_->properties; }
  const ply::Element& element() const { return *element_; }
  bool is_splatting() const { return is_splatting_; }
  const std::optional<Columns>& opacity() const { return opacity_; }
  const std::optional<Columns>& harmonics() const { return harmonics_; }

 private:
  const std::string& name_before_last() const { return properties()[properties().size() - kLast.size() - 1].name; }

  [[noreturn]] void fail(std::size_t property, const std::string& what) const {
    fail_at_offset(file_, text_, properties()[property].offset, what);
  }

  void check_frame() const {
    const auto& all = properties();
    if (all.size() < kFew)
      fail_at_offset(file_, text_, element_->offset,
                     "element " + in_quotes(element_->name) + " has " + std::to_string(all.size()) +
                         " properties, expected x y z nx ny nz ... scale_0 to scale_2, rot_0 to rot_3");
    const auto expect = [&](std::size_t i, const std::string& name) {
      if (all[i].name != name) fail(i, "property " + in_quotes(all[i].name) + " stands in the place of '" + name + "'");
    };
    for (std::size_t i = 0; i < kFirst.size(); ++i) expect(i, kFirst[i]);
    for (std::size_t i = 0; i < kLast.size(); ++i) expect(all.size() - kLast.size() + i, kLast[i]);
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i].count_type || !is_floating(all[i].type))
        fail(i, "property " + in_quotes(all[i].name) + " is not of type float or double");
    if (element_->count == 0) fail_at_offset(file_, text_, element_->offset, "has no ellipsoids, expected one or more");
  }

  std::optional<Columns> columns_of(std::string_view attribute) const {
    const auto& all = properties();
    std::optional<Columns> found;
    for (std::size_t i = kFirst.size(); i < all.size() - kLast.size(); ++i) {
      if (prefix_of(all[i].name) != attribute) continue;
      if (!found) found = Columns{i, 0};
      if (i != found->first + found->count)
        fail(i, "property " + in_quotes(all[i].name) + " is apart from the others of '" + std::string(attribute) + "'");
      ++found->count;
    }
    return found;
  }

  void check_harmonics() const {
    for (std::size_t degree = 0; degree <= kMostHarmonicDegree; ++degree)
      if (harmonics_->count == 3 * (degree + 1) * (degree + 1)) return;
    fail(harmonics_->first, "there are " + std::to_string(harmonics_->count) +
                                " values of spherical harmonics, expected 3, 12, 27, 48 or another 3 n^2 up to 243");
  }

  std::string_view text_;
  const std::string& file_;
  const ply::Element* element_ = nullptr;
  bool is_splatting_ = false;
  std::optional<Columns> opacity_, harmonics_;
};

template <class Values>
class CloudReader {
 public:
  CloudReader(Values in, const CloudLayout& layout) : in_(in), layout_(layout), row_(layout.properties().size()) {}

  EllipsoidCloud run() {
    const std::size_t count = layout_.element().count;
    cloud_.ellipsoids.reserve(count);
    if (layout_.opacity()) cloud_.opacities.reserve(count);
    if (layout_.harmonics()) {
      cloud_.coefficients = layout_.harmonics()->count / 3;
      cloud_.harmonics.reserve(count * cloud_.coefficients);
    }
    in_.row.element = &layout_.element().name;
    for (in_.row.number = 0; in_.row.number < count; ++in_.row.number) {
      for (std::size_t i = 0; i < row_.size(); ++i) row_[i] = value(layout_.properties()[i].type);
      cloud_.ellipsoids.push_back(ellipsoid());
      if (layout_.opacity()) cloud_.opacities.push_back(opacity());
      if (layout_.harmonics()) add_harmonics();
    }
    return std::move(cloud_);
  }

 private:
  float value(ply::Type type) {
    const double number = in_.number(type);
    if (!(std::abs(number) <= double{std::numeric_limits<float>::max()}))
      in_.fail("has the value " + format_number(number) + ", expected finite numbers that fit single precision");
    return static_cast<float>(number);
  }

  Ellipsoid ellipsoid() const {
    const float* last = &row_[row_.size() - kLast.size()];
    Ellipsoid made;
    made.center = {row_[0], row_[1], row_[2]};
    made.scale = {scale(last[0]), scale(last[1]), scale(last[2])};
    double norm = 0;
    for (std::size_t i = 3; i < 7; ++i) norm += double{last[i]} * double{last[i]};
    norm = std::sqrt(norm);
    if (!(norm > 0)) in_.fail("has a rotation of length 0, expected a quaternion");
    for (std::size_t i = 0; i < 4; ++i) made.turn[i] = static_cast<float>(double{last[i == 3 ? 3 : i + 4]} / norm);
    return made;
  }

  /// As Mitsuba, at least 1e-6.
  float scale(float logarithm) const {
    const double size = std::exp(double{logarithm});
    if (!(size <= double{std::numeric_limits<float>::max()}))
      in_.fail("has the scale e^" + format_number(double{logarithm}) + ", expected one that fits single precision");
    return static_cast<float>(std::max(size, 1e-6));
  }

  float opacity() const {
    const float given = row_[layout_.opacity()->first];
    if (layout_.is_splatting()) return static_cast<float>(std::max(1 / (1 + std::exp(-double{given})), 1e-8));
    if (!(given >= 0 && given <= 1))
      in_.fail("has the opacity " + format_number(double{given}) + ", expected from 0 to 1");
    return given;
  }

  void add_harmonics() {
    const float* given = &row_[layout_.harmonics()->first];
    const std::size_t rest = cloud_.coefficients - 1;
    for (std::size_t i = 0; i < cloud_.coefficients; ++i) {
      if (i == 0 || !layout_.is_splatting())
        cloud_.harmonics.emplace_back(given[3 * i], given[3 * i + 1], given[3 * i + 2]);
      else
        cloud_.harmonics.emplace_back(given[2 + i], given[2 + i + rest], given[2 + i + 2 * rest]);
    }
  }

  Values in_;
  const CloudLayout& layout_;
  std::vector<float> row_;
  EllipsoidCloud cloud_;
};

template <class Values>
EllipsoidCloud read(Values in, const CloudLayout& layout, std::string_view header, const std::string& file) {
  const ply::Element& element = layout.element();
  std::size_t least = 0;
  for (const ply::Property& property : element.properties) least += Values::least_bytes(property.type);
  if (element.count > in.remaining() / least)
    fail_at_offset(file, header, element.offset,
                   "element " + in_quotes(element.name) + " has " + std::to_string(element.count) +
                       " rows of at least " + std::to_string(least) +
                       " bytes each, more than the rest of the file: it is truncated or its header is wrong");
  return CloudReader<Values>(in, layout).run();
}

}  // namespace

EllipsoidCloud parse_ellipsoids(std::string_view bytes, const std::string& file) {
  const ply::Header header = ply::read_header(bytes, file);
  const CloudLayout layout(header, bytes, file);
  const std::string_view text = bytes.substr(0, header.size);
  switch (header.format) {
    case ply::Format::ascii:
      return read(ply::TextValues(file, bytes, header.size), layout, text, file);
    case ply::Format::little_endian:
      return read(ply::BinaryValues<false>(file, bytes, header.size), layout, text, file);
    default:
      return read(ply::BinaryValues<true>(file, bytes, header.size), layout, text, file);
  }
}

}  // namespace photonproof::inline scenes_ellipsoids
