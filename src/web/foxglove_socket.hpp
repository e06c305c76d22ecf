// SPDX-License-Identifier: MIT
// Included by server.cpp alone.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "web/beast.hpp"
#include "web/foxglove_session.hpp"

namespace cornerd::web {

/// A WebSocket of Foxglove: one frame is written at a time, what comes meanwhile waits in the
/// hub's outbox.
class FoxgloveSocket : public std::enable_shared_from_this<FoxgloveSocket> {
 public:
  FoxgloveSocket(beast::tcp_stream stream, Site& site, bool may_publish)
      : socket_(std::move(stream)), site_(site), session_(may_publish) {
    ++site_.connections;
  }
  ~FoxgloveSocket() {
    if (listener_) site_.hub.remove(*listener_);
    --site_.connections;
  }
  FoxgloveSocket(const FoxgloveSocket&) = delete;
  FoxgloveSocket& operator=(const FoxgloveSocket&) = delete;

  void accept(const http::request<http::string_body>& header) {
    beast::error_code ignored;
    beast::get_lowest_layer(socket_).socket().set_option(
        net::socket_base::send_buffer_size(kSendBufferBytes), ignored);
    // From here on the timeouts are those of the WebSocket: pings find out that a reader is gone.
    beast::get_lowest_layer(socket_).expires_never();
    socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    socket_.read_message_max(kMaxFrameBytes);
    const beast::string_view offered = header[http::field::sec_websocket_protocol];
    const std::string protocol(foxglove_protocol({offered.data(), offered.size()}));
    socket_.set_option(websocket::stream_base::decorator([protocol](auto& response) {
      response.set(http::field::sec_websocket_protocol, protocol);
    }));
    socket_.async_accept(header, [self = shared_from_this()](beast::error_code error) {
      if (!error) self->start();
    });
  }

 private:
  static constexpr std::size_t kMaxFrameBytes = 64 * 1024;

  void start() {
    const std::weak_ptr<FoxgloveSocket> weak = shared_from_this();
    listener_ = site_.hub.add(classes_from("POSE,SCAN,STATUS,EVENT,MAP"), [weak] {
      if (const auto self = weak.lock()) self->pump();
    });
    pump();
    read();
  }

  /// Unless a frame is being read or answered, or some wait for a client that does not read them.
  void read() {
    if (is_reading_ || session_.has_frame()) return;
    is_reading_ = true;
    socket_.async_read(received_,
                       [self = shared_from_this()](beast::error_code error, std::size_t) {
                         if (!error) self->on_frame();
                       });
  }

  void on_frame() {
    const std::string frame = beast::buffers_to_string(received_.data());
    received_.consume(received_.size());
    std::string request;
    if (socket_.got_text()) {
      session_.on_text(frame);
      if (session_.take_map_wanted()) {
        const Line map = site_.hub.last(message::MessageClass::kMap);
        if (map) (*listener_)->outbox.offer(message::MessageClass::kMap, map);
      }
    } else {
      request = session_.on_binary(frame);
    }
    pump();
    if (request.empty()) {
      is_reading_ = false;
      return read();
    }
    // The next frame is read when the daemon has answered.
    net::post(site_.workers, [self = shared_from_this(), request]() mutable {
      auto response = std::make_shared<Response>(self->site_.router.ask(request));
      auto& io = self->site_.io;
      net::post(io, [self = std::move(self), response] {
        if (response->status != 200) self->session_.tell(response->body);
        self->pump();
        self->is_reading_ = false;
        self->read();
      });
    });
  }

  /// Writes what waits, unless a write is under way.
  void pump() {
    if (is_writing_) return;
    Hub::Listener& listener = **listener_;
    while (!session_.has_frame()) {
      if (std::exchange(listener.connection_changed, false)) {
        session_.on_connection(site_.hub.is_connected());
      } else if (!listener.outbox.empty()) {
        const auto now = std::chrono::system_clock::now().time_since_epoch();
        session_.on_line(listener.outbox.take(),
                         std::chrono::duration_cast<std::chrono::nanoseconds>(now).count());
      } else {
        return;
      }
    }
    frame_ = session_.take_frame();
    is_writing_ = true;
    socket_.binary(frame_.is_binary);
    socket_.async_write(net::buffer(frame_.bytes),
                        [self = shared_from_this()](beast::error_code error, std::size_t) {
                          self->is_writing_ = false;
                          if (error) return;
                          self->read();
                          self->pump();
                        });
  }

  websocket::stream<beast::tcp_stream, /*deflateSupported=*/false> socket_;
  Site& site_;
  FoxgloveSession session_;
  std::optional<Hub::Handle> listener_;
  beast::flat_buffer received_;
  FoxgloveSession::Frame frame_;
  bool is_reading_ = false;
  bool is_writing_ = false;
};

}  // namespace cornerd::web
