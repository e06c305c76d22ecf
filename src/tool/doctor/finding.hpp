// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

namespace cornerd::tool {

enum class Verdict : unsigned char {
  kGood,
  kNote,   ///< no fault, but worth knowing
  kWrong,  ///< prevents poses now or soon
};

/// One result of a check.
struct Finding {
  Verdict verdict = Verdict::kGood;
  std::string subject;  ///< one word: "port"
  std::string what;
  std::vector<std::string> remedies{};  ///< one line each
};

/// Removes the good findings of a subject that also has a wrong one.
void drop_overruled(std::vector<Finding>& findings);

/// One line for each finding and each remedy.
std::string findings_text(std::span<const Finding> findings);

std::size_t count_wrong(std::span<const Finding> findings);

}  // namespace cornerd::tool
