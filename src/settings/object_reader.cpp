// SPDX-License-Identifier: MIT
#include "settings/object_reader.hpp"

#include <algorithm>
#include <charconv>
#include <numeric>

#include "settings/config.hpp"

namespace cornerd::settings {
namespace {

const Json kEmptyObject = Json::object();

/// Levenshtein distance.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, diagonal + 1, row[j] + 1});
    }
  }
  return row.back();
}

std::string list_of(std::span<const std::string_view> names, std::string_view quote) {
  std::string list;
  for (const std::string_view name : names) {
    if (!list.empty()) list += ", ";
    list.append(quote).append(name).append(quote);
  }
  return list;
}

/// A known key of a small edit distance, else the list of all.
std::string hint_for(std::string_view unknown, const std::vector<std::string>& known) {
  constexpr std::size_t kMaxTypoBytes = 64;
  if (unknown.size() <= kMaxTypoBytes) {
    std::size_t nearest = 1 + std::max<std::size_t>(unknown.size() / 3, 1);
    std::string_view nearest_key;
    for (const std::string& key : known) {
      const std::size_t distance = edit_distance(unknown, key);
      if (distance < nearest) {
        nearest = distance;
        nearest_key = key;
      }
    }
    if (!nearest_key.empty()) return "did you mean \"" + std::string(nearest_key) + "\"?";
  }
  std::vector<std::string_view> names(known.begin(), known.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return "known here: " + list_of(names, "");
}

}  // namespace

std::string to_text(double value) {
  std::array<char, 32> digits;
  return {digits.data(), std::to_chars(digits.begin(), digits.end(), value).ptr};
}

ObjectReader::ObjectReader(const DocumentContext& context, const Json& value, std::string pointer)
    : context_(context), value_(value), pointer_(std::move(pointer)) {
  if (!value_.is_object()) {
    throw SettingsError(context_.file.string(), pointer_, "must be an object");
  }
}

void ObjectReader::fail(std::string_view key, const std::string& reason) const {
  throw SettingsError(context_.file.string(), pointer(key), reason);
}

void ObjectReader::fail(std::string_view key, std::size_t index, const std::string& reason) const {
  throw SettingsError(context_.file.string(), child_pointer(pointer(key), std::to_string(index)),
                      reason);
}

const Json* ObjectReader::find(std::string_view key) {
  known_.emplace_back(key);
  const auto found = value_.find(known_.back());
  return found == value_.end() ? nullptr : &*found;
}

bool ObjectReader::number(std::string_view key, double& member, Interval limits) {
  const Json* value = find(key);
  if (value == nullptr) return false;
  if (!value->is_number()) fail(key, "must be a number");
  const double number = value->get<double>();
  if (!(number >= limits.low && number <= limits.high)) {
    fail(key, "must be from " + to_text(limits.low) + " to " + to_text(limits.high) +
                  std::string(limits.unit) + ", not " + to_text(number));
  }
  member = number;
  return true;
}

bool ObjectReader::boolean(std::string_view key, bool& member) {
  const Json* value = find(key);
  if (value == nullptr) return false;
  if (!value->is_boolean()) fail(key, "must be true or false");
  member = value->get<bool>();
  return true;
}

bool ObjectReader::text(std::string_view key, std::string& member, std::size_t max_bytes) {
  const Json* value = find(key);
  if (value == nullptr) return false;
  if (!value->is_string()) fail(key, "must be a string");
  const auto& text = value->get_ref<const std::string&>();
  if (text.empty()) fail(key, "must not be empty");
  if (text.size() > max_bytes) {
    fail(key, "must not be longer than " + std::to_string(max_bytes) + " bytes");
  }
  member = text;
  return true;
}

bool ObjectReader::path(std::string_view key, std::filesystem::path& member) {
  constexpr std::size_t kPathMax = 4095;
  std::string given;
  if (!text(key, given, kPathMax)) return false;
  if (given.find('\0') != std::string::npos) fail(key, "must not hold a zero byte");
  member = given;
  if (member.is_absolute()) return true;
  if (context_.overridden.contains(pointer(key))) {
    member = std::filesystem::absolute(member).lexically_normal();
  } else if (!context_.folder.empty()) {
    member = (context_.folder / member).lexically_normal();
  }
  return true;
}

ObjectReader ObjectReader::object(std::string_view key) {
  const Json* value = find(key);
  return {context_, value == nullptr ? kEmptyObject : *value, pointer(key)};
}

ObjectReader ObjectReader::element(std::string_view key, const Json& array,
                                   std::size_t index) const {
  return {context_, array[index], child_pointer(pointer(key), std::to_string(index))};
}

void ObjectReader::finish() const {
  for (const auto& [key, value] : value_.items()) {
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    fail(key, "unknown key; " + hint_for(key, known_));
  }
}

std::size_t ObjectReader::find_name(std::string_view key, const Json& value,
                                    std::span<const std::string_view> names) const {
  if (value.is_string()) {
    const auto found = std::find(names.begin(), names.end(), value.get_ref<const std::string&>());
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  }
  fail(key, (names.size() == 1 ? "must be " : "must be one of ") + list_of(names, "\""));
}

}  // namespace cornerd::settings
