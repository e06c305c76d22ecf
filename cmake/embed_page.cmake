# Writes a C++ source with the files of the page.
#   cmake -D OUTPUT=FILE.cpp -D FOLDER=DIR -D FILES=index.html,a.js -P embed_page.cmake
set(types ".html=text/html" ".js=text/javascript" ".css=text/css" ".svg=image/svg+xml")
set(contents "")
set(entries "")
string(REPLACE "," ";" FILES "${FILES}")
foreach(file IN LISTS FILES)
  file(READ ${FOLDER}/${file} hex HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${hex}")
  list(LENGTH names index)
  list(APPEND names ${file})
  get_filename_component(ending ${file} LAST_EXT)
  foreach(type IN LISTS types)
    if(type MATCHES "^${ending}=(.*)")
      set(content_type "${CMAKE_MATCH_1}; charset=utf-8")
    endif()
  endforeach()
  set(path /${file})
  if(file STREQUAL "index.html")
    set(path /)
  endif()
  string(APPEND contents "constexpr char kFile${index}[] = {${bytes}};\n")
  string(APPEND entries
    "    {\"${path}\", \"${content_type}\", {kFile${index}, sizeof kFile${index}}},\n")
endforeach()
file(WRITE ${OUTPUT} "#include \"web/page.hpp\"\n
namespace cornerd::web {\nnamespace {\n${contents}
constexpr PageFile kFiles[] = {\n${entries}};\n}  // namespace\n
std::span<const PageFile> page_files() { return kFiles; }\n}  // namespace cornerd::web\n")
