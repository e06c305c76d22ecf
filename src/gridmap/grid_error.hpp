// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

namespace cornerd::gridmap {

/// A picture or a description of one that is wrong. what() is the reason alone.
class GridError : public std::runtime_error {
 public:
  /// `pointer`: where, as a JSON pointer into the description; empty for a picture.
  explicit GridError(const std::string& reason, std::string pointer = {})
      : std::runtime_error(reason), pointer_(std::move(pointer)) {}

  const std::string& pointer() const { return pointer_; }

 private:
  std::string pointer_;
};

}  // namespace cornerd::gridmap
