// SPDX-License-Identifier: MIT
// Boost.Beast, of server.cpp alone: its templates take long to compile. What is here has internal
// linkage, as that one source has.
#pragma once

#include <boost/asio/dispatch.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <string>

#include "web/hub.hpp"
#include "web/router.hpp"
#include "web/server.hpp"

namespace cornerd::web {

namespace net = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using net::ip::tcp;

/// Messages wait in the outbox, which drops old ones, rather than in the kernel, which does not.
constexpr int kSendBufferBytes = 64 * 1024;
constexpr int kMaxConnections = 64;

/// What all connections share.
struct Site {
  explicit Site(const ServerConfig& config)
      : router(config.access, config.control_socket, config.maps, hub,
               config.broker ? std::make_unique<const FleetLink>(*config.broker, config.site)
                             : nullptr) {}
  Hub hub;
  Router router;
  int connections = 0;
  // Destroyed first: sessions end with it, and they use the hub.
  net::io_context io{1};
  net::thread_pool workers{1};
};

/// Also as IPv6 has it, ::ffff:127.0.0.1.
inline bool is_loopback(net::ip::address address) {
  if (address.is_v6() && address.to_v6().is_v4_mapped()) {
    address = net::ip::make_address_v4(net::ip::v4_mapped, address.to_v6());
  }
  return address.is_loopback();
}

inline std::string text_of(beast::string_view text) { return {text.data(), text.size()}; }

}  // namespace cornerd::web
