#include "reference/cycles/python_text.h"

#include "scenes/base/text_numbers.h"

namespace photonproof::inline reference_cycles {

std::string py_tuple(const std::vector<std::string>& parts) {
  std::string text = "(";
  for (const std::string& part : parts) text += (text.size() == 1 ? "" : ", ") + part;
  return text + (parts.size() == 1 ? ",)" : ")");
}

std::string py_tuple(const Vec3d& v) { return py_tuple({format_number(v.x), format_number(v.y), format_number(v.z)}); }

std::string py_columns(const Transform& t) {
  return py_tuple(std::vector<std::string>{py_tuple(t.vector({1, 0, 0})), py_tuple(t.vector({0, 1, 0})),
                                           py_tuple(t.vector({0, 0, 1})), py_tuple(t.point({0, 0, 0}))});
}

std::string py_string(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c >= ' ' && c <= '~' ? c : '?';
  }
  return result + "\"";
}

}  // namespace photonproof::inline reference_cycles
