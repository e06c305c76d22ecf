// SPDX-License-Identifier: MIT
// Included by server.cpp alone.
#pragma once

#include <malloc.h>

#include <chrono>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include "web/beast.hpp"
#include "web/foxglove_socket.hpp"

namespace cornerd::web {

constexpr auto kRequestTime = std::chrono::seconds(15);
constexpr auto kWriteTime = std::chrono::seconds(30);
/// A silent stream is written to so often, to find out that its reader is gone.
constexpr auto kHeartbeat = std::chrono::seconds(10);
constexpr std::uint32_t kMaxHeaderBytes = 8 * 1024;
constexpr std::size_t kReadBytes = 4 * 1024;
constexpr const char* kSecurityPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; "
    "img-src 'self' data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// One connection: requests one after another, or a stream of events.
class HttpSession : public std::enable_shared_from_this<HttpSession> {
 public:
  HttpSession(tcp::socket socket, Site& site)
      : stream_(std::move(socket)), site_(site), heartbeat_(site.io) {
    ++site_.connections;
  }
  ~HttpSession() {
    if (listener_) site_.hub.remove(*listener_);
    --site_.connections;
  }
  HttpSession(const HttpSession&) = delete;
  HttpSession& operator=(const HttpSession&) = delete;

  void read() {
    parser_.emplace();
    parser_->header_limit(kMaxHeaderBytes);
    parser_->body_limit(static_cast<std::uint64_t>(-1));  // decided after the header
    stream_.expires_after(kRequestTime);
    http::async_read_header(stream_, buffer_, *parser_,
                            [self = shared_from_this()](beast::error_code error, std::size_t) {
                              self->on_header(error);
                            });
  }

