# What `cmake --install` and `cpack` put where: Debian's places, relative to the prefix.
include_guard(GLOBAL)

# Debian's multiarch folder under any prefix; GNUInstallDirs alone chooses it for /usr only, but a package's prefix
# is not known yet when a build is configured.
if(EXISTS /etc/debian_version AND CMAKE_LIBRARY_ARCHITECTURE)
  set(CMAKE_INSTALL_LIBDIR lib/${CMAKE_LIBRARY_ARCHITECTURE} CACHE PATH "Object code libraries")
endif()
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME runtime)

# To be called when all targets are there.
function(lidar_upsampling_install)
  set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/lidar_upsampling)
  install(TARGETS lidar_upsampling EXPORT lidar_upsampling_targets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
    INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/mrpt_plugin/lidar_upsampling
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
    FILES_MATCHING PATTERN "*.h")
  install(EXPORT lidar_upsampling_targets NAMESPACE lidar_upsampling::
    DESTINATION ${package_folder} COMPONENT development)
  configure_package_config_file(${PROJECT_SOURCE_DIR}/share/cmake/lidar_upsampling-config.cmake.in
    ${PROJECT_BINARY_DIR}/lidar_upsampling-config.cmake INSTALL_DESTINATION ${package_folder})
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/lidar_upsampling-config-version.cmake
    COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/lidar_upsampling-config.cmake
    ${PROJECT_BINARY_DIR}/lidar_upsampling-config-version.cmake
    DESTINATION ${package_folder} COMPONENT development)

  # Not in the linker's own folder, which is for libraries with a version.
  if(TARGET mrpt_lidar_upsampling)
    install(TARGETS mrpt_lidar_upsampling LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/mrpt-plugins)
  endif()
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/config
    DESTINATION ${CMAKE_INSTALL_DATADIR}/lidar_upsampling FILES_MATCHING PATTERN "*.ini" PATTERN "*.yaml" PATTERN "*.yml")
  # Pages lie to one another as in the sources, so that their links lead somewhere.
  set(pages ${CMAKE_INSTALL_DATADIR}/doc/lidar-upsampling)
  install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md ${PROJECT_SOURCE_DIR}/CONTRIBUTING.md DESTINATION ${pages})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/share DESTINATION ${pages}
    FILES_MATCHING PATTERN "*.md" PATTERN "*.png" PATTERN "*.jpg"
    PATTERN cmake EXCLUDE PATTERN protocols EXCLUDE PATTERN slurm EXCLUDE)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/lidar-upsampling RENAME copyright)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/liblidar-upsampling-dev RENAME copyright COMPONENT development)
endfunction()
