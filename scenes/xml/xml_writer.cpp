#include "scenes/xml/xml_writer.h"

#include "scenes/base/text_numbers.h"

namespace photonproof::inline scenes_xml {
namespace {

/// For a double-quoted attribute: XML's own characters, white space (which a reader would turn into blanks), and the
/// dollar sign, which would start a `$name`.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\t':
      case '\n':
      case '\r':
        out += "&#" + std::to_string(int{c}) + ";";
        break;
      case '$':
        out += "\\$";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string list(std::initializer_list<double> values) {
  std::string text;
  for (const double v : values) text += (text.empty() ? "" : ", ") + format_number(v);
  return text;
}

}  // namespace

void XmlWriter::tag(const std::string& name, const Attributes& attributes, const char* end) {
  out_.append(2 * open_.size(), ' ');
  out_ += "<" + name;
  for (const auto& [key, value] : attributes) out_ += " " + key + "=\"" + escaped(value) + "\"";
  out_ += std::string(end) + "\n";
}

void XmlWriter::open(const std::string& name, const Attributes& attributes) {
  tag(name, attributes, ">");
  open_.push_back(name);
}

void XmlWriter::close() {
  const std::string name = open_.back();
  open_.pop_back();
  out_.append(2 * open_.size(), ' ');
  out_ += "</" + name + ">\n";
}

void XmlWriter::leaf(const std::string& name, const Attributes& attributes) { tag(name, attributes, "/>"); }

void XmlWriter::open_plugin(const std::string& kind, const std::string& type, const std::string& id,
                            const std::string& name) {
  Attributes attributes = {{"type", type}};
  if (!id.empty()) attributes.emplace_back("id", id);
  if (!name.empty()) attributes.emplace_back("name", name);
  open(kind, attributes);
}

void XmlWriter::number(const std::string& name, double v) { value("float", name, format_number(v)); }

void XmlWriter::rgb(const std::string& name, const RgbD& c) { value("rgb", name, list({c.x, c.y, c.z})); }

void XmlWriter::point(const std::string& name, const Vec3d& p) { value("point", name, list({p.x, p.y, p.z})); }

void XmlWriter::transform(const std::string& name, const Transform& t) {
  if (t == Transform()) return;
  std::string entries;
  for (const double entry : t.m) entries += (entries.empty() ? "" : " ") + format_number(entry);
  open("transform", {{"name", name}});
  leaf("matrix", {{"value", entries}});
  close();
}

}  // namespace photonproof::inline scenes_xml
