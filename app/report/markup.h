// Text escaped for HTML and SVG, and bytes as base64.
#pragma once

#include <string>
#include <string_view>

namespace pl {

/// With & < > and quotes replaced, so that names of files and scenes cannot end an element or an attribute.
std::string escape_markup(std::string_view text);

/// [RFC 4648, section 4]
std::string base64(std::string_view bytes);

}  // namespace pl
