# SPDX-License-Identifier: MIT
# From a README of this project to the macros of man(7): headings, paragraphs, tables, indented code. A table
# becomes a list: its first column is the term, the others follow, with their headings where there are several.
# The title and a last section "Code" are left out.

function escape(text) {
  gsub(/\\/, "\\e", text)
  gsub(/-/, "\\-", text)
  gsub(/\*\*|`/, "", text)
  if (text ~ /^[.']/) text = "\\&" text
  return text
}

# Where a line of JSON may go on in the next one.
function breakable(text) {
  text = escape(text)
  gsub(/,/, ",\\:", text)
  return text
}

function row(line,    count, i, text) {
  gsub(/^\| *| *\|$/, "", line)
  count = split(line, cell, / *\| */)
  if (!in_table) {
    in_table = 1
    columns = count
    for (i = 1; i <= count; ++i) heading[i] = cell[i]
    return
  }
  if (cell[1] ~ /^-+$/) return
  text = ""
  for (i = 2; i <= columns; ++i) {
    if (cell[i] == "") continue
    if (heading[i] == "unit") {
      unit = " [" cell[i] "]"
      continue
    }
    text = text (text == "" ? "" : "; ") (columns > 3 ? heading[i] ": " : "") cell[i]
  }
  print ".TP\n.B \"" escape(cell[1]) unit "\"\n" escape(text)
  unit = ""
}

/^## Code/ { exit }
/^# / { next }
/^\|/ { row($0); next }
in_table { in_table = 0; print ".PP" }
/^#+ / { sub(/^#+ /, ""); print ".SH " toupper(escape($0)); next }
/^    / { sub(/^    /, ""); print ".RS 2\n" breakable($0) "\n.RE"; next }
/^$/ { print ".PP"; next }
{ print escape($0) }
