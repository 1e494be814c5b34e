# Fails where an object file of a newer instruction set defines a function that the linker may put in place of another
# object's: an inline function or template whose name does not carry the lanes of its own instruction set (LANES, as the
# compiler mangles them) would bring instructions that older processors lack into code they run.
#   cmake -DNM=nm -DOBJECT=kernels.cpp.o -DLANES=_VecBuiltinILi32EE -P kernel_symbols_test.cmake
execute_process(COMMAND ${NM} --defined-only ${OBJECT} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^\n]+" symbols "${symbols}")
set(foreign "")
set(weak 0)
foreach(symbol IN LISTS symbols)
  if(symbol MATCHES " [Ww] (.*)$")
    math(EXPR weak "${weak} + 1")
    set(name "${CMAKE_MATCH_1}")
    if(NOT name MATCHES "${LANES}")
      string(APPEND foreign "\n  ${name}")
    endif()
  endif()
endforeach()
if(foreign)
  message(FATAL_ERROR "${OBJECT} defines functions that may replace other objects':${foreign}")
endif()
message(STATUS "${weak} weak functions, all of ${LANES}")
