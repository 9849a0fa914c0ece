# SPDX-License-Identifier: Apache-2.0
# Writes the page as one file: style, script and module inside.
#   cmake -DWASM=lightcal.wasm -DOUT=page.html "-DGENERATOR=lightcal 0.1.0" -P assemble.cmake
cmake_minimum_required(VERSION 3.25)
set(here ${CMAKE_CURRENT_LIST_DIR})
file(READ ${here}/page.html page)
file(READ ${here}/page.css style)
set(script "")
foreach(part IN ITEMS ${here}/../host/wasi.js ${here}/../host/memory_files.js ${here}/page.js)
  file(READ ${part} text)
  # One script: what modules would pass to each other is in one scope.
  string(REGEX REPLACE "(^|\n)import [^\n]* from '\\./[^\n]*" "\\1" text "${text}")
  string(REGEX REPLACE "(^|\n)export (const|class|function)" "\\1\\2" text "${text}")
  string(APPEND script "${text}")
endforeach()
execute_process(COMMAND gzip -9nc ${WASM} COMMAND base64 -w 0 OUTPUT_VARIABLE module
  COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE "@STYLE@" "${style}" page "${page}")
string(REPLACE "@GENERATOR@" "${GENERATOR}" page "${page}")
string(REPLACE "@CARRIED@" "null" page "${page}")
string(REPLACE "@SCRIPT@" "${script}" page "${page}")
string(REPLACE "@WASM@" "${module}" page "${page}")
file(WRITE ${OUT} "${page}")
