# gelatin_layer(NAME [DEPENDS layers...] [LIBRARIES targets...])
#
# Makes the static library gelatin_NAME of all sources below src/NAME. A layer sees the public headers, its own folder and,
# by DEPENDS, the layers below it; scripts/check_layers holds the includes against the same list.
function(gelatin_layer name)
    cmake_parse_arguments(arg "" "" "DEPENDS;LIBRARIES" ${ARGN})
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${name}/*.cpp)
    add_library(gelatin_${name} STATIC ${sources})
    add_library(gelatin::${name} ALIAS gelatin_${name})
    target_include_directories(gelatin_${name} PUBLIC ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/src
                                                      ${PROJECT_SOURCE_DIR}/shaders)
    list(TRANSFORM arg_DEPENDS PREPEND gelatin_)
    target_link_libraries(gelatin_${name} PUBLIC ${arg_DEPENDS} ${arg_LIBRARIES})
    gelatin_precompile(gelatin_${name})
    gelatin_unity(gelatin_${name})
endfunction()
