// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "doctor/stand_in.hpp"
#include "tool/doctor/checks.hpp"

namespace cornerd::tool {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Ten scans of walls at 2 m; the config's noise is 20 mm there, the map's sigma 10 mm.
class CheckResiduals : public testing::Test {
 protected:
  CheckResiduals() {
    patient().config.map = CORNERD_SOURCE_DIR "/config/maps/flat-7.json";
    patient().config.lidar.noise.sensor.share = 0.01;
    patient().daemon.scan_returns_m.assign(1000, 2.0F);
  }
  Patient& patient() { return stand_in_.patient; }
  std::vector<Finding> check(double rmse_m, std::size_t scans = 10) {
    patient().daemon.rmse_m.assign(scans, rmse_m);
    return check_residuals(patient());
  }
  StandIn stand_in_;
};

TEST_F(CheckResiduals, ThoseOfTheNoise_AreGood) {
  EXPECT_THAT(check(0.017), ElementsAre(Finds(Verdict::kGood, "noise", "17.0 mm")));
  EXPECT_THAT(check(0.041), ElementsAre(Finds(Verdict::kGood, "noise", "20.0 mm")));
}

TEST_F(CheckResiduals, Larger_AreNoted) {
  EXPECT_THAT(check(0.043), ElementsAre(Finds(Verdict::kNote, "noise", "less exact")));
}

TEST_F(CheckResiduals, MuchSmaller_AreNoted) {
  EXPECT_THAT(check(0.003), ElementsAre(Finds(Verdict::kNote, "noise", "more exact")));
}

TEST_F(CheckResiduals, FewScans_AreNotJudged) { EXPECT_THAT(check(0.043, 4), IsEmpty()); }

TEST_F(CheckResiduals, NoNoiseInConfig_ThatOfTheModelIsCompared) {
  patient().config.lidar.noise = {};
  patient().daemon.status.emplace().lidar_model = "S2M1";
  EXPECT_THAT(check(0.006), ElementsAre(Finds(Verdict::kGood, "noise", "lidar's model: 6.5 mm")));
  EXPECT_THAT(check(0.3), ElementsAre(Finds(Verdict::kNote, "noise", "less exact")));
  patient().daemon.status->lidar_model = "A1M8";
  EXPECT_THAT(check(0.008), ElementsAre(Finds(Verdict::kGood, "noise", "lidar's model: 10.0 mm")));
  patient().daemon.status.reset();
  EXPECT_THAT(check(0.008), ElementsAre(Finds(Verdict::kGood, "noise", "10.0 mm")));
}

TEST_F(CheckResiduals, NoMap_IsAnotherChecksFinding) {
  patient().config.map = "absent.json";
  EXPECT_THAT(check(0.3), IsEmpty());
}

TEST_F(CheckResiduals, ReturnsBeyondTheRange_AreNoted) {
  patient().config.lidar.max_range_m = 3;
  EXPECT_THAT(check_range(patient()), IsEmpty());
  patient().daemon.scan_returns_m.resize(1040, 7.2F);
  EXPECT_THAT(check_range(patient()), IsEmpty()) << "a few are mirages";
  patient().daemon.scan_returns_m.resize(1500, 7.2F);
  EXPECT_THAT(check_range(patient()),
              ElementsAre(Finds(Verdict::kNote, "range",
                                "33 % of the lidar's returns, up to 7.2 m, are beyond "
                                "advanced.lidar.max_range, 3 m")));
  patient().daemon.scan_returns_m.clear();
  EXPECT_THAT(check_range(patient()), IsEmpty());
}

}  // namespace
}  // namespace cornerd::tool
