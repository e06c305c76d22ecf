// SPDX-License-Identifier: MIT
#include "mqtt/broker.hpp"

#include <mqtt_protocol.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "client/retry_delay.hpp"
#include "mqtt/mosquitto_library.hpp"

namespace cornerd::mqtt {

namespace {

using Clock = std::chrono::steady_clock;

/// A broker that is silent for so long is gone: MQTT's keep-alive, of which the library sends
/// pings.
constexpr int kKeepAlive_s = 10;
/// From the attempt to connect to the broker's consent.
constexpr std::chrono::seconds kConnectTime{15};
constexpr std::chrono::seconds kLargestRetryDelay{30};
/// A shorter connection does not reset the delay: two clients of one id end each other's.
constexpr std::chrono::seconds kStableTime{20};
constexpr int kManyShortOnes = 3;
/// How long a flood waits: less than the keep-alive.
constexpr std::chrono::seconds kReadingPause{1};
constexpr int kLoop_ms = 100;
/// MQTT 5, section 2.4: reason codes from here on are failures.
constexpr int kLeastFailure = 0x80;

std::string address(const BrokerConfig& config) {
  return config.host + ":" + std::to_string(config.port);
}

std::runtime_error failure(const BrokerConfig& config, const std::string& reason) {
  return std::runtime_error("broker " + address(config) + ": " + reason);
}

/// libmosquitto 2.0.11 (Debian 12) ends the process by an assertion where a packet of MQTT 5 has a
/// property that it does not know: lib/property_mosq.c logs without a client.
thread_local const char* words_of_abort = nullptr;

extern "C" void say_why_it_aborts(int /*signal*/) {
  if (words_of_abort == nullptr) return;
  [[maybe_unused]] const auto ignored =
      ::write(STDERR_FILENO, words_of_abort, std::strlen(words_of_abort));
}

}  // namespace

Broker::Broker(BrokerConfig config, Message will) : config_(std::move(config)) {
  const MosquittoLibrary& lib = mosquitto_library();
  client_ = lib.create(config_.client_id.empty() ? nullptr : config_.client_id.c_str(),
                       /*clean_session=*/true, this);
  if (client_ == nullptr) throw failure(config_, "out of memory");
  lib.int_option(client_, MOSQ_OPT_PROTOCOL_VERSION,
                 config_.is_v5 ? MQTT_PROTOCOL_V5 : MQTT_PROTOCOL_V311);
  lib.threaded_set(client_, true);
  if (!config_.user.empty()) {
    lib.username_pw_set(client_, config_.user.c_str(), config_.password.c_str());
  }
  if (config_.is_tls) {
    const bool is_folder = std::filesystem::is_directory(config_.ca);
    const auto path_or_null = [](const std::filesystem::path& path) {
      return path.empty() ? nullptr : path.c_str();
    };
    const int result = lib.tls_set(
        client_, is_folder ? nullptr : config_.ca.c_str(), is_folder ? config_.ca.c_str() : nullptr,
        path_or_null(config_.certificate), path_or_null(config_.key), nullptr);
    if (result != MOSQ_ERR_SUCCESS) {
      lib.destroy(client_);
      throw failure(config_, "its TLS files cannot be read: check /broker/tls");
    }
  }
  if (!will.topic.empty()) {
    lib.will_set(client_, will.topic.c_str(), static_cast<int>(will.payload.size()),
                 will.payload.data(), /*qos=*/1, /*retain=*/true);
  }
  lib.connect_callback_set(client_, [](mosquitto*, void* self, int reason) {
    static_cast<Broker*>(self)->on_connect(reason);
  });
  lib.disconnect_callback_set(client_, [](mosquitto*, void* self, int) {
    static_cast<Broker*>(self)->is_connected_ = false;
  });
  lib.message_callback_set(client_, [](mosquitto*, void* self, const mosquitto_message* message) {
    static_cast<Broker*>(self)->on_message(*message);
  });
  lib.publish_v5_callback_set(
      client_, [](mosquitto*, void* self, int, int reason, const mosquitto_property*) {
        if (reason >= kLeastFailure) static_cast<Broker*>(self)->refusal_ = reason;
        --static_cast<Broker*>(self)->unacknowledged_;
      });
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

Broker::~Broker() {
  thread_.request_stop();
  thread_ = {};
  mosquitto_library().destroy(client_);
}

bool Broker::stop(std::chrono::milliseconds timeout) {
  thread_.request_stop();
  std::unique_lock lock(mutex_);
  return stopped_.wait_for(lock, timeout, [this] { return has_ended_.load(); });
}

void Broker::run(const std::stop_token& stop) {
  const std::string words =
      "broker " + config_.host + ":" + std::to_string(config_.port) +
      ": what it sends is no MQTT 5, and libmosquitto ends this process for that: check host and "
      "port, or set \"protocol\": \"3.1.1\" for the broker\n";
  words_of_abort = config_.is_v5 ? words.c_str() : nullptr;
  std::signal(SIGABRT, say_why_it_aborts);
  client::RetryDelay delay(kLargestRetryDelay);
  int short_ones = 0;  // connections in a row
  while (!stop.stop_requested()) {
    const std::uint64_t before = connections_;
    const Clock::time_point began = Clock::now();
    serve(stop);
    is_connected_ = false;
    if (connections_ != before) {
      const bool was_stable = Clock::now() - began > kStableTime;
      short_ones = was_stable ? 0 : short_ones + 1;
      if (was_stable) delay.reset();
      if (short_ones >= kManyShortOnes && !stop.stop_requested()) {
        set_problem(
            "it ends each connection soon: does another client have this manufacturer and serial "
            "number?");
      }
    }
    std::unique_lock lock(mutex_);
    stopped_.wait_for(lock, stop, delay.next(), [] { return false; });
  }
  words_of_abort = nullptr;
  const std::lock_guard lock(mutex_);
  has_ended_ = true;
  stopped_.notify_all();
}

int Broker::connect() {
  const MosquittoLibrary& lib = mosquitto_library();
  mosquitto_property* properties = nullptr;
  if (config_.is_v5) {
    lib.property_add_int32(&properties, MQTT_PROP_MAXIMUM_PACKET_SIZE, kMaxPayloadBytes + 1024);
  }
  const int result = lib.connect_bind_v5(client_, config_.host.c_str(), config_.port, kKeepAlive_s,
                                         nullptr, properties);
  lib.property_free_all(&properties);
  return result;
}

void Broker::serve(const std::stop_token& stop) {
  const MosquittoLibrary& lib = mosquitto_library();
  is_refused_ = false;
  unacknowledged_ = 0;
  refusal_ = 0;
  int result = connect();
  bool was_connected = false;
  const Clock::time_point consent_until = Clock::now() + kConnectTime;
  while (result == MOSQ_ERR_SUCCESS && !stop.stop_requested() && !is_refused_) {
    errno = 0;
    result = lib.loop(client_, kLoop_ms, 1);
    was_connected = was_connected || is_connected_;
    if (!is_connected_ && result == MOSQ_ERR_SUCCESS && !is_refused_ &&
        Clock::now() > consent_until) {
      return set_problem("the broker accepts and says nothing");
    }
  }
  const bool is_nonsense = result == MOSQ_ERR_PROTOCOL || result == MOSQ_ERR_MALFORMED_PACKET ||
                           result == MOSQ_ERR_UNKNOWN || (result == MOSQ_ERR_ERRNO && errno == 0);
  if (is_nonsense && !was_connected) {
    set_problem("what answers at " + address(config_) + " is no MQTT broker: check host and port");
  } else if (result != MOSQ_ERR_SUCCESS && !is_refused_) {
    set_problem(address(config_) + ": " + lib.strerror(result));
  }
  if (!stop.stop_requested()) return;
  // What was published last goes out before the end.
  const Clock::time_point until = Clock::now() + std::chrono::milliseconds(500);
  while (is_connected_ && Clock::now() < until &&
         (unacknowledged_ > 0 || lib.want_write(client_)) &&
         lib.loop(client_, 10, 1) == MOSQ_ERR_SUCCESS) {
  }
  lib.disconnect(client_);
  lib.loop(client_, 10, 1);
}

void Broker::on_connect(int reason) {
  const MosquittoLibrary& lib = mosquitto_library();
  if (reason != 0) {
    is_refused_ = true;
    return set_problem(std::string("the broker refuses: ") +
                       (config_.is_v5 ? lib.reason_string(reason) : lib.connack_string(reason)));
  }
  const std::lock_guard lock(mutex_);
  for (const std::string& filter : filters_) lib.subscribe(client_, nullptr, filter.c_str(), 1);
  is_connected_ = true;
  ++connections_;
}

void Broker::on_message(const mosquitto_message& message) {
  const auto size = static_cast<std::size_t>(message.payloadlen);
  std::unique_lock lock(mutex_);
  const auto has_room = [&] {
    return waiting_.size() < kMaxWaiting && waiting_bytes_ + size <= 2 * kMaxPayloadBytes;
  };
  if (!taken_.wait_for(lock, kReadingPause, has_room)) {
    ++lost_;
    return;
  }
  waiting_bytes_ += size;
  waiting_.push_back({message.topic, std::string(static_cast<const char*>(message.payload), size),
                      message.retain});
}

std::vector<Message> Broker::take() {
  const std::lock_guard lock(mutex_);
  std::vector<Message> taken(std::make_move_iterator(waiting_.begin()),
                             std::make_move_iterator(waiting_.end()));
  waiting_.clear();
  waiting_bytes_ = 0;
  taken_.notify_one();
  return taken;
}

void Broker::subscribe(const std::string& filter) {
  const std::lock_guard lock(mutex_);
  if (!filters_.insert(filter).second) return;
  if (is_connected_) mosquitto_library().subscribe(client_, nullptr, filter.c_str(), 1);
}

void Broker::unsubscribe(const std::string& filter) {
  const std::lock_guard lock(mutex_);
  if (filters_.erase(filter) == 0) return;
  if (is_connected_) mosquitto_library().unsubscribe(client_, nullptr, filter.c_str());
}

bool Broker::publish(const std::string& topic, std::string_view payload, bool is_retained,
                     int qos) {
  if (!is_connected_ || payload.size() > kMaxPayloadBytes) return false;
  ++unacknowledged_;
  const bool is_taken =
      mosquitto_library().publish(client_, nullptr, topic.c_str(), static_cast<int>(payload.size()),
                                  payload.data(), qos, is_retained) == MOSQ_ERR_SUCCESS;
  if (!is_taken) --unacknowledged_;
  return is_taken;
}

bool Broker::has_sent_all() const { return !mosquitto_library().want_write(client_); }

std::string Broker::refusal() const {
  const int reason = refusal_;
  return reason == 0 ? std::string() : mosquitto_library().reason_string(reason);
}

std::string Broker::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

void Broker::set_problem(std::string text) {
  const std::lock_guard lock(mutex_);
  problem_ = std::move(text);
}

}  // namespace cornerd::mqtt
