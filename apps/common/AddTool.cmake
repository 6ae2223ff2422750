include_guard(GLOBAL)
include(GNUInstallDirs)
include(${PROJECT_SOURCE_DIR}/share/cmake/ToolDocs.cmake)

# A command-line tool: its sources, the library, and what apps/common/tool_main.h needs.
function(lidar_upsampling_add_tool name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/apps ${PROJECT_SOURCE_DIR}/rawlog_tools)
  target_compile_definitions(${name} PRIVATE LIDAR_UPSAMPLING_VERSION="${PROJECT_VERSION}")
  target_link_libraries(${name} PRIVATE lidar_upsampling_options ${ARG_LIBRARIES}
    lidar_upsampling::lidar_upsampling CLI11::CLI11)
  install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  lidar_upsampling_document_tool(${name})
endfunction()
