# gelatin_test_suites(TARGET PREFIX)
#
# Registers each suite of a GoogleTest program as a test of CTest, PREFIX.SUITE: a process a suite, since a process a test
# would make a context and compile shaders again for each. The program is asked for its suites when it has been built.
# A suite leaves its report in reports/PREFIX/SUITE.xml of the build folder, which scripts/test counts tests by.
#
# Suites whose names end in Heavy are labelled 'heavy', those in Long 'long'.
function(gelatin_test_suites target prefix)
    set(suites ${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake)
    add_custom_command(
        TARGET ${target} POST_BUILD
        BYPRODUCTS ${suites}
        COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:${target}> -D PREFIX=${prefix} -D OUTPUT=${suites}
                -D REPORTS=${PROJECT_BINARY_DIR}/reports -P ${PROJECT_SOURCE_DIR}/cmake/write_test_suites.cmake
        VERBATIM)
    set(include ${CMAKE_CURRENT_BINARY_DIR}/${target}_include.cmake)
    file(WRITE ${include} "if(EXISTS \"${suites}\")\n  include(\"${suites}\")\nelse()\n"
                          "  add_test(${prefix}.not_built ${target}_is_not_built)\nendif()\n")
    set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${include})
endfunction()
