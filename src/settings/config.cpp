// SPDX-License-Identifier: MIT
#include "settings/config.hpp"

#include <algorithm>
#include <set>

#include "settings/config_table.hpp"
#include "settings/document.hpp"

namespace cornerd::settings {
namespace {

constexpr std::string_view kAdvanced = "/advanced";

/// A pointer of schema 1 that has no successor.
struct RemovedKey {
  std::string_view pointer;
  std::string_view reason;
};
constexpr std::string_view kBaseline = "removed: cornerd-bench measures the paper's methods";
constexpr RemovedKey kRemoved[] = {{"/detector/method", "removed; cornerctl detect has --method"},
                                   {"/detector/printed_altbd", kBaseline},
                                   {"/detector/abd_iepf", kBaseline},
                                   {"/detector/lt", kBaseline},
                                   {"/localizer/recognition", kBaseline},
                                   {"/odometry/mode", kBaseline},
                                   {"/odometry/factors", kBaseline},
                                   {"/odometry/dead_band", kBaseline}};

bool is_below(std::string_view pointer, std::string_view section) {
  return pointer.size() > section.size() && pointer.starts_with(section) &&
         pointer[section.size()] == '/';
}

class ConfigReader {
 public:
  ConfigReader(const DocumentContext& context, const std::vector<Key>& table)
      : context_(context), table_(table) {}

  void read(const Json& document) const {
    refuse_old_keys(document, "");
    read_section({context_, document, ""}, "");
  }

  [[noreturn]] void fail(const std::string& pointer, const std::string& reason) const {
    throw SettingsError(context_.file.string(), pointer, reason);
  }

 private:
  void refuse_old_keys(const Json& object, const std::string& parent) const {
    if (!object.is_object()) return;
    for (const auto& [name, value] : object.items()) {
      const std::string pointer = child_pointer(parent, name);
      if (pointer == kAdvanced) continue;
      for (const RemovedKey& key : kRemoved) {
        if (key.pointer == pointer) fail(pointer, std::string(key.reason));
      }
      bool is_old_section = false;
      bool is_section = false;
      for (const Key& key : table_) {
        const std::string old = key.old_pointer();
        if (old == pointer) fail(pointer, "moved; write " + key.pointer + " instead");
        is_old_section |= is_below(old, pointer);
        is_section |= is_below(key.pointer, pointer);
      }
      refuse_old_keys(value, pointer);
      if (is_old_section && !is_section) {
        fail(pointer, "moved; write " + std::string(kAdvanced) + pointer + " instead");
      }
    }
  }

  void read_section(ObjectReader object, const std::string& section) const {
    std::set<std::string_view> subsections;
    for (const Key& key : table_) {
      if (!is_below(key.pointer, section)) continue;
      std::string_view name = key.pointer;
      name.remove_prefix(section.size() + 1);
      const std::size_t slash = name.find('/');
      if (slash == std::string_view::npos && !key.is_section()) {
        key.value.read(object, name);
        continue;
      }
      name = name.substr(0, slash);
      if (!subsections.insert(name).second) continue;
      read_section(object.object(name), child_pointer(section, name));
    }
    object.finish();
  }

