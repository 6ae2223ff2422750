# `cpack -G DEB`: the tools as lidar-upsampling, library and headers as liblidar-upsampling-dev.
set(CPACK_PACKAGE_NAME lidar-upsampling)
set(CPACK_PACKAGE_CONTACT "the lidar_upsampling authors <authors@lidar-upsampling.invalid>" CACHE STRING
  "The packages' maintainer")
set(CPACK_PACKAGE_VENDOR "the lidar_upsampling authors")
set(CPACK_COMPONENTS_ALL runtime development)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)  # wherever cpack is called
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME lidar-upsampling)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "mrpt-apps")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "gnuplot-nox")
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "Tools that add a virtual 3D scan to an MRPT log at every image between two
real scans: the static world moved by the ego-motion, each moving object by
its own motion. With tools to simulate, import, thin and evaluate logs.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME liblidar-upsampling-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "libmrpt-config-dev, libmrpt-img-dev, libmrpt-maps-dev, libmrpt-obs-dev, libmrpt-opengl-dev, libopencv-dev (>= 4.6), libceres-dev (>= 2.1), libeigen3-dev (>= 3.4), libgeographiclib-dev, libtbb-dev, libisal-dev, libdeflate-dev, libzstd-dev, pkgconf | pkg-config")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Library, headers and CMake package of lidar_upsampling: scans and images in,
virtual scans out.")

# CHANGELOG.md's newest section as Debian's tools read changes, for each of the packages.
function(lidar_upsampling_install_changelog)
  file(READ ${PROJECT_SOURCE_DIR}/CHANGELOG.md changes)
  string(REGEX REPLACE "^# Changes\n\n## ([0-9.]+)[^\n]*\n\n" "lidar-upsampling (\\1) unstable; urgency=medium\n\n" changes "${changes}")
  string(REGEX REPLACE "\n+## .*" "" changes "${changes}\n")
  string(REGEX REPLACE "\n- " "\n  * " changes "${changes}")
  string(REGEX REPLACE "\n  ([^*])" "\n    \\1" changes "${changes}")
  string(STRIP "${changes}" changes)
  string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)  # SOURCE_DATE_EPOCH, where it is set
  set(file ${PROJECT_BINARY_DIR}/changelog)
  file(WRITE ${file} "${changes}\n\n -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
  file(ARCHIVE_CREATE OUTPUT ${file}.gz PATHS ${file} FORMAT raw COMPRESSION GZip COMPRESSION_LEVEL 9)
  install(FILES ${file}.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/lidar-upsampling)
  install(FILES ${file}.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/liblidar-upsampling-dev COMPONENT development)
endfunction()
lidar_upsampling_install_changelog()

include(CPack)
