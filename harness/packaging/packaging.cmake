# Installation and packages, by component. `program` has the program with its scenes, suites, manual pages and
# completions. `formats` reads images by OpenImageIO and models by Assimp, whose libraries take 0.9 GB. `library` has the
# headers and libraries of find_package(photonproof). All paths are relative to the program, so an installation can be
# moved. `cpack --config build/release/CPackConfig.cmake` writes a Debian package of each.

set(data ${CMAKE_INSTALL_DATADIR}/photonproof)
set(from ${PROJECT_SOURCE_DIR})
install(TARGETS photonproof RUNTIME COMPONENT program)
install(TARGETS photonproof_read_model RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/photonproof COMPONENT formats)
install(TARGETS photonproof_image_formats LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/photonproof COMPONENT formats)
get_property(libraries GLOBAL PROPERTY photonproof_installed)
add_custom_target(package_files DEPENDS photonproof photonproof_read_model photonproof_image_formats ${libraries})

# --- files that `demo`, `init`, `scenes` and `suites` find: a part of the source tree, in its layout ---
install(DIRECTORY ${from}/scenes/library ${from}/scenes/showcase DESTINATION ${data}/scenes COMPONENT program)
install(DIRECTORY ${from}/harness/suites ${from}/harness/init DESTINATION ${data}/harness COMPONENT program
  FILES_MATCHING PATTERN "*.toml" PATTERN "*.md" PATTERN "*.balls" PATTERN "ball.cpp" PATTERN "geometry" EXCLUDE)
install(DIRECTORY ${from}/harness/courses/photon-mapping DESTINATION ${data}/harness/courses COMPONENT program
  PATTERN "submissions" EXCLUDE PATTERN "defects" EXCLUDE PATTERN "sealed" EXCLUDE PATTERN "*.sh" EXCLUDE
  PATTERN "*.py" EXCLUDE)
install(FILES ${from}/harness/ci/github-actions.yml DESTINATION ${data}/harness/ci COMPONENT program)

# --- licences, manual pages, completions ---
set(PHOTONPROOF_CONTACT "The photonproof authors <photonproof@localhost>" CACHE STRING "maintainer of the packages")
set(texts ${PROJECT_BINARY_DIR}/packaging)
file(READ ${from}/NOTICE notice)
file(CONFIGURE OUTPUT ${texts}/copyright @ONLY
  CONTENT "@notice@\nOn Debian the Apache License is in /usr/share/common-licenses/Apache-2.0.\n")
foreach(row program:photonproof formats:photonproof-formats library:libphotonproof-dev)
  string(REGEX MATCH "(.*):(.*)" unused ${row})
  set(component ${CMAKE_MATCH_1})
  set(package ${CMAKE_MATCH_2})
  set(documents ${CMAKE_INSTALL_DATADIR}/doc/${package})
  install(FILES ${texts}/copyright ${from}/CHANGELOG.md ${from}/LICENSE DESTINATION ${documents} COMPONENT ${component})
  # A changelog as Debian's tools read it; the date is SOURCE_DATE_EPOCH's where that is set.
  string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)
  file(WRITE ${texts}/${package}/changelog "${package} (${PROJECT_VERSION}) unstable; urgency=medium\n\n"
    "  * CHANGELOG.md in this folder has the changes.\n\n -- ${PHOTONPROOF_CONTACT}  ${now}\n")
  execute_process(COMMAND gzip -9nf ${texts}/${package}/changelog COMMAND_ERROR_IS_FATAL ANY)
  install(FILES ${texts}/${package}/changelog.gz DESTINATION ${documents} COMPONENT ${component})
  install(FILES ${CMAKE_CURRENT_LIST_DIR}/lintian/${package} DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides
    COMPONENT ${component})
endforeach()
find_program(HELP2MAN help2man)
install(CODE "execute_process(COMMAND_ERROR_IS_FATAL ANY COMMAND ${CMAKE_COMMAND}
  -DPROGRAM=$<TARGET_FILE:photonproof> -DVERSION=${PROJECT_VERSION} -DHELP2MAN=${HELP2MAN}
  -DSHARE=\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}
  -P ${CMAKE_CURRENT_LIST_DIR}/program_texts.cmake)" COMPONENT program)

# --- Debian packages ---
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME photonproof)
set(CPACK_PACKAGE_VENDOR "photonproof")
set(CPACK_PACKAGE_CONTACT "${PHOTONPROOF_CONTACT}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program formats library)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME photonproof)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "photonproof-formats, povray, bubblewrap, libarchive-tools")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "blender")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "photon-mapping renderer, and the harness that proves it right
The renderer maps photons, traces paths and connects both ways, on Embree.
The harness renders the same scenes by other engines, measures errors and
times, gates builds in CI, grades submissions and writes tables for papers.")
set(CPACK_DEBIAN_FORMATS_PACKAGE_NAME photonproof-formats)
set(CPACK_DEBIAN_FORMATS_PACKAGE_SECTION graphics)
set(CPACK_COMPONENT_FORMATS_DESCRIPTION "photon-mapping renderer: further formats of images and models
Lets photonproof read images other than OpenEXR, PNG and PFM, and models and
scenes in glTF, OBJ, PLY and the format of pbrt.")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libphotonproof-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS
  "libembree-dev, libtbb-dev, libpng-dev, libpugixml-dev, zlib1g-dev, libopenexr-dev, pkg-config, g++")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS "photonproof-formats")
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "photon-mapping renderer, as a C++ library
Headers and static libraries for find_package(photonproof): scenes, images,
and renders with progress, an end on request and statistics.")
include(CPack)
