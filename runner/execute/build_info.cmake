# Run at every build: asks git for the commit, and rewrites build_info.h only when something changed. The clone may belong
# to another user than the one who builds.
set(SEAPILE_COMMIT "unknown")
set(SEAPILE_DIRTY false)
execute_process(COMMAND git -c safe.directory=* -C ${SOURCE} rev-parse HEAD RESULT_VARIABLE failed OUTPUT_VARIABLE commit ERROR_QUIET
                OUTPUT_STRIP_TRAILING_WHITESPACE)
if(NOT failed)
  set(SEAPILE_COMMIT "${commit}")
  execute_process(COMMAND git -c safe.directory=* -C ${SOURCE} status --porcelain --untracked-files=normal -- solver runner cmake CMakeLists.txt
                  RESULT_VARIABLE failed OUTPUT_VARIABLE changes ERROR_QUIET)
  if(failed OR NOT changes STREQUAL "")
    set(SEAPILE_DIRTY true)
  endif()
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/build_info.h.in ${OUTPUT} @ONLY)
