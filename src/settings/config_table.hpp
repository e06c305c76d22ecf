// SPDX-License-Identifier: MIT
// The table of all config keys. It makes the reader, `--check`, the list of what takes a restart,
// the refusal of schema 1's pointers, config/cornerd.full.json and config/keys.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "settings/config.hpp"
#include "settings/object_reader.hpp"

namespace cornerd::settings {

/// A member of a Config as its key sees it.
struct Value {
  /// Takes the key from its object. Throws SettingsError.
  std::function<void(ObjectReader& object, std::string_view key)> read;
  std::function<nlohmann::ordered_json()> write;
  std::string limits;  ///< for people: "0 to 99"
};

enum class Applies : std::uint8_t { kOnReload, kOnRestart };

struct Key {
  std::string pointer;
  Value value;  ///< without a reader: the pointer is a section, which has nothing but a text
  std::string text;
  Applies applies = Applies::kOnReload;
  std::string old{};  ///< schema 1's pointer, where it is not this one without "/advanced"

  bool is_section() const { return !value.read; }
  /// Schema 1's pointer; empty where the key kept its own.
  std::string old_pointer() const;
};

/// In the order of the documentation: the keys of a section follow each other. The values refer to
/// `config`, which must outlive them.
std::vector<Key> config_table(Config& config);
/// Its part below /advanced/detector.
void add_detector_keys(std::vector<Key>& table, core::DetectorConfig& config);

Value number(double& member, double low, double high, std::string_view unit = {});
Value boolean(bool& member);
Value text(std::string& member);
Value path(std::filesystem::path& member);
Value socket_path(std::filesystem::path& member);
Value named_maps(std::vector<NamedMap>& maps);
Value baud_rate(std::uint32_t& baud);
/// A number, or "max", which is 0.
Value replay_speed(double& speed);
Value motor(rplidar::MotorConfig& config);
Value sensor_bias(core::SensorBias& bias);
Value sigma_table(core::SigmaTable& table);
Value wall_model(calibration::WallModel& model);
/// Of a range's sigma, metres. With a sigma of 0 one return would outweigh all others.
inline constexpr Interval kSigmaM = {1e-5, 1};

template <typename Integer>
Value integer(Integer& member, std::type_identity_t<Integer> low,
              std::type_identity_t<Integer> high) {
  return {[&member, low, high](ObjectReader& object, std::string_view key) {
            object.integer(key, member, low, high);
          },
          [&member] { return nlohmann::ordered_json(member); },
          std::to_string(low) + " to " + std::to_string(high)};
}

/// `choices`: of static storage.
template <typename T, std::size_t kCount>
Value choice(T& member, const Choice<T> (&choices)[kCount]) {
  std::string names;
  for (const Choice<T>& each : choices) {
    names += (names.empty() ? "\"" : ", \"") + std::string(each.name) + '"';
  }
  return {[&member, &choices](ObjectReader& object, std::string_view key) {
            object.choice(key, member, choices);
          },
          [&member, &choices] {
            std::string_view name;
            for (const Choice<T>& each : choices) {
              if (each.value == member) name = each.name;
            }
            return nlohmann::ordered_json(name);
          },
          names};
}

}  // namespace cornerd::settings
