// Typed parameter lists of pbrt's directives: "float fov" 45 "rgb L" [ 1 2 3 ].
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/base/vec.h"
#include "scenes/pbrt/sources.h"
#include "scenes/pbrt/tokens.h"

namespace photonproof::inline scenes_pbrt {

/// The colour space that the directive ColorSpace names.
enum class PbrtColours { srgb, rec2020, dci_p3 };

struct PbrtParameter {
  std::string type, name;
  Place at;
  std::vector<double> numbers;
  std::vector<std::string> strings;
  std::vector<bool> booleans;
  PbrtColours colours = PbrtColours::srgb;
};

/// A directive's parameters. Whoever reads them asks for each by name; the rest is refused by `finish`.
class PbrtParameters {
 public:
  PbrtParameters(const PbrtSources& sources, std::string what, Place at)
      : sources_(&sources), what_(std::move(what)), at_(at) {}

  /// Reads the list up to the next directive. Throws InputError where a value is not of its type.
  void read(PbrtTokens& tokens, PbrtColours colours);
  /// Takes those of a directive Attribute that are not given here.
  void add_defaults(const std::vector<PbrtParameter>& others);
  const std::vector<PbrtParameter>& all() const { return list_; }

  /// The parameter of this name and one of these types; counts as read.
  const PbrtParameter* find(std::string_view name, std::initializer_list<std::string_view> types) const;
  bool has(std::string_view name) const;
  double number(std::string_view name, double fallback) const;
  /// The same between two bounds, or an error.
  double number(std::string_view name, double fallback, double least, double most) const;
  int integer(std::string_view name, int fallback, int least, int most) const;
  bool boolean(std::string_view name, bool fallback) const;
  std::string text(std::string_view name, const std::string& fallback) const;
  Vec3d point(std::string_view name, const Vec3d& fallback) const;
  std::vector<double> numbers(std::string_view name, std::initializer_list<std::string_view> types) const;
  /// Counts these as read: they do not change what an image converges to.
  void ignore(std::initializer_list<std::string_view> names) const;
  /// Throws where a parameter was not read.
  void finish() const;

  [[noreturn]] void fail(const std::string& message) const { sources_->fail(at_, what_ + ": " + message); }
  [[noreturn]] void fail(const PbrtParameter& parameter, const std::string& message) const;
  const Place& at() const { return at_; }
  const std::string& what() const { return what_; }

 private:
  void read_values(PbrtTokens& tokens, PbrtParameter& parameter) const;
  void read_value(const PbrtToken& token, PbrtParameter& parameter) const;

  const PbrtSources* sources_;
  std::string what_;  ///< the directive and its type, for messages
  Place at_;
  std::vector<PbrtParameter> list_;
  mutable std::vector<char> read_;  ///< of each, whether it was asked for
};

}  // namespace photonproof::inline scenes_pbrt
