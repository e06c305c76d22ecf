// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace cornerd::mqtt {

struct Message {
  std::string topic;
  std::string payload;
  bool is_retained = false;
};

/// What the bridge needs of a broker. No call waits for the network.
class BrokerLink {
 public:
  BrokerLink() = default;
  virtual ~BrokerLink() = default;
  BrokerLink(const BrokerLink&) = delete;
  BrokerLink& operator=(const BrokerLink&) = delete;

  virtual void subscribe(const std::string& filter) = 0;
  virtual void unsubscribe(const std::string& filter) = 0;
  /// Counts connections: what is retained, and what may have been missed, is sent again after each.
  virtual std::uint64_t connections() const = 0;
  /// False without a connection: the message is lost.
  virtual bool publish(const std::string& topic, std::string_view payload, bool is_retained,
                       int qos) = 0;
  /// True if all of it has gone out: a broker that does not read gets no more at a high rate.
  virtual bool has_sent_all() const = 0;
};

}  // namespace cornerd::mqtt
