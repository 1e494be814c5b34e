# Fails if an object file of a newer instruction set could bring its instructions into code that older processors run.
# Other code may be linked to such a function, or it may run unasked:
#   - an inline function or template, which the linker may use in place of another object's. It is allowed if its name
#     contains the lanes of this instruction set alone (LANES as mangled; without LANES none is allowed).
#   - a function with external linkage. Such objects offer their functions by a table of pointers, which is data.
#   - the constructors of static variables, which run before main.
#   cmake -DNM=nm -DOBJECTS="path_kernel.cpp.o;..." -DLANES=_VecBuiltinILi32EE -P isa_symbols_test.cmake
set(foreign "")
set(weak 0)
set(tables 0)
foreach(object IN LISTS OBJECTS)
  execute_process(COMMAND ${NM} --defined-only ${object} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]+" symbols "${symbols}")
  set(data 0)
  foreach(symbol IN LISTS symbols)
    if(symbol MATCHES " [WwTi] (.*)$")
      set(name "${CMAKE_MATCH_1}")
      if(symbol MATCHES " [Ww] " AND LANES AND name MATCHES "${LANES}")
        math(EXPR weak "${weak} + 1")
      else()
        string(APPEND foreign "\n  ${name}")
      endif()
    elseif(symbol MATCHES " (_GLOBAL__sub_I_.*)$")
      string(APPEND foreign "\n  ${CMAKE_MATCH_1}")
    elseif(symbol MATCHES " [DR] ")
      math(EXPR data "${data} + 1")
    endif()
  endforeach()
  if(NOT data)
    message(FATAL_ERROR "${object} offers no table: is this the object that was meant?")
  endif()
  math(EXPR tables "${tables} + ${data}")
endforeach()
if(foreign)
  message(FATAL_ERROR "${OBJECTS}: functions that older processors may be given:${foreign}")
endif()
message(STATUS "${weak} weak functions, all of the lanes ${LANES}; ${tables} tables")
