// SPDX-License-Identifier: MIT
#include "web/hub.hpp"

#include <gtest/gtest.h>

#include <string>

#include "web/metrics.hpp"
#include "web/router.hpp"

namespace cornerd::web {
namespace {

using client::Event;

std::string pose(int seq) {
  return "{\"class\":\"POSE\",\"seq\":" + std::to_string(seq) + ",\"t\":1,\"state\":\"lost\"}";
}

class HubTest : public ::testing::Test {
 protected:
  void say(const std::string& line, int at_s = 0) {
    hub_.note(Event::kMessage, line, Hub::Clock::time_point(std::chrono::seconds(at_s)));
  }
  Hub hub_;
};

TEST_F(HubTest, NewStream_GetsConnectionThenTheLastOfItsClasses) {
  hub_.note(Event::kConnected, "", {});
  say(pose(1));
  say(pose(2));
  say("{\"class\":\"SCAN\",\"t\":1}");
  say("no message");
  const auto stream = hub_.add(classes_from("POSE"), [] {});
  EXPECT_EQ(hub_.next_event(*stream), "event: daemon\ndata: {\"connected\":true}\n\n");
  EXPECT_EQ(hub_.next_event(*stream), "data: " + pose(2) + "\n\n");
  EXPECT_EQ(hub_.next_event(*stream), "");
  hub_.remove(stream);
}

TEST_F(HubTest, SlowStream_LosesItsOldestAndIsToldHowMany) {
  int woken = 0;
  const auto slow = hub_.add(classes_from("POSE"), [&] { ++woken; });
  hub_.next_event(*slow);
  for (int seq = 1; seq <= 20; ++seq) say(pose(seq));
  EXPECT_EQ(woken, 20);
  const std::string first = hub_.next_event(*slow);
  EXPECT_NE(first.find("\"seq\":5,"), std::string::npos) << first;
  EXPECT_NE(first.find("\"dropped\":4}"), std::string::npos) << first;
  EXPECT_EQ(hub_.next_event(*slow).find("dropped"), std::string::npos);
}

TEST_F(HubTest, DaemonGone_StreamsAreToldAndOldPosesForgotten) {
  hub_.note(Event::kConnected, "", {});
  say(pose(1));
  say("{\"class\":\"MAP\",\"name\":\"a\",\"walls\":[]}");
  const auto stream = hub_.add(classes_from("POSE,MAP"), [] {});
  hub_.next_event(*stream);
  hub_.note(Event::kLost, "gone", {});
  EXPECT_EQ(hub_.next_event(*stream), "event: daemon\ndata: {\"connected\":false}\n\n");
  EXPECT_NE(hub_.next_event(*stream).find("MAP"), std::string::npos);
  EXPECT_EQ(hub_.next_event(*stream), "");
  EXPECT_EQ(hub_.last(message::MessageClass::kPose), nullptr);
  EXPECT_NE(hub_.last(message::MessageClass::kMap), nullptr);
  EXPECT_EQ(hub_.problem(), "gone");
}

TEST_F(HubTest, Recording_HasTheLastSecondsOnly) {
  say(pose(1), 0);
  say(pose(2), 50);
  say(pose(3), 55);
  const auto now = Hub::Clock::time_point(std::chrono::seconds(56));
  EXPECT_EQ(hub_.recording(std::chrono::seconds(10), now), pose(2) + "\n" + pose(3) + "\n");
  say(pose(4), 100);
  EXPECT_EQ(hub_.recording(std::chrono::seconds(1000), now).find(pose(1)), std::string::npos);
}

TEST_F(HubTest, Metrics_HaveStateAndCounters) {
  hub_.note(Event::kConnected, "", {});
  say(R"({"class":"POSE","seq":7,"t":1,"x":0.5,"y":2,"theta":0,"state":"fix","p_wrong":0.25})");
  say("{\"class\":\"STATUS\",\"t\":1,\"lidar\":{\"state\":\"running\"},\"counters\":{\"scans\":12}"
      "}");
  const std::string text = metrics_text(hub_);
  for (const char* line : {"cornerd_up 1\n", "cornerd_pose_state{state=\"fix\"} 1\n",
                           "cornerd_pose_state{state=\"lost\"} 0\n", "cornerd_pose_x_meters 0.5\n",
                           "cornerd_pose_wrong_probability 0.25\n",
                           "# TYPE cornerd_scans_total counter\ncornerd_scans_total 12\n"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line << text;
  }
}

}  // namespace
}  // namespace cornerd::web
