# CMake accepts only the version of omniORB whose internals gsv/orb/transport uses, unless the check
# is disabled.
set(CHECK ${CMAKE_CURRENT_LIST_DIR}/../../cmake/GsvOmniOrbVersion.cmake)

# expect(RESULT OPTIONS …): whether the check passes with these options.
function(expect EXPECTED)
  execute_process(COMMAND ${CMAKE_COMMAND} ${ARGN} -P ${CHECK} RESULT_VARIABLE CODE ERROR_VARIABLE MESSAGE)
  if(CODE EQUAL 0)
    set(RESULT passes)
  else()
    set(RESULT refuses)
  endif()
  if(NOT RESULT STREQUAL EXPECTED)
    message(FATAL_ERROR "with ${ARGN} it ${RESULT}: ${MESSAGE}")
  endif()
  if(EXPECTED STREQUAL refuses AND NOT MESSAGE MATCHES "GSV_OMNIORB_VERSION_UNCHECKED=ON")
    message(FATAL_ERROR "it does not say how to go on: ${MESSAGE}")
  endif()
endfunction()

expect(passes -DFOUND=4.2.5)
expect(refuses -DFOUND=4.2.4)
expect(refuses -DFOUND=4.3.0)
expect(passes -DFOUND=4.3.0 -DGSV_OMNIORB_VERSION_UNCHECKED=ON)
