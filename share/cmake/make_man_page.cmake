# The man page OUTPUT.gz of TOOL, whose first line of --help says what it does.
get_filename_component(folder ${OUTPUT} DIRECTORY)
file(MAKE_DIRECTORY ${folder})
execute_process(COMMAND ${TOOL} --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCH "^[^\n]*" summary "${help}")
string(REGEX REPLACE "\\.$" "" summary "${summary}")
execute_process(COMMAND ${HELP2MAN} --no-info "--name=${summary}" "--source=lidar_upsampling ${VERSION}"
    --include=${CMAKE_CURRENT_LIST_DIR}/man_sections.h2m --no-discard-stderr --output=${OUTPUT} ${TOOL}
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND gzip --best --no-name --force ${OUTPUT} COMMAND_ERROR_IS_FATAL ANY)