  const DocumentContext& context_;
  const std::vector<Key>& table_;
};

/// Where there are several maps, "map" is the name of one; it was read as a path.
void choose_map(Config& config, const ConfigReader& reader) {
  if (config.map.empty()) return;
  if (config.maps.empty()) {
    if (config.map.filename() == kAutoMap) {
      reader.fail("/map", "\"auto\" chooses one of \"maps\", and there are none");
    }
    return;
  }
  config.map_name = config.map.filename();
  const std::filesystem::path* file = file_of(config.maps, config.map_name);
  if (file == nullptr) {
    reader.fail("/map", "must be \"auto\" or a name of \"maps\": " + names_of(config.maps));
  }
  config.map = *file;
}

/// Checks that involve more than one key.
void check(const Config& config, const ConfigReader& reader, bool require_map) {
  if (require_map && config.map.empty()) {
    reader.fail("/map", "is missing; it is the only key without a default");
  }
  const LidarConfig& lidar = config.lidar;
  if (lidar.max_range_m <= lidar.min_range_m) {
    reader.fail("/advanced/lidar/max_range",
                "must be more than min_range, " + to_text(lidar.min_range_m));
  }
  if (lidar.driver == DriverKind::kReplay && lidar.file.empty()) {
    reader.fail("/lidar/file", "is missing; the driver \"replay\" plays it");
  }
  const std::int64_t counter_max = config.odometry.core.geometry.counter_max;
  if (counter_max == 1 || counter_max == 2) {
    reader.fail("/advanced/odometry/counter_max",
                "must be 0 (never wraps) or at least 3: a smaller counter does not tell forward "
                "from back");
  }
  const drivers::KernelOdometryConfig& kernel = config.odometry.kernel;
  if (kernel.left.counter == kernel.right.counter && kernel.left.count == kernel.right.count) {
    reader.fail("/advanced/odometry/kernel/right", "must not be the same as left");
  }
  if (config.socket.pose == config.socket.control) {
    reader.fail("/socket/control", "must not be the same as pose");
  }
}

}  // namespace

const std::filesystem::path* file_of(std::span<const NamedMap> maps, std::string_view name) {
  if (name == kAutoMap && !maps.empty()) return &maps.front().file;
  const auto found =
      std::find_if(maps.begin(), maps.end(), [&](const NamedMap& map) { return map.name == name; });
  return found != maps.end() ? &found->file : nullptr;
}

std::string names_of(std::span<const NamedMap> maps) {
  std::string names;
  for (const NamedMap& map : maps) names += (names.empty() ? "" : ", ") + map.name;
  return names;
}

std::string Key::old_pointer() const {
  if (!old.empty()) return old;
  return is_below(pointer, kAdvanced) && !is_section() ? pointer.substr(kAdvanced.size())
                                                       : std::string();
}

core::LocalizerConfig Config::localizer() const {
  core::LocalizerConfig config;
  config.min_range_m = lidar.min_range_m;
  config.max_range_m = lidar.max_range_m;
  config.T_base_lidar = {lidar.mount.x_m, lidar.mount.y_m,
                         core::normalize_angle(lidar.mount.theta_rad)};
  config.detector = detector;
  config.updates_per_scan = updates_per_scan;
  config.search_nodes_per_scan = core::kSearchInRealTime;
  config.noise = lidar.noise.sensor;
  config.bias = lidar.bias;
  config.calibrate_online = lidar.calibrate_online;
  config.learn_walls = learn_walls;
  config.odometry = odometry.core;
  return config;
}

Config parse_config(std::string_view text, const std::filesystem::path& file,
                    const std::vector<std::string>& overrides, bool require_map,
                    const drivers::LidarModel* model) {
  DocumentContext context{.file = file};
  if (!file.empty()) context.folder = std::filesystem::absolute(file).parent_path();
  Json document = parse_document(text, file);
  for (const std::string& override_text : overrides) {
    context.overridden.insert(apply_override(document, override_text));
  }
  Config config;
  const std::vector<Key> table = config_table(config);
  const ConfigReader reader(context, table);
  reader.read(document);
  const DriverKind driver = config.lidar.driver;
  if (model == nullptr || model->driver != driver) model = drivers::first_lidar_model(driver);
  if (model != nullptr && model != drivers::first_lidar_model(DriverKind::kRplidar)) {
    // The driver is known only now: its noise, and what the config says of it over that.
    config.lidar.noise.sensor = model->noise();
    reader.read(document);
  }
  choose_map(config, reader);
  check(config, reader, require_map);
  OdometryConfig& odometry = config.odometry;
  odometry.core.enabled = odometry.source != OdometrySource::kNone;
  // The driver reads each counter's own maximum.
  if (odometry.source == OdometrySource::kKernel) odometry.core.geometry.counter_max = 0;
  if (odometry.kernel.gyro.device == "none") odometry.kernel.gyro.device.clear();
  return config;
}

Config load_config(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                   FileKind kind) {
  return parse_config(read_file(file, kMaxConfigBytes, kind), file, overrides);
}

std::string needs_restart(Config before, Config now) {
  const std::vector<Key> old_table = config_table(before);
  const std::vector<Key> new_table = config_table(now);
  std::string list;
  for (std::size_t i = 0; i < old_table.size(); ++i) {
    const Key& key = old_table[i];
    if (key.applies != Applies::kOnRestart) continue;
    if (key.value.write() == new_table[i].value.write()) continue;
    list += (list.empty() ? "" : ", ") + key.pointer;
  }
  return list;
}

}  // namespace cornerd::settings
