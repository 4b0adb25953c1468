# Compiler settings for every target.

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

add_compile_options(
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
  # Designated initialisers may omit members, which then keep their defaults.
  -Wno-missing-field-initializers
  # The compiler must not create fused multiply-adds by itself, because results must be
  # bit-identical on every machine.
  -ffp-contract=off)

# GCC collects its garbage when it has 128 MiB of it. Files that need a gigabyte would collect it
# again and again, which takes up to a tenth of their time. Without collections, the largest file needs
# 2.0 GiB instead of 1.6 GiB.
cmake_host_system_information(RESULT GSV_HOST_MEMORY QUERY TOTAL_PHYSICAL_MEMORY)  # in MiB
if(GSV_HOST_MEMORY GREATER 7000)
  set(GSV_GARBAGE_KB 2097152)
else()
  set(GSV_GARBAGE_KB 524288)
endif()
add_compile_options($<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=${GSV_GARBAGE_KB}>)

# Checks stay on in release builds (GSV_CHECK), so -DNDEBUG only affects libraries.
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")

set(GSV_SANITIZE "" CACHE STRING "Value of -fsanitize= for every target; empty for none")
if(GSV_SANITIZE)
  # A finding ends the program, so that its test fails. The documentation of the sanitizers
  # recommends -O1.
  set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O1 -g1 -DNDEBUG")
  set(CMAKE_C_FLAGS_RELWITHDEBINFO "-O1 -g1 -DNDEBUG")
  add_compile_definitions(GSV_SANITIZED)  # gsv/base/sanitizer.h
  add_compile_options(-fsanitize=${GSV_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${GSV_SANITIZE})
  if(GSV_SANITIZE MATCHES undefined)
    # This check needs variables of libraries that are loaded late (gsv_late_library()).
    add_compile_options(-fno-sanitize=vptr)
  endif()
endif()

option(GSV_COVERAGE "Count which lines run: the preset coverage, and `make coverage`")
if(GSV_COVERAGE)
  # Several threads count at the same time, and several processes add to one file.
  add_compile_options(--coverage -fprofile-update=prefer-atomic)
  add_compile_definitions(GSV_COVERAGE)  # programs then end normally and write their counts
  add_link_options(--coverage)
endif()

option(GSV_CCACHE "Compile by ccache, without precompiled headers: for who builds from nothing again and again")
if(GSV_CCACHE)
  find_program(CCACHE_PROGRAM ccache REQUIRED)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
  set(CMAKE_C_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)  # ccache cannot detect changes of a precompiled header
endif()

find_program(LLD_PROGRAM ld.lld)
if(LLD_PROGRAM)
  add_link_options(-fuse-ld=lld)
endif()
