// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "doctor/stand_in.hpp"
#include "tool/doctor/checks.hpp"

namespace cornerd::tool {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kConfig = "/etc/cornerd/cornerd.json";

class CheckReading : public testing::Test {
 protected:
  CheckReading() {
    stand_in_.write("/etc/passwd", "cornerd:x:990:990::/:/bin/false\n");
    stand_in_.write("/lib/systemd/system/cornerd.service",
                    "[Service]\nProtectHome=yes\nPrivateTmp=yes\n");
    stand_in_.patient.config_file = kConfig;
    stand_in_.patient.config_name = kConfig;
    put(kConfig);
    use_map("/srv/maps/home.json");
  }
  void put(const std::string& file) const {
    stand_in_.write(file);
    stand_in_.allow(file, 0644);
    for (std::filesystem::path folder = file; folder != "/";) {
      folder = folder.parent_path();
      stand_in_.allow(folder, 0755);
    }
  }
  void use_map(const std::string& file) {
    put(file);
    stand_in_.patient.config.map = file;
  }
  std::vector<Finding> findings() const { return check_reading(stand_in_.patient); }
  StandIn stand_in_;
};

TEST_F(CheckReading, WorldReadableFiles_AreGood) {
  EXPECT_THAT(findings(), ElementsAre(Finds(Verdict::kGood, "reading", "user cornerd may read")));
}

TEST_F(CheckReading, NoServiceUser_NoFinding) {
  stand_in_.allow(kConfig, 0600);
  stand_in_.write("/etc/passwd", "ada:x:1000:1000::/:/bin/sh\n");
  EXPECT_THAT(findings(), IsEmpty());
}

TEST_F(CheckReading, FileReadableByRootOnly_IsWrong) {
  stand_in_.allow(kConfig, 0600);
  stand_in_.allow("/srv/maps/home.json", 0640);
  const auto found = findings();
  ASSERT_THAT(found, ElementsAre(Finds(Verdict::kWrong, "config", "must not read it (-rw-------"),
                                 Finds(Verdict::kWrong, "map", "must not read it (-rw-r-----")));
  EXPECT_THAT(found[0].remedies, ElementsAre("sudo chmod a+r /etc/cornerd/cornerd.json"));
}

TEST_F(CheckReading, FolderWithoutAccess_IsNamed) {
  stand_in_.allow("/srv", 0750);
  const auto found = findings();
  ASSERT_THAT(found, ElementsAre(Finds(Verdict::kWrong, "map",
                                       "/srv/maps/home.json: the service's user cornerd must not "
                                       "enter /srv (drwxr-x---")));
  EXPECT_THAT(found[0].remedies,
              ElementsAre("sudo install -m 644 /srv/maps/home.json /etc/cornerd/",
                          "and, in /etc/cornerd/cornerd.json: \"map\": \"/etc/cornerd/home.json\"",
                          "or open the folder: sudo chmod a+x /srv"));
}

TEST_F(CheckReading, HomesAndTemporaryFolders_AreHiddenFromService) {
  for (const std::string folder : {"/home", "/root", "/run/user", "/tmp", "/var/tmp"}) {
    use_map(folder + "/ada/home.json");
    const auto found = findings();
    ASSERT_THAT(found, ElementsAre(Finds(Verdict::kWrong, "map", "cannot see " + folder)));
    EXPECT_THAT(found[0].remedies[0],
                HasSubstr("sudo install -m 644 " + folder + "/ada/home.json"));
  }
  use_map("/homes/ada/home.json");
  EXPECT_THAT(findings(), ElementsAre(Finds(Verdict::kGood, "reading", "")));
}

TEST_F(CheckReading, LinkIntoHome_IsFollowed) {
  put("/home/ada/home.json");
  stand_in_.link("/etc/cornerd/map.json", "/home/ada/home.json");
  stand_in_.patient.config.map = "/etc/cornerd/map.json";
  EXPECT_THAT(findings(), ElementsAre(Finds(Verdict::kWrong, "map", "cannot see /home")));
}

TEST_F(CheckReading, LinkedHomes_AreHiddenByBothNames) {
  put("/data/homes/ada/home.json");
  stand_in_.link("/home", "data/homes");
  stand_in_.patient.config.map = "/home/ada/home.json";
  EXPECT_THAT(findings(), ElementsAre(Finds(Verdict::kWrong, "map", "cannot see /home")));
  stand_in_.patient.config.map = "/data/homes/ada/home.json";
  EXPECT_THAT(findings(), ElementsAre(Finds(Verdict::kWrong, "map", "cannot see /home")));
}

TEST_F(CheckReading, UnitWithoutProtectHome_IsGood) {
  use_map("/home/ada/home.json");
  stand_in_.write("/etc/systemd/system/cornerd.service.d/override.conf",
                  "[Service]\nProtectHome=read-only\n");
  EXPECT_THAT(findings(), ElementsAre(Finds(Verdict::kGood, "reading", "")));
}

TEST_F(CheckReading, DaemonOfAnotherUser_NoFinding) {
  stand_in_.allow(kConfig, 0600);
  stand_in_.run_process(9, "cornerd");
  EXPECT_THAT(findings(), IsEmpty());
}

TEST_F(CheckReading, RecordingInsteadOfLidar_IsChecked) {
  stand_in_.patient.config.lidar.driver = settings::DriverKind::kReplay;
  stand_in_.patient.config.lidar.file = "/tmp/a.bin";
  put("/tmp/a.bin");
  EXPECT_THAT(findings(), ElementsAre(Finds(Verdict::kWrong, "recording", "cannot see /tmp")));
}

TEST_F(CheckReading, MissingFile_NoFinding) {
  stand_in_.patient.config.map = "/nowhere/home.json";
  EXPECT_THAT(findings(), ElementsAre(Finds(Verdict::kGood, "reading", "")));
}

}  // namespace
}  // namespace cornerd::tool
