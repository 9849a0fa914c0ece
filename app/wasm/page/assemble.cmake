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
# Z85 (five letters for four bytes, ZeroMQ RFC 32) is a sixteenth shorter than base64; it takes whole
# fours, so that the page keeps the true length beside it.
set(packed ${OUT}.gz)
find_program(ZOPFLI zopfli)  # a twentieth smaller than gzip -9, for ten seconds
if(ZOPFLI)
  execute_process(COMMAND ${ZOPFLI} --i5 -c ${WASM} OUTPUT_FILE ${packed}
    COMMAND_ERROR_IS_FATAL ANY)
else()
  execute_process(COMMAND gzip -9nc ${WASM} OUTPUT_FILE ${packed} COMMAND_ERROR_IS_FATAL ANY)
endif()
file(SIZE ${packed} packed_bytes)
execute_process(COMMAND truncate --size=%4 ${packed} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND basenc --z85 --wrap=0 ${packed} OUTPUT_VARIABLE module
  COMMAND_ERROR_IS_FATAL ANY)
file(REMOVE ${packed})
string(REPLACE "@STYLE@" "${style}" page "${page}")
string(REPLACE "@GENERATOR@" "${GENERATOR}" page "${page}")
string(REPLACE "@CARRIED@" "null" page "${page}")
string(REPLACE "@SCRIPT@" "${script}" page "${page}")
string(REPLACE "@WASM_BYTES@" "${packed_bytes}" page "${page}")
string(REPLACE "@WASM@" "${module}" page "${page}")
file(WRITE ${OUT} "${page}")
