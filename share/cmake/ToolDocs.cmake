# A man page and a bash completion of a tool, both made from what its --help prints.
include_guard(GLOBAL)
find_program(HELP2MAN help2man)
if(NOT HELP2MAN)
  message(WARNING "help2man is missing: no man pages (share/install-deps.sh installs it)")
endif()

function(lidar_upsampling_document_tool name)
  set(completion ${PROJECT_BINARY_DIR}/completions/${name})
  add_custom_command(OUTPUT ${completion}
    COMMAND ${CMAKE_COMMAND} -D TOOL=$<TARGET_FILE:${name}> -D OUTPUT=${completion}
      -D SETTINGS_OF=$<TARGET_FILE:rawlog-densify> -D SCENARIOS=${PROJECT_SOURCE_DIR}/config/scenarios -P ${PROJECT_SOURCE_DIR}/share/cmake/make_completion.cmake
    DEPENDS ${name} rawlog-densify ${PROJECT_SOURCE_DIR}/share/cmake/make_completion.cmake
      ${PROJECT_SOURCE_DIR}/share/cmake/completion.bash.in)
  install(FILES ${completion} DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  set(documents ${completion})
  if(HELP2MAN)
    set(page ${PROJECT_BINARY_DIR}/man/${name}.1)
    add_custom_command(OUTPUT ${page}.gz
      COMMAND ${CMAKE_COMMAND} -D TOOL=$<TARGET_FILE:${name}> -D OUTPUT=${page} -D HELP2MAN=${HELP2MAN}
        -D VERSION=${PROJECT_VERSION} -P ${PROJECT_SOURCE_DIR}/share/cmake/make_man_page.cmake
      DEPENDS ${name} ${PROJECT_SOURCE_DIR}/share/cmake/make_man_page.cmake
        ${PROJECT_SOURCE_DIR}/share/cmake/man_sections.h2m)
    install(FILES ${page}.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
    list(APPEND documents ${page}.gz)
  endif()
  add_custom_target(${name}_documents ALL DEPENDS ${documents})
  set_property(GLOBAL APPEND PROPERTY LIDAR_UPSAMPLING_TOOLS ${name})
endfunction()
