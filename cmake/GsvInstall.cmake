# Installs files with `cmake --install`, and defines the Debian packages that `make deb` makes of
# them. Programs find their worlds, models, plug-ins and pages relative to their own path, so a prefix
# may be moved as a whole. The installed folders and files are:
#
#   bin/                      programs
#   lib/gsv/                  plug-ins
#   lib/libgsv.so             the SDK
#   lib/libgsv-behaviour.a    the part of the SDK that plug-ins need
#   lib/cmake/gsv/            for find_package
#   lib/pkgconfig/gsv.pc      for pkg-config
#   include/gsv/              headers, with their paths in the source tree
#   share/gsv/                worlds, models, the viewer, the documentation
#   share/idl/gsv/            the IDL
include(CMakePackageConfigHelpers)
set(GSV_LIBRARY_VERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})

# The SDK as one shared library, to which behaviours and applications outside of this tree link.
add_library(gsv_shared_sdk SHARED
  $<TARGET_OBJECTS:gsv_sdk> $<TARGET_OBJECTS:gsv_sdk_behaviour> $<TARGET_OBJECTS:gsv_orb>
  $<TARGET_OBJECTS:gsv_readings> $<TARGET_OBJECTS:gsv_base> $<TARGET_OBJECTS:gsv_idl>)
