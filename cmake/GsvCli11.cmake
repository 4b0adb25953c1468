# gsv::cli11: CLI11, of which GCC compiles the functions once (cmake/cli11/CLI/CLI.hpp).
find_package(CLI11 REQUIRED)
add_library(gsv_cli11 STATIC ${CMAKE_SOURCE_DIR}/cmake/cli11/cli11.cc)
add_library(gsv::cli11 ALIAS gsv_cli11)
target_include_directories(gsv_cli11 SYSTEM PUBLIC ${CMAKE_SOURCE_DIR}/cmake/cli11)
target_link_libraries(gsv_cli11 PUBLIC CLI11::CLI11)
gsv_compile_soonest(gsv_cli11)
