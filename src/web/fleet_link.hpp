// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "mqtt/broker.hpp"
#include "mqtt/fleet.hpp"
#include "mqtt/map_announcement.hpp"

namespace cornerd::web {

/// The robots of a site and its maps, as the broker has them. For any thread.
class FleetLink {
 public:
  /// Throws std::runtime_error without libmosquitto.
  FleetLink(const mqtt::BrokerConfig& broker, const std::string& site);

  /// {"connected", "problem", "maps": [{"name", "version"}], "robots": [reports with "age"]}.
  std::string robots_json() const;
  /// MAP of the site's map of this name; empty if it has none that is whole.
  std::string map_line(const std::string& name) const;

 private:
  /// Bounds the memory that the maps of a hostile broker take.
  static constexpr std::size_t kMaxMaps = 8;

  struct SiteMap {
    mqtt::MapAnnouncement announcement;
    std::string line;  ///< empty until its bytes have come
  };
  void follow(const std::stop_token& stop);
  void take(const mqtt::Message& message);
  void take_announcement(const mqtt::Message& message);

  const std::string site_;
  mutable std::mutex mutex_;  ///< of the next two
  mqtt::Fleet fleet_;
  std::map<std::string, SiteMap> maps_;
  mqtt::Broker broker_;
  std::jthread follower_;
};

}  // namespace cornerd::web
