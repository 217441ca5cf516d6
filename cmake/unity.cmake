# gelatin_unity(TARGET)
#
# Compiles the sources of each folder together, some at a time: most are small, and reading the same headers again for each
# takes longer than compiling it. GELATIN_UNITY=OFF compiles each by itself, which is quicker while one file is edited. So
# names in anonymous namespaces must differ within a folder; those that do not are errors of the compiler.
#
# Sources that Highway compiles for several instruction sets include themselves, and stay by themselves.
set(gelatin_sources_at_once 10)

function(gelatin_unity target)
    if(NOT GELATIN_UNITY)
        return()
    endif()
    get_target_property(sources ${target} SOURCES)
    foreach(source IN LISTS sources)
        file(STRINGS ${source} includes_itself REGEX "^#define HWY_TARGET_INCLUDE" LIMIT_COUNT 1)
        if(includes_itself)
            continue()
        endif()
        cmake_path(ABSOLUTE_PATH source OUTPUT_VARIABLE folder)
        cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
        cmake_path(REMOVE_FILENAME folder)
        string(MAKE_C_IDENTIFIER "${folder}" folder)
        list(APPEND ${folder} ${source})
        list(LENGTH ${folder} count)
        math(EXPR part "(${count} - 1) / ${gelatin_sources_at_once}")
        set_property(SOURCE ${source} PROPERTY UNITY_GROUP ${folder}${part})
    endforeach()
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()
