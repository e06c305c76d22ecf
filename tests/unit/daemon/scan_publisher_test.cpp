// SPDX-License-Identifier: MIT
#include "daemon/scan_publisher.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include <nlohmann/json.hpp>

#include "captured_log.hpp"
#include "test_client.hpp"
#include "tests/temporary_folder.hpp"

namespace cornerd::daemon {
namespace {

using nlohmann::json;

class ScanPublisherTest : public ::testing::Test {
 protected:
  ScanPublisherTest() {
    server_.listen(folder_ / "s", SocketRole::kPose);
    client_.emplace(folder_ / "s");
    loop_.run_once(1000);
    client_->send(R"({"class":"WATCH","classes":["EVENT"]})"
                  "\n");
    loop_.run_once(1000);
    while (client_->read_line(0)) {
    }
  }

  void publish_fix_at(double x_m) {
    report_.result.pose.state = core::PoseState::kFix;
    report_.result.pose.T_map_base = {x_m, 0, 0};
    ++report_.number;
    publisher_.publish(report_);
  }

  int events(const std::string& what) {
    int count = 0;
    while (const auto line = client_->read_line(0)) {
      if (json::parse(*line)["what"] == what) ++count;
    }
    return count;
  }

  test::TemporaryFolder folder_;
  EventLoop loop_;
  MessageServer server_{loop_, "1", {[] {}}};
  ScanPublisher publisher_{server_, nullptr};
  ScanReport report_;
  std::optional<TestClient> client_;
};

TEST_F(ScanPublisherTest, JumpAtEachScan_EventsAndOneLogLine) {
  const CapturedLog log;
  constexpr int kJumps = 5;
  for (int i = 0; i <= kJumps; ++i) publish_fix_at(i % 2 == 0 ? 0 : 1);
  EXPECT_EQ(events("jump"), kJumps);
  EXPECT_EQ(log.text(), "info: jump: 1.000 m, 0.0 degrees\n");
}

}  // namespace
}  // namespace cornerd::daemon
