// SPDX-License-Identifier: MIT
// Every lidar of the table through cornerd, on a pseudo-terminal at the wire's true rate, driving.
// Prints a table of poses and of faults:
//   build/test/tests/system_daemon --gtest_filter='*LidarModel*' | grep '^|'
#include "drivers/config/lidar_models.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "daemon_process.hpp"
#include "emulated_model.hpp"
#include "room_recording.hpp"

namespace cornerd::system_test {
namespace {

constexpr double kWrong_m = 0.1;
constexpr double kWrong_rad = core::radians(5);

std::string driver_name(drivers::DriverKind kind) {
  if (kind == drivers::DriverKind::kLd) return "ld";
  return kind == drivers::DriverKind::kYdlidar ? "ydlidar" : "rplidar";
}

class LidarModelTest : public DaemonTest {
 protected:
  void launch(const std::string& model, const std::filesystem::path& map,
              const std::vector<std::string>& more = {}) {
    const drivers::LidarModel& row = *drivers::find_lidar_model(model);
    std::vector<std::string> arguments = with_config();
    std::vector<std::string> overrides = {"/lidar/driver=" + driver_name(row.driver),
                                          "/lidar/device=" + port().string(),
                                          "/map=" + map.string()};
    overrides.insert(overrides.end(), more.begin(), more.end());
    for (const std::string& text : overrides) {
      arguments.emplace_back("--set");
      arguments.push_back(text);
    }
    daemon_ = std::make_unique<DaemonProcess>(arguments, folder_ / "log");
    client_ = std::make_unique<TestClient>(connect());
    client_->send(R"({"class":"WATCH","classes":["POSE","STATUS"]})"
                  "\n");
  }
  std::filesystem::path port() const { return folder_ / "lidar"; }

  json wait_for_fault(const std::string& fault) {
    return next_of(*client_, "STATUS",
                   [&](const json& status) { return status["lidar"].value("fault", "") == fault; });
  }

