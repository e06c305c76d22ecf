// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

namespace cornerd::web {

/// One file of the page, embedded at build.
struct PageFile {
  std::string_view path;  ///< "/" or "/name.js"
  std::string_view content_type;
  std::string_view content;
};

std::span<const PageFile> page_files();

}  // namespace cornerd::web
