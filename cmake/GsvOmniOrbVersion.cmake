# gsv/orb/transport uses internal classes of omniORB, which may change with any release. It was
# written for the release below. With another release, the build may succeed and the programs may fail.
set(GSV_OMNIORB_VERSION 4.2.5)
option(GSV_OMNIORB_VERSION_UNCHECKED
  "Build with another omniORB than ${GSV_OMNIORB_VERSION}, at your own risk" OFF)

# gsv_check_omniorb_version(FOUND) stops CMake with an error if FOUND is another release.
function(gsv_check_omniorb_version FOUND)
  if(GSV_OMNIORB_VERSION_UNCHECKED OR FOUND VERSION_EQUAL GSV_OMNIORB_VERSION)
    return()
  endif()
  message(FATAL_ERROR
    "found omniORB ${FOUND}, but gsv/orb/transport needs omniORB ${GSV_OMNIORB_VERSION}: it builds on "
    "internal classes that differ between releases. Install libomniorb4-dev ${GSV_OMNIORB_VERSION} "
    "(Debian 12), or read docs/adr/029-one-giop-stack.md and configure with "
    "-DGSV_OMNIORB_VERSION_UNCHECKED=ON.")
endfunction()

# This file can run as a script: cmake -DFOUND=VERSION -P GsvOmniOrbVersion.cmake
if(CMAKE_SCRIPT_MODE_FILE STREQUAL CMAKE_CURRENT_LIST_FILE)
  gsv_check_omniorb_version(${FOUND})
endif()
