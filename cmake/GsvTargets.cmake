# gsv_without_json_conversions(TARGET): JSON values of the target are only converted by get() and
# get_to(). Implicit conversions would be candidates for most calls with a JSON value, and GCC would
# look at each of them.
function(gsv_without_json_conversions TARGET)
  target_compile_definitions(${TARGET} PRIVATE JSON_USE_IMPLICIT_CONVERSIONS=0)
endfunction()

# gsv_precompile(TARGET KIND) gives a target a precompiled header (cmake/precompiled_KIND.h), which
# is compiled once for all targets of this kind. It contains the headers that nearly every file of the
# kind includes. KIND is "library" (also for behaviours), or "test" for test programs. The target links
# to gsv::base. Other programs have no precompiled header, because it cost more than it saved.
function(gsv_precompile TARGET KIND)
  set(OWNER gsv_precompiled_${KIND})
  if(NOT TARGET ${OWNER})
    set(HEADER ${CMAKE_SOURCE_DIR}/cmake/precompiled_${KIND}.h)
    set(SOURCE ${CMAKE_BINARY_DIR}/precompiled_${KIND}.cc)
    file(CONFIGURE OUTPUT ${SOURCE} CONTENT "int main() {}\n")
    # A precompiled header works only for files with the same options and macros. The options of
    # programs differ from those of libraries.
    if(KIND STREQUAL "library")
      add_library(${OWNER} OBJECT EXCLUDE_FROM_ALL ${SOURCE})
      gsv_without_json_conversions(${OWNER})
    else()
      add_executable(${OWNER} EXCLUDE_FROM_ALL ${SOURCE})
      set_target_properties(${OWNER} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
    endif()
    target_compile_definitions(${OWNER} PRIVATE $<TARGET_PROPERTY:gsv_base,INTERFACE_COMPILE_DEFINITIONS>)
    if(KIND STREQUAL "test")
      target_link_libraries(${OWNER} PRIVATE GTest::gtest GTest::gmock)
      target_compile_options(${OWNER} PRIVATE "${GSV_TEST_OPTIONS}")
    endif()
    target_include_directories(${OWNER} PRIVATE ${CMAKE_SOURCE_DIR})
    target_precompile_headers(${OWNER} PRIVATE ${HEADER})
  endif()
  target_precompile_headers(${TARGET} REUSE_FROM ${OWNER})
  if(KIND STREQUAL "library")
    gsv_without_json_conversions(${TARGET})
  endif()
  # Without this error, a precompiled header that is not used would only cost time, and nobody would
  # notice.
  target_compile_options(${TARGET} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Werror=invalid-pch>)
endfunction()

# Most of the compile time of a file is spent on headers and templates that other files of the target
# also include. So all builds except dev compile the sources of a target in groups, each group as one
# file. The files of a group share one unnamed namespace, so the names in it must differ. The build dev
# compiles each file alone, which detects a missing include and rebuilds faster.
#
# gsv_compile_in_groups(TARGET FILE[@GROUP] …) groups the target's sources in the order in which they
# are listed. A file with @GROUP (such as @beast) is in the group of this name, and the others are in
# one group. Named groups limit the memory that the compiler needs. gsv_library and gsv_test call this
# function with their SOURCES. If GSV_FILES_A_GROUP is set, a group has the files of so many places in
# the list. Larger groups take less time in total, but more names must differ.
function(gsv_compile_in_groups TARGET)
  if(CMAKE_BUILD_TYPE STREQUAL "Debug")
    return()
  endif()
  set(FILES_A_GROUP 1000)
  if(GSV_FILES_A_GROUP)
    set(FILES_A_GROUP ${GSV_FILES_A_GROUP})
  endif()
  # In a precompiled header, GCC treats a file's unnamed namespace as that of a header.
  target_compile_options(${TARGET} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  set_target_properties(${TARGET} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  set(SOURCES ${ARGN})
  list(FILTER SOURCES INCLUDE REGEX "\\.cc(@|$)")
  set(COUNT 0)
  foreach(SOURCE IN LISTS SOURCES)
    math(EXPR GROUP "${COUNT} / ${FILES_A_GROUP}")
    math(EXPR COUNT "${COUNT} + 1")
    if(SOURCE MATCHES "^(.*)@(.*)$")
      set(SOURCE ${CMAKE_MATCH_1})
      set(GROUP ${CMAKE_MATCH_2})
    endif()
    set_source_files_properties(${SOURCE} PROPERTIES UNITY_GROUP ${GROUP})
  endforeach()
endfunction()
# Sets the variable OUT to the files without their groups.
function(gsv_without_groups OUT)
  list(TRANSFORM ARGN REPLACE "@.*$" "" OUTPUT_VARIABLE FILES)
  set(${OUT} ${FILES} PARENT_SCOPE)
endfunction()

# ctest starts the most expensive tests first. Only the browser tests (tests/browser) are more
# expensive.
set(GSV_EARLY 50)

# Tests need not be fast, only the code that they test. Without optimisation they compile in half of
# the time.
set(GSV_TEST_OPTIONS $<$<CONFIG:Release,RelWithDebInfo>:-O0>)

# gsv_compile_sooner(TARGET): for code whose speed no bench measures, or that is as fast in its benches.
# With -O1, it compiles in four fifths of the time.
function(gsv_compile_sooner TARGET)
  target_compile_options(${TARGET} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# gsv_compile_soonest(TARGET): for code that only reads options, files and requests, or prints results.
# With -Og, the command line compiles in four fifths of the time that it takes with -O1. GCC then
# reports uninitialised variables in std::regex, of which there are none.
function(gsv_compile_soonest TARGET)
  target_compile_options(${TARGET} PRIVATE
    "$<$<CONFIG:Release>:$<IF:$<CXX_COMPILER_ID:GNU>,-Og;-Wno-maybe-uninitialized,-O1>>")
endfunction()

# gsv_test_helper(TARGET …): for targets that only tests link to or start.
function(gsv_test_helper)
  foreach(TARGET IN LISTS ARGN)
    target_compile_options(${TARGET} PRIVATE "${GSV_TEST_OPTIONS}")
    set_target_properties(${TARGET} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  endforeach()
endfunction()

# gsv_library(NAME SOURCES FILE[@GROUP] … HEADERS … [DEPENDS …] [PRIVATE_DEPENDS …])
#
# Adds the static library gsv_NAME with the alias gsv::NAME. Path, include and target agree:
# the folder gsv/NAME is included as "gsv/NAME/…" from the repository root. Each header is
# compiled alone by the target all_verify_interface_header_sets.
function(gsv_library NAME)
  cmake_parse_arguments(ARG "" "" "SOURCES;HEADERS;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  if(ARG_SOURCES)
    gsv_without_groups(FILES ${ARG_SOURCES})
    add_library(gsv_${NAME} STATIC ${FILES})
    set(SCOPE PUBLIC)
    target_link_libraries(gsv_${NAME} PRIVATE ${ARG_PRIVATE_DEPENDS})
    gsv_precompile(gsv_${NAME} library)
    gsv_compile_in_groups(gsv_${NAME} ${ARG_SOURCES})
  else()
    add_library(gsv_${NAME} INTERFACE)
    set(SCOPE INTERFACE)
  endif()
  add_library(gsv::${NAME} ALIAS gsv_${NAME})
  target_sources(gsv_${NAME} ${SCOPE}
    FILE_SET HEADERS BASE_DIRS ${CMAKE_SOURCE_DIR} FILES ${ARG_HEADERS})
  target_link_libraries(gsv_${NAME} ${SCOPE} ${ARG_DEPENDS})
  set_target_properties(gsv_${NAME} PROPERTIES VERIFY_INTERFACE_HEADER_SETS ON)
endfunction()

# gsv_late_library(TARGET INSTEAD_OF IMPORTED LIBRARIES FILE … [WITHOUT FUNCTION …]) makes the
# library TARGET. Targets link to it instead of the target IMPORTED, whose functions are in the shared
# libraries FILE. A program then loads these libraries at the first call of one of their functions; see
# tools/make_late_library. On processors that this tool does not support, TARGET links to IMPORTED.
function(gsv_late_library TARGET)
  cmake_parse_arguments(ARG "" "INSTEAD_OF" "LIBRARIES;WITHOUT" ${ARGN})
  if(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$")
    add_library(${TARGET} INTERFACE)
    target_link_libraries(${TARGET} INTERFACE ${ARG_INSTEAD_OF})
    return()
  endif()
  find_package(Python3 3.11 REQUIRED COMPONENTS Interpreter)
  set(SCRIPT ${CMAKE_SOURCE_DIR}/tools/make_late_library)
  set(SOURCE ${CMAKE_CURRENT_BINARY_DIR}/${TARGET}.s)
  if(ARG_WITHOUT)
    list(JOIN ARG_WITHOUT "," WITHOUT)
    set(WITHOUT --without ${WITHOUT})
  endif()
  add_custom_command(OUTPUT ${SOURCE}
    COMMAND Python3::Interpreter ${SCRIPT} ${WITHOUT} ${SOURCE} ${ARG_LIBRARIES}
    DEPENDS ${SCRIPT} ${ARG_LIBRARIES} VERBATIM)
  add_library(${TARGET} STATIC ${SOURCE})
  foreach(PART INCLUDE_DIRECTORIES COMPILE_DEFINITIONS COMPILE_OPTIONS)
    get_target_property(VALUE ${ARG_INSTEAD_OF} INTERFACE_${PART})
    if(VALUE)
      set_property(TARGET ${TARGET} PROPERTY INTERFACE_${PART} ${VALUE})
    endif()
  endforeach()
  get_target_property(VALUE ${ARG_INSTEAD_OF} INTERFACE_INCLUDE_DIRECTORIES)
  if(VALUE)
    set_property(TARGET ${TARGET} PROPERTY INTERFACE_SYSTEM_INCLUDE_DIRECTORIES ${VALUE})
  endif()
  target_link_libraries(${TARGET} PUBLIC gsv::base)
endfunction()

# gsv_test(NAME SOURCES FILE[@GROUP] … [DEPENDS …] [LABEL …] [TIMEOUT seconds] [EARLY])
#
# Adds the GoogleTest program NAME; each of its tests becomes one ctest test, whose report
# GoogleTest leaves in test-reports of the build folder. GSV_REAL_DIR (other people's worlds and
# robots, may be absent), GSV_SOURCE_DIR and GSV_BUILD_DIR are environment variables of every test.
# EARLY: ctest starts these tests before others. They spend most of their time waiting, so that they
# would otherwise delay the end of all tests.
function(gsv_test NAME)
  cmake_parse_arguments(ARG "EARLY" "TIMEOUT;LABEL" "SOURCES;DEPENDS" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 60)
  endif()
  if(GSV_SANITIZE)
    math(EXPR ARG_TIMEOUT "5 * ${ARG_TIMEOUT}")  # all tests take two to ten times as long
  endif()
  gsv_without_groups(FILES ${ARG_SOURCES})
  add_executable(${NAME} ${FILES})
  target_link_libraries(${NAME} PRIVATE ${ARG_DEPENDS} GTest::gtest GTest::gmock GTest::gtest_main)
  target_compile_options(${NAME} PRIVATE "${GSV_TEST_OPTIONS}")
  gsv_precompile(${NAME} test)
  set(GSV_FILES_A_GROUP 20)
  gsv_compile_in_groups(${NAME} ${ARG_SOURCES})
  set_target_properties(${NAME} PROPERTIES
    RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  if(ARG_LABEL)
    set(LABELS LABELS ${ARG_LABEL})
  endif()
  if(ARG_EARLY)
    set(COST COST ${GSV_EARLY})
  endif()
  gtest_discover_tests(${NAME}
    DISCOVERY_MODE PRE_TEST
    XML_OUTPUT_DIR ${CMAKE_BINARY_DIR}/test-reports
    PROPERTIES TIMEOUT ${ARG_TIMEOUT} ${LABELS} ${COST})
endfunction()

# gsv_fuzz_target(NAME SOURCES … CORPUS folder [DEPENDS …] [MAX_LENGTH bytes])
#
# With GSV_FUZZ (the preset fuzz, which needs clang): the libFuzzer program fuzz/NAME, which `make
# fuzz` runs from the corpus on. Without: the test Fuzz.NAME, which runs the target on each file of
# the corpus. The sources define LLVMFuzzerTestOneInput. Add an input that has failed to the corpus.
option(GSV_FUZZ "Build fuzz targets with libFuzzer, and no tests" OFF)
if(GSV_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()
function(gsv_fuzz_target NAME)
  cmake_parse_arguments(ARG "" "CORPUS;MAX_LENGTH" "SOURCES;DEPENDS" ${ARGN})
  get_filename_component(CORPUS ${ARG_CORPUS} ABSOLUTE)
  if(NOT GSV_FUZZ)
    gsv_test(${NAME}_replay_test
      SOURCES ${ARG_SOURCES} ${CMAKE_SOURCE_DIR}/tests/support/fuzz_replay_test.cc
      DEPENDS ${ARG_DEPENDS})
    target_compile_definitions(${NAME}_replay_test PRIVATE
      GSV_FUZZ_CORPUS="${CORPUS}" GSV_FUZZ_TEST_NAME=${NAME})
    return()
  endif()
  if(NOT ARG_MAX_LENGTH)
    set(ARG_MAX_LENGTH 4096)
  endif()
  add_executable(${NAME} ${ARG_SOURCES})
  target_link_libraries(${NAME} PRIVATE ${ARG_DEPENDS})
  target_link_options(${NAME} PRIVATE -fsanitize=fuzzer)
  set_target_properties(${NAME} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/fuzz)
  set_property(GLOBAL APPEND PROPERTY GSV_FUZZ_LINES "${NAME} ${CORPUS} ${ARG_MAX_LENGTH}\n")
  get_property(LINES GLOBAL PROPERTY GSV_FUZZ_LINES)
  string(REPLACE ";" "" LINES "${LINES}")
  file(WRITE ${CMAKE_BINARY_DIR}/fuzz/targets "${LINES}")
  if(NOT TARGET fuzz_targets)
    add_custom_target(fuzz_targets)
  endif()
  add_dependencies(fuzz_targets ${NAME})
endfunction()

set(GSV_REAL_DIR "$ENV{GSV_REAL_DIR}" CACHE PATH "Worlds and robots that other people made")
if(NOT GSV_REAL_DIR)
  get_filename_component(GSV_REAL_DIR ${CMAKE_SOURCE_DIR}/../shared/real ABSOLUTE)
endif()

# Every test has these environment variables. CTest reads the file when it starts.
file(WRITE ${CMAKE_BINARY_DIR}/gsv_test_environment.cmake
  "set(ENV{GSV_SOURCE_DIR} [==[${CMAKE_SOURCE_DIR}]==])\n"
  "set(ENV{XDG_STATE_HOME} [==[${CMAKE_BINARY_DIR}/state]==])\n"
  "set(ENV{GSV_BUILD_DIR} [==[${CMAKE_BINARY_DIR}]==])\n"
  "set(ENV{GSV_REAL_DIR} [==[${GSV_REAL_DIR}]==])\n"
  # Suppresses findings in other people's libraries. Only sanitizers read these variables.
  "set(ENV{LSAN_OPTIONS} [==[suppressions=${CMAKE_SOURCE_DIR}/cmake/sanitizers/lsan.supp:print_suppressions=0]==])\n"
  "set(ENV{TSAN_OPTIONS} [==[suppressions=${CMAKE_SOURCE_DIR}/cmake/sanitizers/tsan.supp:print_suppressions=0]==])\n")
set_property(DIRECTORY ${CMAKE_SOURCE_DIR}
  APPEND PROPERTY TEST_INCLUDE_FILES ${CMAKE_BINARY_DIR}/gsv_test_environment.cmake)
