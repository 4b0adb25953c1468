# The ORB (omniORB), the COS stubs that Debian ships, and stubs for our own IDL.
find_package(PkgConfig REQUIRED)
pkg_check_modules(OMNIORB REQUIRED IMPORTED_TARGET omniORB4 omniDynamic4)
pkg_check_modules(OMNIORB_COS REQUIRED omniCOS4 omniCOSDynamic4)
# Only the COS stubs of the Trading Service are used. libCOS4.so has the stubs of all services, and
# loading it at the start of a program takes 10 ms. So programs link the stubs from the archives.
# The archives are not position-independent code, which shared libraries require.
find_library(OMNIORB_COS_ARCHIVE libCOS4.a)
find_library(OMNIORB_COS_DYNAMIC_ARCHIVE libCOSDynamic4.a)
if(OMNIORB_COS_ARCHIVE AND OMNIORB_COS_DYNAMIC_ARCHIVE)
  set(IS_PROGRAM $<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>)
  target_link_libraries(PkgConfig::OMNIORB INTERFACE
    $<${IS_PROGRAM}:${OMNIORB_COS_DYNAMIC_ARCHIVE}> $<${IS_PROGRAM}:${OMNIORB_COS_ARCHIVE}>
    $<$<NOT:${IS_PROGRAM}>:-lCOSDynamic4> $<$<NOT:${IS_PROGRAM}>:-lCOS4>)
else()
  target_link_libraries(PkgConfig::OMNIORB INTERFACE -lCOSDynamic4 -lCOS4)
endif()
include(GsvOmniOrbVersion)
gsv_check_omniorb_version(${OMNIORB_omniORB4_VERSION})
find_program(OMNIIDL omniidl REQUIRED)

# gsv_idl_library(TARGET file.idl …): compiles IDL in the current folder to C++ stubs and
# skeletons, included as "idl/NAME.hh".
function(gsv_idl_library TARGET)
  set(OUT ${CMAKE_BINARY_DIR}/generated/idl)
  file(MAKE_DIRECTORY ${OUT})
  set(IDL_PATHS ${ARGN})
  list(TRANSFORM IDL_PATHS PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  foreach(FILE ${ARGN})
    get_filename_component(STEM ${FILE} NAME_WE)
    add_custom_command(
      OUTPUT ${OUT}/${STEM}.hh ${OUT}/${STEM}SK.cc
      COMMAND ${OMNIIDL} -bcxx -Wbuse_quotes -Wbh=.hh -Wbs=SK.cc
              -I${CMAKE_CURRENT_SOURCE_DIR} -C${OUT} ${CMAKE_CURRENT_SOURCE_DIR}/${FILE}
      DEPENDS ${IDL_PATHS}
      COMMENT "omniidl ${FILE}" VERBATIM)
    list(APPEND SOURCES ${OUT}/${STEM}SK.cc)
  endforeach()
  add_library(${TARGET} STATIC ${SOURCES})
  target_include_directories(${TARGET} SYSTEM PUBLIC ${CMAKE_BINARY_DIR}/generated ${OUT})
  target_compile_options(${TARGET} PRIVATE -w)
  if(NOT CMAKE_BUILD_TYPE STREQUAL "Debug")
    # All stubs are compiled as one file. Each of them defines a constant of this name.
    set_target_properties(${TARGET} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0
      UNITY_BUILD_UNIQUE_ID GSV_STUB
      UNITY_BUILD_CODE_BEFORE_INCLUDE "#define _0RL_library_version GSV_STUB"
      UNITY_BUILD_CODE_AFTER_INCLUDE "#undef _0RL_library_version")
  endif()
  target_link_libraries(${TARGET} PUBLIC PkgConfig::OMNIORB)
endfunction()