  std::unique_ptr<EmulatedModel> lidar_;
  std::unique_ptr<DaemonProcess> daemon_;
  std::unique_ptr<TestClient> client_;
};

struct Place {
  const char* map;
  std::vector<core::Vec2> path;
};

const Place kArena = {"krpai-2019-a.json", {{0.3, 0.3}, {0.9, 0.3}}};
const Place kFlat = {"flat-7.json", {{1.65, 2.7}, {1.0, 2.7}, {1.3, 0.8}, {3.3, 0.8}}};

class EveryLidarModel : public LidarModelTest,
                        public testing::WithParamInterface<std::tuple<const char*, Place>> {};

TEST_P(EveryLidarModel, DriveThroughMap_GivesFixesAndNoneWrong) {
  const auto& [model, place] = GetParam();
  const std::filesystem::path map =
      std::filesystem::path(CORNERD_SOURCE_DIR) / "config/maps" / place.map;
  replay::DriveConfig drive;
  drive.loop = true;
  drive.acceleration_m_s2 = 0.5;  // as a small robot; at once is beyond any
  drive.yaw_acceleration_rad_s2 = 3;
  lidar_ =
      std::make_unique<EmulatedModel>(model, map, replay::drive_path(place.path, drive), port());
  launch(model, map);
  wait_for_fix(*client_);
  constexpr int kPoses = 100;
  int fixes = 0;
  int wrong = 0;
  double sum_m = 0;
  for (int i = 0; i < kPoses; ++i) {
    const json pose = next_of(*client_, "POSE");
    ASSERT_TRUE(pose.is_object()) << "no message within a minute";
    const std::string state = pose["state"];
    if (state == "fix") ++fixes;
    if (state != "fix" && state != "tracking") continue;
    const auto truth = lidar_->true_pose(pose["t"]);
    ASSERT_TRUE(truth);
    const double off_m =
        std::hypot(pose["x"].get<double>() - truth->x_m, pose["y"].get<double>() - truth->y_m);
    const double off_rad =
        std::abs(core::angle_between(truth->theta_rad, pose["theta"].get<double>()));
    if (off_m > kWrong_m || off_rad > kWrong_rad) {
      ++wrong;
      ADD_FAILURE() << "off by " << off_m << " m, " << off_rad << " rad: " << pose.dump();
    }
    sum_m += off_m;
  }
  EXPECT_GE(fixes, kPoses - 1) << "99 %";
  std::printf("| %-7s | %-17s | %3d of %d | %d wrong | %4.1f mm |\n", model, place.map, fixes,
              kPoses, wrong, 1e3 * sum_m / kPoses);
}

INSTANTIATE_TEST_SUITE_P(Places, EveryLidarModel,
                         testing::Combine(testing::Values("a1", "a2m8", "a2m12", "a3", "c1", "s1",
                                                          "s2", "s3", "ld06", "ld19", "stl19p",
                                                          "stl27l", "x4", "x2"),
                                          testing::Values(kArena, kFlat)),
                         [](const auto& instance) {
                           const bool is_flat = std::get<1>(instance.param).map == kFlat.map;
                           return std::string(std::get<0>(instance.param)) +
                                  (is_flat ? "InFlat" : "InArena");
                         });

class LidarModelFaults : public LidarModelTest, public testing::WithParamInterface<const char*> {
 protected:
  void plug_in() {
    lidar_.reset();
    lidar_ =
        std::make_unique<EmulatedModel>(GetParam(), folder_ / "map.json",
                                        replay::stand_still({kTrueX, kTrueY, kTrueTheta}), port());
  }
  void start() {
    plug_in();
    launch(GetParam(), folder_ / "map.json");
    wait_for_fix(*client_);
  }
  void expect(const std::string& fault, const std::string& state) {
    const json status = wait_for_fault(fault);
    ASSERT_TRUE(status.is_object()) << "no " << fault << " within a minute";
    EXPECT_EQ(status["lidar"]["state"], state);
    EXPECT_FALSE(status["lidar"]["detail"].get<std::string>().empty());
    std::printf("| %-7s | %-15s | %-8s | %s |\n", GetParam(), fault.c_str(), state.c_str(),
                status["lidar"]["detail"].get<std::string>().c_str());
  }
  /// Poses from before the fault may still arrive until the answer.
  void expect_recovery() {
    client_->send("{\"class\":\"POLL\",\"id\":\"now\"}\n");
    next_of(*client_, "OK", [](const json& ok) { return ok.value("id", "") == "now"; });
    wait_for_fix(*client_);
  }
  json counters() {
    json status = next_of(*client_, "STATUS");
    return status["counters"];
  }
};

TEST_F(LidarModelTest, ConfigWithoutNoise_UsesTheModels) {
  lidar_ = std::make_unique<EmulatedModel>(
      "c1", folder_ / "map.json", replay::stand_still({kTrueX, kTrueY, kTrueTheta}), port());
  launch("c1", folder_ / "map.json");
  wait_for_fix(*client_);
  for (int i = 0; i < 5 && daemon_->output().find("lidar noise") == std::string::npos; ++i) {
    next_of(*client_, "STATUS");
  }
  EXPECT_NE(daemon_->output().find("lidar noise: that of model c1"), std::string::npos);
  wait_for_fix(*client_);
}

TEST_P(LidarModelFaults, Unplugged_PluggedInAgain_Recovers) {
  start();
  lidar_.reset();
  expect("unplugged", "backoff");
  plug_in();
  expect_recovery();
}

TEST_P(LidarModelFaults, WrongBaud_Corrected_Recovers) {
  plug_in();
  launch(GetParam(), folder_ / "map.json", {"/advanced/lidar/baud=57600"});
  // An X4 is silent until it understands a request.
  const bool is_silent = std::string(GetParam()) == "x4";
  expect(is_silent ? "no-answer" : "wrong-baud", "backoff");
  lidar_->expect_speed(57600);
  expect_recovery();
}

TEST_P(LidarModelFaults, Garbage_IsNamedAndOver_Recovers) {
  start();
  lidar_->set_fault(LineFault::kGarbage);
  expect("unexpected-data", "backoff");
  lidar_->set_fault(LineFault::kNone);
  expect_recovery();
}

TEST_P(LidarModelFaults, HalfFrames_AreCountedAndOver_Recovers) {
  start();
  const json before = counters();
  lidar_->set_fault(LineFault::kHalfFrames);
  json now = before;
  const auto damaged = [](const json& all) {
    return all["bad_checksums"].get<int>() + all["resyncs"].get<int>();
  };
  for (int i = 0; i < 20 && damaged(now) < damaged(before) + 10; ++i) now = counters();
  EXPECT_GE(damaged(now), damaged(before) + 10);
  lidar_->set_fault(LineFault::kNone);
  expect_recovery();
  now = counters();
  EXPECT_GT(now["skipped_bytes"].get<int>(), before["skipped_bytes"].get<int>());
}

TEST_P(LidarModelFaults, HeadHeld_Released_Recovers) {
  start();
  lidar_->set_fault(LineFault::kSilence);
  expect("motor-stalled", "faulty");
  lidar_->set_fault(LineFault::kNone);
  expect_recovery();
}

TEST_P(LidarModelFaults, Covered_SeesAgain_Recovers) {
  start();
  lidar_->cover(true);
  expect("dead-laser", "faulty");
  lidar_->cover(false);
  expect_recovery();
}

INSTANTIATE_TEST_SUITE_P(Drivers, LidarModelFaults,
                         testing::Values("a3", "c1", "s2", "ld19", "x4", "x2"),
                         [](const auto& instance) { return std::string(instance.param); });

}  // namespace
}  // namespace cornerd::system_test
