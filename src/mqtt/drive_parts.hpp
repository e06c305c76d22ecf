// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mqtt/broker_link.hpp"

namespace cornerd::mqtt {

/// Ten minutes of an A1.
inline constexpr std::size_t kMaxDriveBytes = 64 * 1024 * 1024;

/// A recording as retained messages: `cornerd/SITE/drive/ROBOT/NAME` says how many parts and which
/// SHA-256, `.../NAME/0` and so on are the bytes. `name`: of the file, a level of a topic.
std::vector<Message> drive_messages(const std::string& site, const std::string& robot,
                                    const std::string& name, std::string_view bytes);

/// Puts the drives of one robot together again.
class DriveParts {
 public:
  DriveParts(const std::string& site, const std::string& robot)
      : start_("cornerd/" + site + "/drive/" + robot + "/") {}

  std::string filter() const { return start_ + "#"; }
  void take(const Message& message);

  struct Drive {
    std::string name;
    std::string bytes;
  };
  /// Complete, and of the SHA-256 that was said; by name.
  std::vector<Drive> whole() const;
  /// Names of the others.
  std::vector<std::string> incomplete() const;

 private:
  struct Parts {
    std::size_t count = 0;  ///< 0: not said yet
    std::string sha256;
    std::map<std::size_t, std::string> parts;
  };
  static std::optional<Drive> assembled(const std::string& name, const Parts& parts);

  std::string start_;
  std::map<std::string, Parts> drives_;
  std::size_t bytes_ = 0;
};

}  // namespace cornerd::mqtt
