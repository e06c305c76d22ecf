// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "web/http.hpp"

namespace cornerd::web {

/// A file name that leaves its folder in no way: letters, digits, `-`, `_`, `.`, at most 64.
bool is_map_name(std::string_view name);

/// Maps in a folder, one file NAME.json each. No file is ever replaced.
class MapStore {
 public:
  /// `folder`: empty if there is none.
  explicit MapStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// 200 with [{"name","file"}], sorted by name.
  Response list() const;
  /// 201, or 409 if the name is taken, 422 if the map is wrong.
  Response put(std::string_view name, const std::string& map) const;
  /// 200 with what the map has, or 422 with the reason.
  static Response check(const std::string& map);

 private:
  std::filesystem::path folder_;
};

}  // namespace cornerd::web
