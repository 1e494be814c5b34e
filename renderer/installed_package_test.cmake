# Usage: `cmake -DBUILD=build -DSOURCE=example -DWORK=folder -DSCENE=scene.xml -DCXX=compiler -P <this file>`.
# Installs the package into a folder of its own, builds the example against it, away from this tree, and runs it.
file(REMOVE_RECURSE ${WORK})
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN}\nends with ${result}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/installed)
run(${CMAKE_COMMAND} -E copy_directory ${SOURCE} ${WORK}/example)
run(${CMAKE_COMMAND} -S ${WORK}/example -B ${WORK}/example/build -DCMAKE_PREFIX_PATH=${WORK}/installed
  -DCMAKE_CXX_COMPILER=${CXX} "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Werror")
run(${CMAKE_COMMAND} --build ${WORK}/example/build)
run(${WORK}/example/build/render_api ${SCENE} ${WORK}/image.exr)
if(NOT output MATCHES "pixels, [0-9]+ samples each, stopped early\nmiddle: [0-9]")
  message(FATAL_ERROR "the example printed:\n${output}")
endif()
# The program that was installed reads what the library wrote.
run(${WORK}/installed/bin/photonproof compare ${WORK}/image.exr ${WORK}/image.exr --fail mse=0)
execute_process(COMMAND ${WORK}/example/build/render_api ${WORK}/missing.xml ${WORK}/image.exr
  RESULT_VARIABLE result ERROR_VARIABLE error)
if(NOT result EQUAL 2 OR NOT error MATCHES "missing.xml: error: ")
  message(FATAL_ERROR "without a scene the example ends with ${result}: ${error}")
endif()
file(REMOVE_RECURSE ${WORK})
