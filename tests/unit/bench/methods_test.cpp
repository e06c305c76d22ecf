// SPDX-License-Identifier: MIT
#include "bench/methods.hpp"

#include <gtest/gtest.h>

#include <set>

namespace cornerd::bench {
namespace {

TEST(Methods, EachName_IsUniqueAndFound) {
  std::set<std::string_view> names;
  for (const auto methods : {paper_methods(), variants()}) {
    for (const NamedMethod& method : methods) {
      EXPECT_TRUE(names.insert(method.name).second) << method.name;
      EXPECT_EQ(find_method(method.name), &method);
    }
  }
  EXPECT_TRUE(names.contains("altbd"));
  EXPECT_EQ(find_method("guess"), nullptr);
}

}  // namespace
}  // namespace cornerd::bench
