# What `cmake --install` puts in place: the static libraries of all folders, their headers under include/redmap, and a
# package that find_package(redmap) finds. Its target redmap::redmap links everything.

include(CMakePackageConfigHelpers)

set(REDMAP_MODULES base device surface shader user_shader lobes analysis map bake scene render gpu metrics verify export)
list(TRANSFORM REDMAP_MODULES PREPEND redmap_ OUTPUT_VARIABLE REDMAP_TARGETS)

# The program's target has the name redmap already.
add_library(redmap_all INTERFACE)
add_library(redmap::redmap ALIAS redmap_all)
set_target_properties(redmap_all PROPERTIES EXPORT_NAME redmap)
set_target_properties(redmap_options PROPERTIES EXPORT_NAME options)
target_link_libraries(redmap_all INTERFACE ${REDMAP_TARGETS})

install(TARGETS redmap_all redmap_options redmap_plugin ${REDMAP_TARGETS} EXPORT redmapTargets)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/redmap
        FILES_MATCHING PATTERN "*.h" PATTERN "shader/library" EXCLUDE)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(REDMAP_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/redmap)
install(EXPORT redmapTargets NAMESPACE redmap:: DESTINATION ${REDMAP_PACKAGE_DIR})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/redmapConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/redmapConfig.cmake INSTALL_DESTINATION ${REDMAP_PACKAGE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/redmapConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/redmapConfig.cmake ${PROJECT_BINARY_DIR}/redmapConfigVersion.cmake
        DESTINATION ${REDMAP_PACKAGE_DIR})
