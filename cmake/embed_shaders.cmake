# gelatin_embed_shaders(TARGET)
#
# Compiles every file under shaders/ into TARGET as a string, so that the program needs no files beside it.
# GELATIN_SHADER_DIR reads them from disk instead (src/gl/shader_source.h).
function(gelatin_embed_shaders target)
    set(root ${PROJECT_SOURCE_DIR}/shaders)
    file(GLOB_RECURSE files CONFIGURE_DEPENDS ${root}/*.glsl ${root}/*.comp ${root}/*.vert
         ${root}/*.geom ${root}/*.frag)
    set(output ${PROJECT_BINARY_DIR}/generated/embedded_shaders.cpp)
    add_custom_command(
        OUTPUT ${output}
        COMMAND ${CMAKE_COMMAND} -D ROOT=${root} -D OUTPUT=${output} "-D FILES=${files}"
                -P ${PROJECT_SOURCE_DIR}/cmake/write_embedded_shaders.cmake
        DEPENDS ${files} ${PROJECT_SOURCE_DIR}/cmake/write_embedded_shaders.cmake
        COMMENT "Embedding shaders"
        VERBATIM)
    target_sources(${target} PRIVATE ${output})
endfunction()
