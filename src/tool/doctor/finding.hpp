// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

namespace cornerd::tool {

enum class Verdict : unsigned char {
  kGood,
  kNote,   ///< no fault, but worth knowing
  kWrong,  ///< keeps the pose away, or will
};

/// What one check has to say.
struct Finding {
  Verdict verdict = Verdict::kGood;
  std::string subject;  ///< one word: "port"
  std::string what;
  std::vector<std::string> remedies{};  ///< what to do about it, a line each
};

/// Leaves out the good findings of subjects that another finding has wrong: a map that its reader
/// may read is not "ok" where the service may not.
void drop_overruled(std::vector<Finding>& findings);

/// A line for each finding and for each way to mend it.
std::string findings_text(std::span<const Finding> findings);

std::size_t count_wrong(std::span<const Finding> findings);

}  // namespace cornerd::tool
