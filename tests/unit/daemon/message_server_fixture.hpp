// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "daemon/message_server.hpp"
#include "test_client.hpp"
#include "tests/temporary_folder.hpp"

namespace cornerd::daemon {

class MessageServerTest : public ::testing::Test {
 protected:
  MessageServerTest() {
    server_.listen(pose_path_, SocketRole::kPose);
    server_.listen(control_path_, SocketRole::kControl);
  }

  /// Runs the loop until it is idle.
  void serve() {
    for (int i = 0; i < 20; ++i) loop_.run_once(0);
  }

  TestClient connect(const std::filesystem::path& path) {
    TestClient client(path);
    serve();
    return client;
  }

  /// A connected client that has read VERSION.
  TestClient greeted(const std::filesystem::path& path) {
    TestClient client = connect(path);
    EXPECT_EQ(next(client)["class"], "VERSION");
    return client;
  }

  static nlohmann::json next(TestClient& client) {
    const auto line = client.read_line(0);
    return line ? nlohmann::json::parse(*line) : nlohmann::json("nothing");
  }

  nlohmann::json ask(TestClient& client, const std::string& request) {
    EXPECT_TRUE(client.send(request + "\n"));
    serve();
    return next(client);
  }

  static std::string pose(int seq) {
    return "{\"class\":\"POSE\",\"seq\":" + std::to_string(seq) + "}\n";
  }

  test::TemporaryFolder folder_;
  const std::filesystem::path pose_path_ = folder_ / "pose.sock";
  const std::filesystem::path control_path_ = folder_ / "control.sock";
  EventLoop loop_;
  int relocalizations_ = 0;
  std::vector<core::Pose2> given_;
  std::vector<message::OdometryReading> readings_;
  std::vector<std::string> refusals_;  ///< of ODOMETRY
  int publisher_ = -1;                 ///< the connection whose readings are used
  std::vector<std::string> maps_;      ///< asked for
  std::vector<Ticket> tickets_;
  bool takes_maps_ = true;
  MessageServer server_{
      loop_,
      "1.2.3",
      {[this] { ++relocalizations_; },
       [this](const message::SetPoseRequest& request) -> std::optional<message::RequestError> {
         given_.push_back(request.T_map_base);
         if (request.T_map_base.x_m > 1000) return message::RequestError{"outside", "too far"};
         return std::nullopt;
       },
       [this](const message::OdometryReading& reading, int connection) {
         readings_.push_back(reading);
         if (publisher_ < 0) publisher_ = connection;
         return publisher_ == connection;
       },
       [this](int connection) {
         if (publisher_ == connection) publisher_ = -1;
       },
       [this](const message::SetMapRequest& request, const Ticket& ticket) {
         maps_.push_back(request.name);
         tickets_.push_back(ticket);
         return takes_maps_;
       },
       [this](const message::RequestError& error) { refusals_.push_back(error.text); }}};
};

}  // namespace cornerd::daemon
