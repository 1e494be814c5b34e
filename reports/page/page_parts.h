// What every page has: style, a script that alone may run, and templates inside templates.
#pragma once

#include <kainjow/mustache.hpp>
#include <string>
#include <string_view>

namespace photonproof::reports::inline reports_page {

/// {style, script, script_hash} are set. `sha256` in hexadecimal.
void set_style_and_script(kainjow::mustache::data& page, const std::string& style, std::string_view script,
                          std::string_view sha256);

/// {{>name}} stands for the template `text`, which outlives the page.
void set_partial(kainjow::mustache::data& page, const std::string& name, std::string_view text);

/// The template with its data. Throws std::logic_error when the template is none.
std::string rendered_page(std::string_view layout, kainjow::mustache::data& page);

}  // namespace photonproof::reports::inline reports_page
