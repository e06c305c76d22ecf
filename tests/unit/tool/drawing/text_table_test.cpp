// SPDX-License-Identifier: MIT
#include "tool/drawing/text_table.hpp"

#include <gtest/gtest.h>

namespace cornerd::tool {
namespace {

TEST(TextTable, Columns_AreAsWideAsTheirWidestCell) {
  TextTable table;
  table.add_row({"method", "mm"});
  table.add_row({"lt", "10.25", "x"});
  EXPECT_EQ(table.text(), "  method  mm\n  lt      10.25  x\n");
  EXPECT_EQ(table.text(/*numbers=*/true), "  method     mm\n  lt      10.25  x\n");
}

TEST(TextTable, NoRows_IsEmpty) { EXPECT_EQ(TextTable().text(), ""); }

TEST(Formatted, Values_AreInserted) { EXPECT_EQ(formatted("%.1f of %d", 2.25, 3), "2.2 of 3"); }

}  // namespace
}  // namespace cornerd::tool
