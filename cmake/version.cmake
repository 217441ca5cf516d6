# gelatin_embed_version(TARGET)
#
# Compiles the version and the commit into TARGET (include/gelatin/version.h). The commit is asked for at every build,
# so that it is right without configuring anew; nothing is recompiled while it stays the same.
function(gelatin_embed_version target)
    set(output ${PROJECT_BINARY_DIR}/generated/version.cpp)
    add_custom_target(${target}_version
        COMMAND ${CMAKE_COMMAND} -D VERSION=${PROJECT_VERSION} -D ROOT=${PROJECT_SOURCE_DIR} -D OUTPUT=${output}
                -P ${PROJECT_SOURCE_DIR}/cmake/write_version.cmake
        BYPRODUCTS ${output}
        VERBATIM)
    add_dependencies(${target} ${target}_version)
    target_sources(${target} PRIVATE ${output})
endfunction()
