# Run at build time: asks PROGRAM for its suites and writes OUTPUT, which registers each with CTest (test_suites.cmake).
execute_process(COMMAND ${PROGRAM} --gtest_list_tests
                OUTPUT_VARIABLE listing RESULT_VARIABLE result TIMEOUT 60)
if(NOT result EQUAL 0)
    message(FATAL_ERROR "${PROGRAM} does not list its tests: ${result}")
endif()
string(REGEX MATCHALL "\n[^ \n]+\\." suites "\n${listing}")
set(text "")
foreach(suite IN LISTS suites)
    string(REGEX REPLACE "^\n|\\.$" "" suite "${suite}")
    set(properties "TIMEOUT 900")
    if(PREFIX STREQUAL apps)  # what takes long starts first: programs are run
        set(properties "TIMEOUT 900 COST 10")
    endif()
    if(suite MATCHES "Heavy$")
        set(properties "TIMEOUT 900 COST 100 LABELS heavy")
    elseif(suite MATCHES "Long$")
        set(properties "TIMEOUT 7200 LABELS long")
    endif()
    set(name "${PREFIX}.${suite}")
    string(APPEND text "add_test(\"${name}\" \"${PROGRAM}\" \"--gtest_filter=${suite}.*\" "
                       "\"--gtest_output=xml:${REPORTS}/${PREFIX}/${suite}.xml\")\n"
                       "set_tests_properties(\"${name}\" PROPERTIES ${properties})\n")
endforeach()
file(WRITE ${OUTPUT} "${text}")