 private:
  void on_header(beast::error_code error) {
    request_ = {};
    is_head_ = false;
    if (error == http::error::end_of_stream) return close();
    if (error) return refuse_malformed(error);
    const auto& header = parser_->get();
    request_.method = text_of(header.method_string());
    is_head_ = request_.method == "HEAD";
    if (is_head_) request_.method = "GET";
    request_.host = text_of(header[http::field::host]);
    request_.origin = text_of(header[http::field::origin]);
    request_.content_type = text_of(header[http::field::content_type]);
    request_.authorization = text_of(header[http::field::authorization]);
    request_.from_loopback = is_loopback(stream_.socket().remote_endpoint(ignored_).address());
    keep_alive_ = header.keep_alive();
    if (!set_target({header.target().data(), header.target().size()}, request_)) {
      return refuse(error_response(400, "path", "the path is malformed"));
    }
    decision_ = site_.router.decide(request_);
    if (decision_.kind == Router::Kind::kRefused) return refuse(std::move(decision_.response));
    if (parser_->content_length_remaining().value_or(0) > decision_.max_body_bytes)
      return too_large();
    if (decision_.kind == Router::Kind::kEvents) {
      return is_head_ ? refuse({.content_type = "text/event-stream"}) : start_events();
    }
    if (decision_.kind == Router::Kind::kFoxglove) return start_foxglove();
    parser_->body_limit(decision_.max_body_bytes);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](beast::error_code body_error, std::size_t) {
                       self->on_body(body_error);
                     });
  }

  /// Of what is no HTTP; a client that is gone, or too slow, gets no answer.
  void refuse_malformed(beast::error_code error) {
    static const auto& http_category = http::make_error_code(http::error::bad_method).category();
    if (error.category() != http_category || error == http::error::partial_message) return;
    if (error == http::error::header_limit) {
      return refuse(error_response(
          431, "too-long", "a header has at most " + std::to_string(kMaxHeaderBytes) + " bytes"));
    }
    refuse(error_response(400, "http", "this is no request of HTTP/1.1: " + error.message()));
  }

  void too_large() {
    refuse(error_response(413, "too-long",
                          "at most " + std::to_string(decision_.max_body_bytes) + " bytes"));
  }

  void on_body(beast::error_code error) {
    if (error == http::error::body_limit) return too_large();
    if (error) return refuse_malformed(error);
    request_.body = std::move(parser_->get().body());
    if (decision_.kind == Router::Kind::kPage) {
      return respond(site_.router.answer(request_, Hub::Clock::now()));
    }
    stream_.expires_never();
    net::post(site_.workers, [self = shared_from_this()]() mutable {
      auto response = std::make_shared<Response>(self->site_.router.work(self->request_));
      // A map takes far more memory than its text.
      ::malloc_trim(0);
      // A session ends on the thread of the hub alone.
      auto& io = self->site_.io;
      net::post(io, [self = std::move(self), response] { self->respond(std::move(*response)); });
    });
  }

  /// The rest of the request is not read.
  void refuse(Response response) {
    keep_alive_ = false;
    respond(std::move(response));
  }

  void respond(Response response) {
    serializer_.reset();
    answer_.emplace();
    answer_->result(response.status);
    answer_->version(11);
    answer_->keep_alive(keep_alive_);
    answer_->set(http::field::content_type, response.content_type);
    answer_->set(http::field::cache_control, "no-store");
    answer_->set("Content-Security-Policy", kSecurityPolicy);
    answer_->set("X-Content-Type-Options", "nosniff");
    answer_->set("Referrer-Policy", "no-referrer");
    if (!response.download_name.empty()) {
      answer_->set(http::field::content_disposition,
                   "attachment; filename=\"" + response.download_name + "\"");
    }
    allow_origin(*answer_);
    answer_->body() = std::move(response.body);
    place_ = std::move(response.place);
    answer_->prepare_payload();
    stream_.expires_after(kWriteTime);
    serializer_.emplace(*answer_);
    const auto on_written = [self = shared_from_this()](beast::error_code error, std::size_t) {
      self->serializer_.reset();
      self->answer_.reset();
      if (std::exchange(self->place_, nullptr)) ::malloc_trim(0);
      if (error) return;
      if (!self->keep_alive_) return self->close();
      self->read();
    };
    is_head_ ? http::async_write_header(stream_, *serializer_, on_written)
             : http::async_write(stream_, *serializer_, on_written);
  }

  /// A foreign origin that got here is one of --allow-origin.
  template <typename Header>
  void allow_origin(Header& header) const {
    if (request_.origin.empty() || header.result_int() == 403) return;
    header.set(http::field::access_control_allow_origin, request_.origin);
    header.set(http::field::vary, "Origin");
    if (request_.method != "OPTIONS") return;
    header.set(http::field::access_control_allow_methods, "GET, POST, PUT");
    header.set(http::field::access_control_allow_headers, "Authorization, Content-Type");
  }

  void start_foxglove() {
    const auto& header = parser_->get();
    if (!websocket::is_upgrade(header) ||
        foxglove_protocol(text_of(header[http::field::sec_websocket_protocol])).empty()) {
      return refuse(error_response(426, "websocket",
                                   "open a WebSocket with the subprotocol foxglove.sdk.v1"));
    }
    std::make_shared<FoxgloveSocket>(std::move(stream_), site_, site_.router.may_change(request_))
        ->accept(header);
  }

  void start_events() {
    http::response<http::empty_body> header{http::status::ok, 11};
    header.set(http::field::content_type, "text/event-stream");
    header.set(http::field::cache_control, "no-store");
    header.set(http::field::connection, "close");
    header.set("X-Content-Type-Options", "nosniff");
    allow_origin(header);
    std::ostringstream text;
    text << header.base();
    text << "event: access\ndata: {\"may_change\":"
         << (site_.router.may_change(request_) ? "true" : "false") << "}\n\n";
    writing_ = text.str();
    stream_.socket().set_option(net::socket_base::send_buffer_size(kSendBufferBytes), ignored_);
    const std::weak_ptr<HttpSession> weak = shared_from_this();
    listener_ = site_.hub.add(decision_.classes, [weak] {
      if (const auto self = weak.lock()) self->pump();
    });
    write_event();
    watch_for_end();
  }

  /// Writes what waits, unless a write is under way.
  void pump() {
    if (!writing_.empty()) return;
    writing_ = site_.hub.next_event(**listener_);
    if (writing_.empty()) return wait_for_heartbeat();
    write_event();
  }

  void write_event() {
    heartbeat_.cancel();
    stream_.expires_after(kWriteTime);
    net::async_write(stream_, net::buffer(writing_),
                     [self = shared_from_this()](beast::error_code error, std::size_t) {
                       self->writing_.clear();
                       if (error) return self->end_stream();
                       self->stream_.expires_never();
                       self->pump();
                     });
  }

  void wait_for_heartbeat() {
    heartbeat_.expires_after(kHeartbeat);
    heartbeat_.async_wait([weak = weak_from_this()](beast::error_code error) {
      const auto self = weak.lock();
      if (error || !self || !self->writing_.empty()) return;
      self->writing_ = ":\n\n";
      self->write_event();
    });
  }

  /// Keeps the session alive until its reader goes.
  void watch_for_end() {
    stream_.socket().async_wait(tcp::socket::wait_read,
                                // A stream's reader has nothing more to say.
                                [self = shared_from_this()](auto) { self->end_stream(); });
  }

  void end_stream() {
    heartbeat_.cancel();
    stream_.close();
  }

  void close() { stream_.socket().shutdown(tcp::socket::shutdown_send, ignored_); }

  beast::tcp_stream stream_;
  Site& site_;
  beast::flat_static_buffer<2 * kReadBytes + kMaxHeaderBytes> buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  std::optional<http::response<http::string_body>> answer_;
  std::optional<http::response_serializer<http::string_body>> serializer_;
  std::shared_ptr<const void> place_;  ///< of the answer
  bool is_head_ = false;               ///< the answer has no body
  Request request_;
  Router::Decision decision_;
  bool keep_alive_ = false;
  beast::error_code ignored_;  ///< of a connection that ends anyway
  std::string writing_;        ///< empty: no write is under way
  std::optional<Hub::Handle> listener_;
  net::steady_timer heartbeat_;
};

}  // namespace cornerd::web
