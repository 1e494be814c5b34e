# cmake -DOUT=templates.cpp -DHEADER=reports/page/templates.h -DSPACE=templates -DFILES="a.mustache;b.css"
#       -DSCRIPTS="a.js;b.js" -P embed_templates.cmake
# Writes each file as a string_view of the namespace, named after the file without its extension. All scripts become one
# function `script`. The page allows only that script, by its SHA-256 in hexadecimal.
set(text "#include \"${HEADER}\"\n\nnamespace photonproof::reports::${SPACE} {\n\n")
foreach(file IN LISTS FILES)
  get_filename_component(name "${file}" NAME_WE)
  file(READ "${file}" content)
  string(APPEND text "const std::string_view ${name} = R\"embedded(${content})embedded\";\n")
endforeach()
set(script "(() => {\n\"use strict\";\n")
foreach(file IN LISTS SCRIPTS)
  file(READ "${file}" content)
  string(APPEND script "${content}")
endforeach()
string(APPEND script "})();\n")
string(SHA256 hash "${script}")
string(APPEND text "const std::string_view script = R\"embedded(${script})embedded\";\n"
       "const std::string_view script_sha256 = \"${hash}\";\n")
string(APPEND text "\n}  // namespace photonproof::reports::${SPACE}\n")
file(WRITE "${OUT}" "${text}")
