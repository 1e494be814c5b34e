// Scene XML as text. Numbers are the shortest text that reads back as the same double.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "scenes/base/vec.h"
#include "scenes/description/transform.h"

namespace photonproof::inline scenes_xml {

class XmlWriter {
 public:
  using Attributes = std::vector<std::pair<std::string, std::string>>;

  /// "<name ...>", closed by close().
  void open(const std::string& name, const Attributes& attributes);
  void close();
  /// "<name .../>"
  void leaf(const std::string& name, const Attributes& attributes);

  /// "<kind type=... id=... name=...>", the last two unless empty.
  void open_plugin(const std::string& kind, const std::string& type, const std::string& id,
                   const std::string& name = "");

  void string(const std::string& name, const std::string& text) { value("string", name, text); }
  void number(const std::string& name, double v);
  void integer(const std::string& name, std::int64_t v) { value("integer", name, std::to_string(v)); }
  void boolean(const std::string& name, bool v) { value("boolean", name, v ? "true" : "false"); }
  void rgb(const std::string& name, const RgbD& c);
  void point(const std::string& name, const Vec3d& p);
  /// Writes nothing for the identity.
  void transform(const std::string& name, const Transform& t);

  std::string take() { return std::move(out_); }

 private:
  void tag(const std::string& name, const Attributes& attributes, const char* end);
  void value(const std::string& kind, const std::string& name, const std::string& text) {
    leaf(kind, {{"name", name}, {"value", text}});
  }

  std::string out_;
  std::vector<std::string> open_;
};

}  // namespace photonproof::inline scenes_xml
