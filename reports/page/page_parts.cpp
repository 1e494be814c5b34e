#include "reports/page/page_parts.h"

#include <stdexcept>

#include "reports/view/text.h"

namespace photonproof::reports::inline reports_page {
namespace {

using kainjow::mustache::data;

/// "0aff" as two bytes.
std::string bytes_of_hex(std::string_view hex) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    bytes += static_cast<char>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16));
  }
  return bytes;
}

}  // namespace

void set_style_and_script(data& page, const std::string& style, std::string_view script, std::string_view sha256) {
  page.set("style", style);
  page.set("script", std::string(script));
  page.set("script_hash", base64(bytes_of_hex(sha256)));
}

void set_partial(data& page, const std::string& name, std::string_view text) {
  page.set(name, data(kainjow::mustache::partial([text] { return std::string(text); })));
}

std::string rendered_page(std::string_view layout, data& page) {
  kainjow::mustache::mustache mustache{std::string(layout)};
  std::string html = mustache.render(page);
  if (!mustache.is_valid()) throw std::logic_error("page template: " + mustache.error_message());
  return html;
}

}  // namespace photonproof::reports::inline reports_page
