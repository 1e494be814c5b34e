# Writes the manual pages and completions of PROGRAM, version VERSION, below SHARE. Without HELP2MAN, a program, there are
# no manual pages.
foreach(place bash:bash-completion/completions/photonproof zsh:zsh/vendor-completions/_photonproof
    fish:fish/vendor_completions.d/photonproof.fish)
  string(REPLACE ":" ";" place ${place})
  list(GET place 0 shell)
  list(GET place 1 file)
  execute_process(COMMAND ${PROGRAM} completions ${shell} OUTPUT_VARIABLE script COMMAND_ERROR_IS_FATAL ANY)
  file(WRITE ${SHARE}/${file} "${script}")
endforeach()

if(NOT HELP2MAN)
  message(STATUS "no help2man: manual pages are not written")
  return()
endif()
# manual_page(name title verb): writes name.1 from the --help of the verb, or of the program for "". help2man takes no
# command, but a file to run. So it gets a script of the page's name.
function(manual_page name title verb)
  set(page ${SHARE}/man/man1/${name}.1)
  set(command ${SHARE}/man/man1/${name})
  file(CONFIGURE OUTPUT ${command} CONTENT "#!/bin/sh\nexec '${PROGRAM}' ${verb} \"\$@\"\n")
  file(CHMOD ${command} PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
  execute_process(COMMAND ${HELP2MAN} --no-info --section=1 --version-string=${VERSION} "--name=${title}"
    "--manual=photonproof ${VERSION}" "--source=photonproof ${VERSION}" --output=${page} ${command}
    COMMAND_ERROR_IS_FATAL ANY)
  file(REMOVE ${command})
  execute_process(COMMAND gzip -9nf ${page} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(MAKE_DIRECTORY ${SHARE}/man/man1)
manual_page(photonproof "photon-mapping renderer, and the harness that proves it right" "")
execute_process(COMMAND ${PROGRAM} --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE "\nOther:.*" "" help "${help}")
string(REPLACE ";" "," help "${help}")  # a list's separator
string(REGEX MATCHALL "\n  [a-z]+ +[A-Z][^\n]*" verbs "${help}")
foreach(row IN LISTS verbs)
  string(REGEX MATCH "^\n  ([a-z]+) +(.*)$" unused "${row}")
  manual_page(photonproof-${CMAKE_MATCH_1} "${CMAKE_MATCH_2}" ${CMAKE_MATCH_1})
endforeach()
