// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace cornerd::tool {

/// What is wrong with an XML document without comments, processing instructions and CDATA; empty
/// where it is well formed: one root, tags that match, quoted attributes, known entities.
std::string find_xml_error(std::string_view document);

/// How often `element` is opened.
std::size_t count_elements(std::string_view document, std::string_view element);

}  // namespace cornerd::tool
