# cmake -DOUT=templates.cpp -DFILES="a.mustache;b.css" -P embed_templates.cmake
# Writes each file as a string_view named like it without its extension.
set(text "#include \"reports/templates.h\"\n\nnamespace photonproof::reports::templates {\n\n")
foreach(file IN LISTS FILES)
  get_filename_component(name "${file}" NAME_WE)
  file(READ "${file}" content)
  string(APPEND text "const std::string_view ${name} = R\"embedded(${content})embedded\";\n")
endforeach()
string(APPEND text "\n}  // namespace photonproof::reports::templates\n")
file(WRITE "${OUT}" "${text}")
