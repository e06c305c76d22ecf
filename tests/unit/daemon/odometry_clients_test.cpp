// SPDX-License-Identifier: MIT
#include "daemon/odometry_clients.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace cornerd::daemon {
namespace {

using message::OdometryReading;
using Verdict = OdometryClients::Verdict;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr core::TimeNs kStep_ns = 20'000'000;

class OdometryClientsTest : public ::testing::Test {
 protected:
  OdometryClientsTest() { summary_.enabled = summary_.present = true; }
  static OdometryReading wheels() {
    OdometryReading reading;
    reading.left = reading.right = 1;
    return reading;
  }
  static OdometryReading gyro() {
    OdometryReading reading;
    reading.gyro_rad_s = 0.1;
    return reading;
  }
  bool accepts(int connection, OdometryReading reading) {
    now_ns_ += kStep_ns;
    verdict_ = clients_.accept(connection, now_ns_, reading);
    return verdict_ == Verdict::kAccepted;
  }
  void update() { clients_.update(summary_.counters, now_ns_); }
  message::StatusFields described() {
    message::StatusFields status;
    status.odometry = &summary_;
    update();
    clients_.describe(status);
    return status;
  }

  OdometryClients clients_{/*expects_lines=*/true};
  Verdict verdict_ = Verdict::kAccepted;  ///< the last one
  core::OdometrySummary summary_;
  core::TimeNs now_ns_ = 0;
};

TEST_F(OdometryClientsTest, LinesThatNobodyAskedFor_AreNamedWhileTheyCome) {
  clients_ = OdometryClients(/*expects_lines=*/false);
  summary_.enabled = summary_.present = false;
  EXPECT_THAT(described().odometry_hint, IsEmpty());
  clients_.refuse({"unsupported", "/odometry/source of the config is not \"socket\""});
  now_ns_ += core::kNsPerSecond;
  const message::StatusFields status = described();
  EXPECT_THAT(std::string(status.odometry_hint), HasSubstr("/odometry/source"));
  EXPECT_EQ(status.odometry_fault, "odometry-refused");
  now_ns_ += core::kNsPerSecond;
  EXPECT_THAT(described().odometry_hint, IsEmpty());
}

TEST_F(OdometryClientsTest, OneClient_Accepted) {
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(accepts(7, wheels()));
  EXPECT_EQ(described().second_client, 0U);
  EXPECT_THAT(described().odometry_hint, IsEmpty());
}

TEST_F(OdometryClientsTest, SecondClient_RejectedCountedAndInHint) {
  for (int i = 0; i < 50; ++i) {
    EXPECT_TRUE(accepts(7, wheels()));
    EXPECT_FALSE(accepts(8, wheels()));
  }
  EXPECT_EQ(described().second_client, 50U);
  EXPECT_THAT(std::string(described().odometry_hint), HasSubstr("two clients"));
  EXPECT_EQ(described().odometry_fault, "odometry-second-client");
  for (int i = 0; i < 5; ++i) static_cast<void>(described());
  EXPECT_THAT(described().odometry_hint, IsEmpty()) << "the hint expires";
}

TEST_F(OdometryClientsTest, WheelsAndGyroOfDifferentClients_BothAccepted) {
  for (int i = 0; i < 50; ++i) {
    EXPECT_TRUE(accepts(7, wheels()));
    EXPECT_TRUE(accepts(8, gyro()));
  }
  OdometryReading both = wheels();
  both.gyro_rad_s = 0.2;
  EXPECT_EQ(clients_.accept(8, now_ns_, both), Verdict::kFirstRejection);
  EXPECT_FALSE(both.left || both.right);
  EXPECT_EQ(both.gyro_rad_s, 0.2);
}

TEST_F(OdometryClientsTest, FirstClientDisconnectsOrIsSilent_NextAccepted) {
  EXPECT_TRUE(accepts(7, wheels()));
  EXPECT_FALSE(accepts(8, wheels()));
  clients_.disconnect(7);
  EXPECT_TRUE(accepts(8, wheels()));
  EXPECT_THAT(described().odometry_hint, IsEmpty()) << "a handover is no fault";
  EXPECT_FALSE(accepts(7, wheels())) << "another client with the same number";
  now_ns_ += OdometryClients::kSilenceTimeout_ns;
  EXPECT_TRUE(accepts(7, wheels()));
}

TEST_F(OdometryClientsTest, RejectedClient_FirstRejectionOncePerConnection) {
  EXPECT_TRUE(accepts(7, wheels()));
  EXPECT_FALSE(accepts(8, wheels()));
  EXPECT_EQ(verdict_, Verdict::kFirstRejection);
  EXPECT_FALSE(accepts(8, wheels()));
  EXPECT_EQ(verdict_, Verdict::kRejected);
  clients_.disconnect(8);
  EXPECT_FALSE(accepts(8, wheels()));
  EXPECT_EQ(verdict_, Verdict::kFirstRejection);
}

TEST_F(OdometryClientsTest, FirstClientSendsOneWheel_ReplacedByCompleteClient) {
  OdometryReading left;
  left.left = 1;
  EXPECT_TRUE(accepts(7, left));
  core::TimeNs taken_ns = 0;
  for (int i = 0; i < 500 && taken_ns == 0; ++i) {
    EXPECT_TRUE(accepts(7, left));
    if (accepts(8, wheels())) taken_ns = now_ns_;
  }
  EXPECT_NEAR(core::to_seconds(taken_ns), core::to_seconds(OdometryClients::kUselessTimeout_ns),
              0.1);
  for (int i = 0; i < 500; ++i) {
    EXPECT_FALSE(accepts(7, left));
    EXPECT_TRUE(accepts(8, wheels()));
  }
}

TEST_F(OdometryClientsTest, TwoClientsWithOneWheelEach_FirstStays) {
  OdometryReading left;
  left.left = 1;
  OdometryReading right;
  right.right = 1;
  for (int i = 0; i < 500; ++i) {
    EXPECT_TRUE(accepts(7, left));
    EXPECT_FALSE(accepts(8, right));
  }
}

// No STATUS is written here: who is used does not depend on it.
TEST_F(OdometryClientsTest, FirstClientAlwaysRejected_Replaced) {
  update();
  int taken = 0;
  for (int i = 0; i < 400; ++i) {
    EXPECT_TRUE(accepts(7, wheels()));
    ++summary_.counters.past;
    if (i % 50 == 49) update();
    taken += accepts(8, wheels()) ? 1 : 0;
    if (taken > 0) break;
  }
  EXPECT_EQ(taken, 1);
  // The second client, whose lines are accepted, stays selected.
  for (int i = 0; i < 1000; ++i) {
    EXPECT_TRUE(accepts(8, wheels()));
    EXPECT_FALSE(accepts(7, wheels()));
    if (i % 50 == 49) update();
  }
}

TEST_F(OdometryClientsTest, FirstClientBrieflyRejected_Stays) {
  update();
  for (int i = 0; i < 1000; ++i) {
    EXPECT_TRUE(accepts(7, wheels()));
    if (i >= 200 && i < 250) ++summary_.counters.past;
    EXPECT_FALSE(accepts(8, wheels()));
    if (i % 25 == 24) update();
  }
}

TEST_F(OdometryClientsTest, GyroAlwaysRejected_OnlyGyroReplaced) {
  update();
  bool is_taken = false;
  for (int i = 0; i < 400 && !is_taken; ++i) {
    OdometryReading both = wheels();
    both.gyro_rad_s = 100;
    EXPECT_TRUE(accepts(7, both));
    ++summary_.counters.invalid_rates;
    if (i % 50 == 49) update();
    is_taken = accepts(8, gyro());
  }
  EXPECT_TRUE(is_taken);
  EXPECT_TRUE(accepts(7, wheels()));
}

TEST_F(OdometryClientsTest, MissingFields_InHint) {
  summary_.present = false;
  static_cast<void>(described());
  for (int i = 0; i < 50; ++i) EXPECT_TRUE(accepts(7, gyro()));
  EXPECT_THAT(std::string(described().odometry_hint), HasSubstr("lack left and right"));
}

}  // namespace
}  // namespace cornerd::daemon
