// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "message/request.hpp"
#include "web/access.hpp"
#include "web/fleet_link.hpp"
#include "web/http.hpp"
#include "web/hub.hpp"
#include "web/map_store.hpp"

namespace cornerd::web {

/// From a request's header and body to what is answered.
class Router {
 public:
  enum class Kind {
    kRefused,   ///< `response` says why, or is a preflight's; the body is not read
    kPage,      ///< answer() on the thread of the hub
    kWork,      ///< work() on any thread, since it may block
    kEvents,    ///< a stream of `classes`
    kFoxglove,  ///< a WebSocket
  };
  struct Decision {
    Kind kind = Kind::kRefused;
    Response response = {};
    message::ClassSet classes = {};
    std::size_t max_body_bytes = 0;
  };

  Router(AccessRules rules, const std::filesystem::path& control_socket,
         const std::filesystem::path& maps, const Hub& hub,
         std::unique_ptr<const FleetLink> fleet = nullptr);

  /// By the header alone.
  Decision decide(const Request& request) const;
  /// `request`: of /api/fleet or /api/fleet/map.
  Response answer_fleet(const Request& request) const;
  Response answer(const Request& request, Hub::Clock::time_point now) const;
  Response work(const Request& request) const;
  /// One request line of the control socket; blocks.
  Response ask(const std::string& line) const;
  bool may_change(const Request& request) const { return web::may_change(request, rules_); }

 private:
  AccessRules rules_;
  std::filesystem::path control_socket_;
  MapStore maps_;
  const Hub& hub_;
  std::unique_ptr<const FleetLink> fleet_;                             ///< null without a broker
  std::shared_ptr<const void> recordings_ = std::make_shared<char>();  ///< an owner each
};

/// "POSE,SCAN" as a set. Empty: POSE, STATUS and EVENT. `unknown`: an unknown name, where there is
/// one.
message::ClassSet classes_from(std::string_view comma_separated, std::string* unknown = nullptr);

}  // namespace cornerd::web
