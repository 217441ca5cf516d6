# gelatin_make_library(layers...)
#
# Makes gelatin::gelatin of the layers, for users of this project: they see the headers of include/, and need glm beside it.
# It is one shared library that exports what GELATIN_API marks (include/gelatin/export.h); with BUILD_SHARED_LIBS=OFF the
# layers themselves, as static libraries, for programs of the same build. The layers stay for tests and the command line.
function(gelatin_make_library)
    list(TRANSFORM ARGN PREPEND gelatin_ OUTPUT_VARIABLE layers)
    if(DEFINED BUILD_SHARED_LIBS AND NOT BUILD_SHARED_LIBS)
        add_library(gelatin_library INTERFACE)
        list(REVERSE layers)
        list(TRANSFORM layers REPLACE "(.+)" "$<LINK_ONLY:\\1>")  # their headers stay private
        target_link_libraries(gelatin_library INTERFACE ${layers} glm::glm)
        set(scope INTERFACE)
    else()
        list(TRANSFORM layers REPLACE "(.+)" "$<TARGET_OBJECTS:\\1>" OUTPUT_VARIABLE objects)
        add_library(gelatin_library SHARED ${objects})
        target_link_libraries(gelatin_library PRIVATE ${layers} PUBLIC glm::glm)
        # Before 1.0 each minor version may change the binary interface (docs/embedding.md).
        set_target_properties(gelatin_library PROPERTIES
            OUTPUT_NAME gelatin EXPORT_NAME gelatin LINKER_LANGUAGE CXX
            VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
        set(exported ${PROJECT_SOURCE_DIR}/cmake/exported_symbols.map)
        target_link_options(gelatin_library PRIVATE LINKER:--version-script=${exported})
        set_property(TARGET gelatin_library PROPERTY LINK_DEPENDS ${exported})
        set(scope PUBLIC)
    endif()
    target_include_directories(gelatin_library ${scope} $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
                                                        $<INSTALL_INTERFACE:include>)
    target_compile_features(gelatin_library ${scope} cxx_std_20)
    add_library(gelatin::gelatin ALIAS gelatin_library)
endfunction()
