# Run at build time: writes OUTPUT, a C++ file with VERSION and the commit of ROOT, if they have changed.
execute_process(COMMAND git describe --always --dirty --abbrev=12 --exclude=*
                WORKING_DIRECTORY ${ROOT}
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE
                RESULT_VARIABLE result ERROR_QUIET)
if(NOT result EQUAL 0)
    set(commit unknown)
endif()
set(text "// Generated.\n#include \"gelatin/version.h\"\n\nnamespace gelatin {\n\n")
string(REPLACE "." " && GELATIN_VERSION_MINOR == " same "${VERSION}")
string(REGEX REPLACE "MINOR == ([0-9]+)$" "PATCH == \\1" same "${same}")
string(APPEND text "static_assert(GELATIN_VERSION_MAJOR == ${same}, \"include/gelatin/version.h is not ${VERSION}\");\n\n")
string(APPEND text "const char* version() { return \"${VERSION}\"; }\n")
string(APPEND text "const char* commit() { return \"${commit}\"; }\n\n}  // namespace gelatin\n")
set(old "")
if(EXISTS ${OUTPUT})
    file(READ ${OUTPUT} old)
endif()
if(NOT text STREQUAL old)
    file(WRITE ${OUTPUT} "${text}")
endif()
