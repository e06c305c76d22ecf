// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "error_of.hpp"

namespace cornerd::settings {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

struct Wrong {
  const char* text;     ///< "MAP" stands for a map
  const char* message;  ///< part of the error
};
void PrintTo(const Wrong& wrong, std::ostream* out) { *out << wrong.text; }

class WrongConfig : public testing::TestWithParam<Wrong> {};

TEST_P(WrongConfig, Error_NamesFilePointerAndReason) {
  std::string text = GetParam().text;
  if (const std::size_t at = text.find("MAP"); at != std::string::npos) {
    text.replace(at, 3, R"("map": "/m")");
  }
  const std::string error = error_of([&] { parse_config(text, "/etc/cornerd.json"); });
  EXPECT_THAT(error, StartsWith("/etc/cornerd.json: "));
  EXPECT_THAT(error, HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    UnknownKey, WrongConfig,
    testing::Values(Wrong{R"({MAP, "lidar": {"devise": "/dev/ttyS1"}})",
                          ": /lidar/devise: unknown key; did you mean \"device\"?"},
                    Wrong{R"({MAP, "Lidar": {}})", "/Lidar: unknown key; did you mean \"lidar\"?"},
                    Wrong{R"({MAP, "socket": {"port": 1}})", "/socket/port"},
                    Wrong{R"({MAP, "advanced": {"realtime": {"colour": 1}}})",
                          "/advanced/realtime/colour: unknown key; known here: priority, "
                          "lock_memory"},
                    Wrong{R"({MAP, "odometry": {"sorce": {"a": 1}}})", "mean \"source\"?"}));

INSTANTIATE_TEST_SUITE_P(
    WrongType, WrongConfig,
    testing::Values(
        Wrong{R"({"map": 3})", "/map: must be a string"},
        Wrong{R"({"map": ""})", "/map: must not be empty"},
        Wrong{R"({"map": "auto"})", "/map: \"auto\" chooses one of \"maps\", and there are none"},
        Wrong{R"({MAP, "lidar": []})", "/lidar: must be an object"},
        Wrong{R"({MAP, "advanced": 1})", "/advanced: must be an object"},
        Wrong{R"({MAP, "advanced": {"lidar": {"baud": "fast"}}})",
              "/baud: must be \"auto\", or 1200"},
        Wrong{R"({MAP, "advanced": {"lidar": {"baud": 115200.5}}})", "must be \"auto\", or 1200"},
        Wrong{R"({MAP, "lidar": {"loop": 1}})", "/lidar/loop: must be true or false"},
        Wrong{R"({MAP, "lidar": {"mount": {"x": null}}})", "/lidar/mount/x: must be a number"},
        Wrong{"[]", "cornerd.json: must be an object"}));

INSTANTIATE_TEST_SUITE_P(
    OutOfRange, WrongConfig,
    testing::Values(
        Wrong{R"({MAP, "advanced": {"realtime": {"priority": 100}}})",
              "/advanced/realtime/priority: must be from 0 to 99, not 100"},
        Wrong{R"({MAP, "lidar": {"mount": {"theta": 90}}})", "/lidar/mount/theta: must be from"},
        Wrong{R"({MAP, "odometry": {"track": 0}})",
              "/odometry/track: must be from 0.001 to 10 metres"},
        Wrong{R"({MAP, "lidar": {"speed": "slow"}})",
              "/lidar/speed: must be a number from 0.001 to 1000, or \"max\""},
        Wrong{R"({MAP, "lidar": {"speed": 0}})", "/lidar/speed: "},
        Wrong{R"({MAP, "advanced": {"localizer": {"updates_per_scan": 17}}})", "from 1 to 16"},
        Wrong{R"({MAP, "odometry": {"source": "wheels"}})",
              R"(must be one of "none", "socket", "kernel")"},
        Wrong{R"({MAP, "advanced": {"lidar": {"baud": 300}}})",
              "/advanced/lidar/baud: must be \"auto\", or 1200 to 4000000"}));

INSTANTIATE_TEST_SUITE_P(
    Contradiction, WrongConfig,
    testing::Values(Wrong{"{}", ": /map: is missing"},
                    Wrong{R"({MAP, "advanced": {"odometry": {"counter_max": 2}}})",
                          "/advanced/odometry/counter_max: must be 0 (never wraps) or at least 3"},
                    Wrong{R"({MAP, "advanced": {"lidar": {"min_range": 5, "max_range": 5}}})",
                          "/advanced/lidar/max_range: must be more than min_range, 5"},
                    Wrong{R"({MAP, "lidar": {"driver": "replay"}})", "/lidar/file: is missing"},
                    Wrong{R"({MAP, "socket": {"pose": "/a", "control": "/a"}})", "/socket/control"},
                    Wrong{R"({MAP, "advanced": {"odometry": {"kernel": {"left": {"counter": "a"},
                 "right": {"counter": "a"}}}}})",
                          "/advanced/odometry/kernel/right: must not be the same as left"}));

INSTANTIATE_TEST_SUITE_P(
    Motor, WrongConfig,
    testing::Values(Wrong{R"({MAP, "advanced": {"lidar": {"motor": "rts"}}})",
                          R"(/lidar/motor: must be one of "dtr", "none")"},
                    Wrong{R"({MAP, "advanced": {"lidar": {"motor": 7}}})", "/lidar/motor: must"},
                    Wrong{R"({MAP, "advanced": {"lidar": {"motor": {}}}})",
                          "/lidar/motor/kind: is missing"},
                    Wrong{R"({MAP, "advanced": {"lidar": {"motor": {"kind": "gpio"}}}})",
                          "/lidar/motor/path: is missing"},
                    Wrong{R"({MAP, "advanced": {"lidar": {"motor": {"kind": "gpio", "path": "/p",
                             "duty": 1}}}})",
                          "/lidar/motor/duty: unknown key"}));

INSTANTIATE_TEST_SUITE_P(
    Schema1, WrongConfig,
    testing::Values(
        Wrong{R"({MAP, "odometry": {"ceiling": 65535}})",
              ": /odometry/ceiling: moved; write /advanced/odometry/counter_max instead"},
        Wrong{R"({MAP, "lidar": {"baud": 115200}})",
              "/lidar/baud: moved; write /advanced/lidar/baud instead"},
        Wrong{R"({MAP, "lidar": {"motor": {"kind": "gpio"}}})", "write /advanced/lidar/motor"},
        Wrong{R"({MAP, "odometry": {"start": {"delay": 0.1}}})",
              "/odometry/start/delay: moved; write /advanced/odometry/initial/delay instead"},
        Wrong{R"({MAP, "odometry": {"noise": {"delay": 0.1}}})", "/odometry/initial_sigma/delay"},
        Wrong{R"({MAP, "detector": {"extraction": {"look_beyond": 3}}})",
              "write /advanced/detector/extraction/occlusion_samples instead"},
        Wrong{R"({MAP, "realtime": {}})", "/realtime: moved; write /advanced/realtime instead"},
        Wrong{R"({MAP, "detector": {"method": "lt"}})", "/detector/method: removed; "},
        Wrong{R"({MAP, "detector": {"lt": {}}})", "/detector/lt: removed: cornerd-bench"},
        Wrong{R"({MAP, "odometry": {"mode": "filter"}})", "/odometry/mode: removed: "}));

}  // namespace
}  // namespace cornerd::settings
