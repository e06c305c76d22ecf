// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "mqtt/broker_link.hpp"

struct mosquitto;
struct mosquitto_message;

namespace cornerd::mqtt {

struct BrokerConfig {
  std::string host = "localhost";
  std::uint16_t port = 1883;
  std::string client_id;  ///< empty: the broker chooses one
  std::string user;
  std::string password;
  bool is_tls = false;
  std::filesystem::path ca;  ///< file, or folder, of certificates that may sign the broker's
  std::filesystem::path certificate;  ///< of this client; empty if it has none
  std::filesystem::path key;
  bool is_v5 = true;  ///< MQTT 5, which limits what the broker may send; else 3.1.1
};

/// A connection to a broker, kept up by a thread of its own. No call waits for the network.
class Broker : public BrokerLink {
 public:
  /// Fits a fleet's largest map.
  static constexpr std::size_t kMaxPayloadBytes = 2 * 1024 * 1024;
  /// Messages that wait for take(). Then no more are read; after a second they are lost, and
  /// counted.
  static constexpr std::size_t kMaxWaiting = 1024;

  /// `will`: published, retained, by the broker when the connection breaks; no topic: none. Throws
  /// std::runtime_error without libmosquitto, or if a certificate cannot be read.
  explicit Broker(BrokerConfig config, Message will = {});
  ~Broker() override;

  void subscribe(const std::string& filter) override;
  void unsubscribe(const std::string& filter) override;

  bool is_connected() const { return is_connected_; }
  std::uint64_t connections() const override { return connections_; }
  /// Why there is none.
  std::string problem() const;

  bool publish(const std::string& topic, std::string_view payload, bool is_retained = false,
               int qos = 0) override;
  bool has_sent_all() const override;
  /// Messages that have not gone out, or that the broker has not acknowledged (QoS 1).
  int unacknowledged() const { return unacknowledged_; }
  /// Why this broker has refused a message (QoS 1, MQTT 5); empty if it has not.
  std::string refusal() const;

  std::vector<Message> take();
  std::uint64_t lost_messages() const { return lost_; }

  /// Ends the connection in an orderly way: no will is sent. False if the thread does not end in
  /// time, because the address of the broker is being resolved or its machine does not answer.
  bool stop(std::chrono::milliseconds timeout);

 private:
  void run(const std::stop_token& stop);
  /// From the attempt to connect to the loss.
  void serve(const std::stop_token& stop);
  int connect();
  void on_connect(int reason);
  void on_message(const mosquitto_message& message);
  void set_problem(std::string text);

  const BrokerConfig config_;
  mosquitto* client_ = nullptr;
  std::atomic<bool> is_connected_{false};
  std::atomic<bool> has_ended_{false};
  std::atomic<bool> is_refused_{false};
  std::atomic<std::uint64_t> connections_{0};
  std::atomic<std::uint64_t> lost_{0};
  std::atomic<int> unacknowledged_{0};
  std::atomic<int> refusal_{0};  ///< reason code of MQTT 5
  mutable std::mutex mutex_;     ///< of what follows
  std::condition_variable_any stopped_;
  std::condition_variable taken_;
  std::string problem_ = "not connected yet";
  std::set<std::string> filters_;
  std::deque<Message> waiting_;
  std::size_t waiting_bytes_ = 0;
  std::jthread thread_;
};

}  // namespace cornerd::mqtt
