// SPDX-License-Identifier: MIT
#include "tool/doctor/finding.hpp"

#include <algorithm>
#include <set>

namespace cornerd::tool {

namespace {

constexpr std::size_t kVerdictWidth = 7;
constexpr std::size_t kSubjectWidth = 10;

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(text.size() + 1, width), ' ');
  return text;
}

const char* verdict_word(Verdict verdict) {
  switch (verdict) {
    case Verdict::kGood:
      return "ok";
    case Verdict::kNote:
      return "note";
    case Verdict::kWrong:
      return "WRONG";
  }
  return "";
}

}  // namespace

void drop_overruled(std::vector<Finding>& findings) {
  std::set<std::string> wrong;
  for (const Finding& finding : findings) {
    if (finding.verdict == Verdict::kWrong) wrong.insert(finding.subject);
  }
  std::erase_if(findings, [&](const Finding& finding) {
    return finding.verdict == Verdict::kGood && wrong.contains(finding.subject);
  });
}

std::string findings_text(std::span<const Finding> findings) {
  std::string text;
  for (const Finding& finding : findings) {
    text += padded(verdict_word(finding.verdict), kVerdictWidth) +
            padded(finding.subject, kSubjectWidth) + finding.what + '\n';
    for (const std::string& mend : finding.remedies) {
      text += std::string(kVerdictWidth + kSubjectWidth, ' ') + "-> " + mend + '\n';
    }
  }
  return text;
}

std::size_t count_wrong(std::span<const Finding> findings) {
  return static_cast<std::size_t>(
      std::count_if(findings.begin(), findings.end(),
                    [](const Finding& finding) { return finding.verdict == Verdict::kWrong; }));
}

}  // namespace cornerd::tool
