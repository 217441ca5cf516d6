# What `cmake --install` puts into a folder: the shared library, the public headers, the files that find_package(gelatin)
# reads, and the program.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

if(GELATIN_APPS)
    install(TARGETS gelatin RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

get_target_property(kind gelatin_library TYPE)
if(kind STREQUAL "INTERFACE_LIBRARY")
    message(STATUS "Gelatin: the library is not installed, because BUILD_SHARED_LIBS is off")
    return()
endif()

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/gelatin)
install(TARGETS gelatin_library EXPORT gelatin_targets
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/gelatin DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN *.h)
install(EXPORT gelatin_targets NAMESPACE gelatin:: FILE gelatinTargets.cmake DESTINATION ${package})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/gelatinConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/generated/gelatinConfig.cmake INSTALL_DESTINATION ${package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/generated/gelatinConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/generated/gelatinConfig.cmake
              ${PROJECT_BINARY_DIR}/generated/gelatinConfigVersion.cmake DESTINATION ${package})