set_target_properties(gsv_shared_sdk PROPERTIES
  OUTPUT_NAME gsv EXPORT_NAME sdk LINKER_LANGUAGE CXX
  VERSION ${PROJECT_VERSION} SOVERSION ${GSV_LIBRARY_VERSION}
  LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
target_link_libraries(gsv_shared_sdk PRIVATE gsv::sdk)
# The library to which plug-ins link. gsv itself contains everything else.
add_library(gsv_plugin_sdk STATIC
  $<TARGET_OBJECTS:gsv_sdk_behaviour> $<TARGET_OBJECTS:gsv_readings> $<TARGET_OBJECTS:gsv_base>)
set_target_properties(gsv_plugin_sdk PROPERTIES
  OUTPUT_NAME gsv-behaviour EXPORT_NAME sdk_behaviour LINKER_LANGUAGE CXX
  ARCHIVE_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
foreach(TARGET gsv_shared_sdk gsv_plugin_sdk)
  target_include_directories(${TARGET} INTERFACE $<INSTALL_INTERFACE:include/gsv>)
  target_compile_features(${TARGET} INTERFACE cxx_std_20)
  target_compile_options(${TARGET} INTERFACE -ffp-contract=off)  # equal bits on every machine
endforeach()

# The package gsv: the programs, and what they need to run.
set(GSV_PROGRAMS gsv gsv-wander gsv-cruise gsv-fetch gsv-follow-wall gsv-goto)
set(GSV_PLUGINS behaviour_wander behaviour_cruise behaviour_fetch behaviour_follow-wall behaviour_goto)
if(TARGET gsv-ros2)
  list(APPEND GSV_PLUGINS gsv-ros2)
endif()
install(TARGETS ${GSV_PROGRAMS} RUNTIME DESTINATION bin COMPONENT gsv)
install(TARGETS ${GSV_PLUGINS} LIBRARY DESTINATION lib/gsv COMPONENT gsv)
install(DIRECTORY assets/models assets/worlds ${CMAKE_BINARY_DIR}/share/gsv/web
  DESTINATION share/gsv COMPONENT gsv)
install(DIRECTORY ${CMAKE_BINARY_DIR}/share/gsv/docs DESTINATION share/gsv COMPONENT gsv OPTIONAL)
install(FILES LICENSE README.md CHANGELOG.md DESTINATION share/doc/gsv COMPONENT gsv)
# The manual pages, made from the help texts of the installed program.
set(GSV_MAN ${CMAKE_BINARY_DIR}/share/man/man1)
install(CODE "execute_process(COMMAND_ERROR_IS_FATAL ANY
  COMMAND \"${CMAKE_SOURCE_DIR}/tools/make_man_pages\" \"${CMAKE_BINARY_DIR}/bin/gsv\"
    \"${CMAKE_SOURCE_DIR}/docs/gsv.1.in\" \"${GSV_MAN}\")" COMPONENT gsv)
install(DIRECTORY ${GSV_MAN} DESTINATION share/man COMPONENT gsv)
# The completion scripts, which the installed program prints, in the folders below /usr in which
# shells search.
set(GSV_COMPLETION ${CMAKE_BINARY_DIR}/share/completion)
foreach(COMPLETION bash:bash-completion/completions/gsv zsh:zsh/vendor-completions/_gsv
    fish:fish/vendor_completions.d/gsv.fish)
  string(REGEX MATCH "^[a-z]+" SHELL ${COMPLETION})
  string(REGEX REPLACE "^[a-z]+:" "" FILE ${COMPLETION})
  get_filename_component(FOLDER ${FILE} DIRECTORY)
  install(CODE "file(MAKE_DIRECTORY \"${GSV_COMPLETION}/${FOLDER}\")
    execute_process(COMMAND_ERROR_IS_FATAL ANY COMMAND \"${CMAKE_BINARY_DIR}/bin/gsv\" completion ${SHELL}
      OUTPUT_FILE \"${GSV_COMPLETION}/${FILE}\")" COMPONENT gsv)
  install(FILES ${GSV_COMPLETION}/${FILE} DESTINATION share/${FOLDER} COMPONENT gsv)
endforeach()

# The package libgsv has only the shared library. libgsv-dev has the files for compiling against it.
install(TARGETS gsv_shared_sdk EXPORT gsvTargets
  LIBRARY DESTINATION lib COMPONENT libgsv NAMELINK_COMPONENT libgsv-dev)
install(TARGETS gsv_plugin_sdk EXPORT gsvTargets ARCHIVE DESTINATION lib COMPONENT libgsv-dev)
install(EXPORT gsvTargets NAMESPACE gsv:: DESTINATION lib/cmake/gsv COMPONENT libgsv-dev)
configure_package_config_file(cmake/package/gsvConfig.cmake.in ${CMAKE_BINARY_DIR}/package/gsvConfig.cmake
  INSTALL_DESTINATION lib/cmake/gsv)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/package/gsvConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
configure_file(cmake/package/gsv.pc.in ${CMAKE_BINARY_DIR}/package/gsv.pc @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/package/gsvConfig.cmake ${CMAKE_BINARY_DIR}/package/gsvConfigVersion.cmake
  DESTINATION lib/cmake/gsv COMPONENT libgsv-dev)
install(FILES ${CMAKE_BINARY_DIR}/package/gsv.pc DESTINATION lib/pkgconfig COMPONENT libgsv-dev)
install(FILES sdk/behaviour_main.cc DESTINATION share/gsv COMPONENT libgsv-dev)
install(FILES examples/first_behaviour.cc examples/real_robot.cc examples/test_wandering.cc
  DESTINATION share/gsv/examples COMPONENT libgsv-dev)
install(DIRECTORY examples/horn examples/infrared examples/out_of_tree examples/python examples/tcl
    examples/tutorial
  DESTINATION share/gsv/examples COMPONENT libgsv-dev USE_SOURCE_PERMISSIONS
  PATTERN __pycache__ EXCLUDE PATTERN horn_test.cc EXCLUDE)
file(GLOB IDL_FILES CONFIGURE_DEPENDS idl/*.idl)
install(FILES ${IDL_FILES} DESTINATION share/idl/gsv COMPONENT libgsv-dev)
# Behaviours and applications need sdk/, gsv/exchange, gsv/readings and gsv/base. Implementations of hardware also
# need gsv/orb, the broker's client and the stubs. Sensor plug-ins need the rest.
foreach(FOLDER sdk sdk/behaviour gsv/base gsv/exchange gsv/readings gsv/broker/client gsv/broker/language gsv/broker/offers
    gsv/geometry gsv/model gsv/messages gsv/world gsv/sensing/rays gsv/sensing gsv/simulation/pace
    gsv/simulation/robots gsv/simulation/commands gsv/simulation gsv/health gsv/services)
  file(GLOB HEADERS CONFIGURE_DEPENDS ${FOLDER}/*.h)
  install(FILES ${HEADERS} DESTINATION include/gsv/${FOLDER} COMPONENT libgsv-dev)
endforeach()
install(FILES gsv/orb/errors.h gsv/orb/orb.h DESTINATION include/gsv/gsv/orb COMPONENT libgsv-dev)
install(FILES gsv/scenario/fault.h DESTINATION include/gsv/gsv/scenario COMPONENT libgsv-dev)
install(DIRECTORY ${CMAKE_BINARY_DIR}/generated/ DESTINATION include/gsv COMPONENT libgsv-dev
  FILES_MATCHING PATTERN "*.h" PATTERN "*.hh")

# python3-gsv
set(GSV_PYTHON_DIR lib/python3/dist-packages CACHE STRING "Where the module gsv is installed, below the prefix")
install(TARGETS gsv_python LIBRARY DESTINATION ${GSV_PYTHON_DIR}/gsv COMPONENT python3-gsv)
list(TRANSFORM GSV_PYTHON_FILES PREPEND sdk/python/gsv/ OUTPUT_VARIABLE PYTHON_FILES)
install(FILES ${PYTHON_FILES} DESTINATION ${GSV_PYTHON_DIR}/gsv COMPONENT python3-gsv)
configure_file(cmake/package/METADATA.in ${CMAKE_BINARY_DIR}/package/METADATA @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/package/METADATA
  DESTINATION ${GSV_PYTHON_DIR}/gsv-${PROJECT_VERSION}.dist-info COMPONENT python3-gsv)

# Installs the targets above, and no tests.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
add_custom_target(installed DEPENDS docs ${GSV_PROGRAMS} ${GSV_PLUGINS} gsv_web gsv_shared_sdk gsv_plugin_sdk gsv_python)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME gsv)
set(CPACK_PACKAGE_VENDOR "GSV")
set(CPACK_PACKAGE_CONTACT "the GSV developers <gsv@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Simulator of robots in a distributed programming environment")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_OUTPUT_FILE_PREFIX ${CMAKE_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL gsv libgsv libgsv-dev python3-gsv)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_BINARY_DIR}/lib/gsv)
set(CPACK_DEBIAN_GSV_PACKAGE_NAME gsv)
set(CPACK_DEBIAN_GSV_DESCRIPTION "Simulator of robots: server, broker, recorder, viewer and behaviours")
# These libraries are loaded at the first call, so dpkg-shlibdeps does not detect them.
set(LATE_IN_PROGRAMS "libssl3, libsqlite3-0")
set(CPACK_DEBIAN_GSV_PACKAGE_DEPENDS "libsdformat12-12, libassimp5, libembree3-3, libtiff6, libturbojpeg0, libpng16-16, ${LATE_IN_PROGRAMS}")
set(CPACK_DEBIAN_LIBGSV_PACKAGE_DEPENDS "${LATE_IN_PROGRAMS}")
set(CPACK_DEBIAN_GSV_PACKAGE_RECOMMENDS "libegl1, libgl1-mesa-dri, libopengl0")
set(CPACK_DEBIAN_LIBGSV_PACKAGE_NAME libgsv${GSV_LIBRARY_VERSION})
set(CPACK_DEBIAN_LIBGSV_DESCRIPTION "What behaviours and applications for GSV run with")
set(CPACK_DEBIAN_LIBGSV_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBGSV_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_SOURCE_DIR}/cmake/package/triggers)
set(CPACK_DEBIAN_LIBGSV-DEV_PACKAGE_NAME libgsv-dev)
set(CPACK_DEBIAN_LIBGSV-DEV_DESCRIPTION "What behaviours and applications for GSV are compiled with")
set(CPACK_DEBIAN_LIBGSV-DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBGSV-DEV_PACKAGE_DEPENDS
  "libgsv${GSV_LIBRARY_VERSION} (= ${PROJECT_VERSION}), libcli11-dev, libspdlog-dev, libomniorb4-dev, libcos4-dev, omniidl")
set(CPACK_DEBIAN_PYTHON3-GSV_PACKAGE_NAME python3-gsv)
set(CPACK_DEBIAN_PYTHON3-GSV_DESCRIPTION "Behaviours and applications for GSV in Python")
set(CPACK_DEBIAN_PYTHON3-GSV_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON3-GSV_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12), python3-numpy, ${LATE_IN_PROGRAMS}")
set(CPACK_DEBIAN_PYTHON3-GSV_PACKAGE_CONTROL_EXTRA
  ${CMAKE_CURRENT_SOURCE_DIR}/cmake/package/postinst ${CMAKE_CURRENT_SOURCE_DIR}/cmake/package/prerm)
set(CPACK_DEBIAN_PYTHON3-GSV_PACKAGE_RECOMMENDS "gsv, python3-pytest")
include(CPack)
