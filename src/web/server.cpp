// SPDX-License-Identifier: MIT
// The one source that includes Boost.Beast. One thread has all connections and the hub, one reads
// the daemon's socket, one does what may block.
#include "web/server.hpp"

#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "web/beast.hpp"
#include "web/daemon_link.hpp"
#include "web/http_session.hpp"

namespace cornerd::web {

namespace {

void accept_next(tcp::acceptor& acceptor, Site& site) {
  acceptor.async_accept([&](beast::error_code error, tcp::socket socket) {
    if (!error && site.connections < kMaxConnections) {
      beast::error_code ignored;
      socket.set_option(tcp::no_delay(true), ignored);
      std::make_shared<HttpSession>(std::move(socket), site)->read();
    }
    if (error != net::error::operation_aborted) accept_next(acceptor, site);
  });
}

}  // namespace

void serve(const ServerConfig& config) {
  Site site(config);
  tcp::acceptor acceptor(site.io);
  try {
    const tcp::endpoint endpoint(net::ip::make_address(config.address), config.port);
    acceptor.open(endpoint.protocol());
    acceptor.set_option(net::socket_base::reuse_address(true));
    acceptor.bind(endpoint);
    acceptor.listen();
  } catch (const boost::system::system_error& error) {
    throw std::runtime_error(config.address + ":" + std::to_string(config.port) + ": " +
                             error.code().message());
  }
  net::signal_set signals(site.io, SIGTERM, SIGINT);
  signals.async_wait([&](beast::error_code, int) { site.io.stop(); });
  const bool is_v6 = config.address.find(':') != std::string::npos;
  std::fprintf(stderr, "cornerd-web: http://%s:%d\n",
               (is_v6 ? "[" + config.address + "]" : config.address).c_str(),
               acceptor.local_endpoint().port());
  accept_next(acceptor, site);
  const std::jthread listener([&](const std::stop_token& stop) {
    follow_daemon(config.pose_socket, stop, [&site](client::Event event, std::string_view text) {
      net::post(site.io, [&site, event, copy = std::string(text)] {
        site.hub.note(event, copy, Hub::Clock::now());
      });
    });
  });
  site.io.run();
  site.workers.join();
}

}  // namespace cornerd::web
