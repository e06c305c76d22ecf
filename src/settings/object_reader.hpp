// SPDX-License-Identifier: MIT
// Reads the keys of a JSON object into members, one call for each key. The value that a member has
// before the call is the default.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "settings/document.hpp"

namespace cornerd::settings {

/// Shared by all objects of one document.
struct DocumentContext {
  std::filesystem::path file;          ///< as errors name it
  std::filesystem::path folder{};      ///< of relative paths; empty: they stay as they are
  std::set<std::string> overridden{};  ///< pointers of values that did not come from the file
};

struct Interval {
  double low = 0;
  double high = 0;
  std::string_view unit{};  ///< for a message, after the numbers: " radians"
};

template <typename Value>
struct Choice {
  std::string_view name;
  Value value;
};

/// Every function throws SettingsError where the key is there and its value wrong; an absent key
/// leaves the member as it is. A reader that goes out of scope without finish() checks nothing.
class ObjectReader {
 public:
  ObjectReader(const DocumentContext& context, const Json& value, std::string pointer);

  bool number(std::string_view key, double& member, Interval limits);
  template <typename Integer>
  bool integer(std::string_view key, Integer& member, Integer low, Integer high) {
    double value = static_cast<double>(member);
    if (!number(key, value, {static_cast<double>(low), static_cast<double>(high)})) return false;
    member = static_cast<Integer>(value);
    if (static_cast<double>(member) != value) fail(key, "must be a whole number");
    return true;
  }
  bool boolean(std::string_view key, bool& member);
  bool text(std::string_view key, std::string& member, std::size_t max_bytes);
  /// Relative to the folder of the file; to the working directory where it was given elsewhere.
  bool path(std::string_view key, std::filesystem::path& member);
  template <typename Value, std::size_t kCount>
  bool choice(std::string_view key, Value& member, const Choice<Value> (&choices)[kCount]) {
    std::array<std::string_view, kCount> names;
    for (std::size_t i = 0; i < kCount; ++i) names[i] = choices[i].name;
    const Json* value = find(key);
    if (value == nullptr) return false;
    member = choices[find_name(key, *value, names)].value;
    return true;
  }

  /// The value itself, for other types; nullptr where the key is absent.
  const Json* find(std::string_view key);
  /// A nested object; an empty one where the key is absent.
  ObjectReader object(std::string_view key);
  ObjectReader element(std::string_view key, const Json& array, std::size_t index) const;

  /// Fails for a key that no call has named.
  void finish() const;

  [[noreturn]] void fail(std::string_view key, const std::string& reason) const;
  [[noreturn]] void fail(std::string_view key, std::size_t index, const std::string& reason) const;
  std::string pointer(std::string_view key) const { return child_pointer(pointer_, key); }

 private:
  std::size_t find_name(std::string_view key, const Json& value,
                        std::span<const std::string_view> names) const;

  const DocumentContext& context_;
  const Json& value_;
  std::string pointer_;
  std::vector<std::string> known_;
};

/// For messages: 0.15, 12, 1e+06.
std::string to_text(double value);

}  // namespace cornerd::settings
