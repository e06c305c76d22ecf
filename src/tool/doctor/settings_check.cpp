// SPDX-License-Identifier: MIT
#include <cstdio>

#include "settings/document.hpp"
#include "settings/map_file.hpp"
#include "tool/doctor/checks.hpp"
#include "tool/drawing/text_table.hpp"

namespace cornerd::tool {

namespace {

constexpr std::size_t kMaxSettingsBytes = std::size_t{1} << 20;
/// A pattern needs three corners.
constexpr std::size_t kMinCorners = 3;
constexpr auto kDaemonFileKind = settings::FileKind::kOrdinary;

void check_config_file(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                       SettingsCheck& check) {
  const std::string text =
      file.empty() ? "{}" : settings::read_file(file, kMaxSettingsBytes, kDaemonFileKind);
  check.config = settings::parse_config(text, file, overrides, /*require_map=*/false);
  if (file.empty()) {
    check.findings.push_back({Verdict::kNote,
                              "config",
                              "none is installed or named: every key has its default",
                              {"name one: cornerctl doctor --config FILE"}});
  } else {
    check.findings.push_back({Verdict::kGood, "config", file.string()});
  }
}

void check_map_file(SettingsCheck& check) {
  const std::filesystem::path& file = check.config.map;
  if (file.empty()) {
    check.findings.push_back(
        {Verdict::kWrong,
         "map",
         "the config names none: no pose is possible",
         {R"(draw one (README.md, "Configure") and name it: "map": "/path/to/map.json")"}});
    return;
  }
  if (check.config.chooses_map()) {
    check.findings.push_back(
        {Verdict::kNote,
         "map",
         "\"auto\": the daemon's scans choose it, and what follows is about the "
         "first of \"maps\"",
         {"for another one: --set /map=NAME"}});
  }
  const auto map = settings::load_map(file, kDaemonFileKind);
  const core::Vec2 size = map->upper_right() - map->lower_left();
  Finding finding{
      Verdict::kGood, "map",
      file.string() + formatted(": %.3f x %.3f m, %zu walls, %zu corners", size.x(), size.y(),
                                map->plan().walls.size(), map->corners().size())};
  if (map->corners().size() < kMinCorners) {
    finding.verdict = Verdict::kWrong;
    finding.remedies = {"poses are recognised by corners: add the building's walls to the map"};
  }
  check.findings.push_back(finding);
}

/// Runs `body`; reports a SettingsError as a finding.
template <typename Body>
void record_error(SettingsCheck& check, const char* subject, const char* mend, const Body& body) {
  try {
    body();
  } catch (const settings::SettingsError& error) {
    check.findings.push_back({Verdict::kWrong, subject, error.what(), {mend}});
    if (!check.error) check.error = std::current_exception();
  }
}

}  // namespace

SettingsCheck check_settings(const std::filesystem::path& file,
                             const std::vector<std::string>& overrides) {
  SettingsCheck check;
  record_error(check, "config",
               "correct it there; cornerd.full.json describes every key; the checks below use the "
               "defaults",
               [&] { check_config_file(file, overrides, check); });
  if (check.error) return check;
  record_error(check, "map", "correct it there; cornerctl map check FILE validates it",
               [&] { check_map_file(check); });
  return check;
}

}  // namespace cornerd::tool
