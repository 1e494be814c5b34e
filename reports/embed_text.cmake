# embed_text(variable file): generates <variable>.h in this build folder with the file's text as the constant
# `variable`, so that an installed program needs no data file. Editing the file starts a new configuration.
function(embed_text variable file)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${file})
  file(READ ${file} text)
  set(content "// Made from ${file} by embed_text.cmake.
#pragma once

namespace photonproof {
inline constexpr char ${variable}[] = R\"embedded(${text})embedded\";
}  // namespace photonproof
")
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/embedded/${variable}.h CONTENT "${content}" @ONLY)
endfunction()
