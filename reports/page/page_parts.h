// Common parts of all pages: style, the only permitted script, and templates inside templates.
#pragma once

#include <kainjow/mustache.hpp>
#include <string>
#include <string_view>

namespace photonproof::reports::inline reports_page {

/// Sets {style, script, script_hash}; `sha256` is in hexadecimal.
void set_style_and_script(kainjow::mustache::data& page, const std::string& style, std::string_view script,
                          std::string_view sha256);

/// Makes {{>name}} include the template `text`, which outlives the page.
void set_partial(kainjow::mustache::data& page, const std::string& name, std::string_view text);

/// The template filled with its data. Throws std::logic_error if the template is malformed.
std::string rendered_page(std::string_view layout, kainjow::mustache::data& page);

}  // namespace photonproof::reports::inline reports_page
