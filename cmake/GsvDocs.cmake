# Builds the documentation site in share/gsv/docs, where gsv finds it and serves it at /docs/.
# Without mkdocs and doxygen, the target `docs` only prints what is missing.
find_package(Python3 REQUIRED COMPONENTS Interpreter)
find_program(MKDOCS mkdocs)
find_program(DOXYGEN doxygen)
set(GSV_DOCS ${CMAKE_BINARY_DIR}/share/gsv/docs)

if(MKDOCS AND DOXYGEN)
  add_custom_command(
    OUTPUT ${GSV_DOCS}/index.html
    COMMAND Python3::Interpreter ${CMAKE_SOURCE_DIR}/tools/make_docs ${GSV_DOCS} --depfile ${CMAKE_BINARY_DIR}/docs.d
    DEPENDS ${CMAKE_SOURCE_DIR}/tools/make_docs
    DEPFILE ${CMAKE_BINARY_DIR}/docs.d
    COMMENT "The documentation site" VERBATIM)
  if(GSV_SANITIZE)
    add_custom_target(docs DEPENDS ${GSV_DOCS}/index.html)
  else()
    add_custom_target(docs ALL DEPENDS ${GSV_DOCS}/index.html)
  endif()
else()
  add_custom_target(docs
    COMMAND ${CMAKE_COMMAND} -E echo
      "no documentation site: install the Debian packages mkdocs, mkdocs-material and doxygen, then run cmake again")
endif()
