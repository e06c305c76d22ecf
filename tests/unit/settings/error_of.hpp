// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "settings/config.hpp"

namespace cornerd::settings {

/// The message of the SettingsError that `act` must throw; one line in any case.
inline std::string error_of(const auto& act) {
  try {
    act();
  } catch (const SettingsError& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    return what;
  }
  ADD_FAILURE() << "no SettingsError";
  return {};
}

}  // namespace cornerd::settings
