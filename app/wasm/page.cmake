# build/<preset>/app/lightcal_page.html and the npm package beside it, where Debian's clang-19 can
# compile for wasm32-wasi. Part of `all`, not of the target lightcal: quickstart never waits for it.
option(LIGHTCAL_WASM "Build the page and the npm package where the toolchain is installed" ON)
find_program(LIGHTCAL_WASM_CLANG clang++-19)
find_program(LIGHTCAL_WASM_LINKER wasm-ld-19)
find_file(LIGHTCAL_WASM_LIBCXX NAMES libc++.a PATHS /usr/lib/wasm32-wasi /usr/lib/llvm-19/lib/wasm32-wasi
  NO_DEFAULT_PATH)
find_file(LIGHTCAL_WASM_BUILTINS libclang_rt.builtins-wasm32.a
  PATHS /usr/lib/llvm-19/lib/clang/19/lib/wasi NO_DEFAULT_PATH)
if(NOT LIGHTCAL_WASM OR LIGHTCAL_SANITIZE OR NOT LIGHTCAL_WASM_CLANG OR NOT LIGHTCAL_WASM_LINKER
    OR NOT LIGHTCAL_WASM_LIBCXX OR NOT LIGHTCAL_WASM_BUILTINS)
  return()
endif()
set(wasm ${CMAKE_CURRENT_SOURCE_DIR}/wasm)
set(wasm_build ${PROJECT_BINARY_DIR}/wasm)
set(page ${PROJECT_BINARY_DIR}/app/lightcal_page.html)
# Its own build knows what changed.
add_custom_target(lightcal_wasm_module
  COMMAND ${CMAKE_COMMAND} -S ${wasm} -B ${wasm_build} -G Ninja
  COMMAND ${CMAKE_COMMAND} --build ${wasm_build}
  BYPRODUCTS ${wasm_build}/lightcal.wasm
  USES_TERMINAL VERBATIM)
file(GLOB page_parts CONFIGURE_DEPENDS ${wasm}/page/* ${wasm}/host/*)
add_custom_command(
  OUTPUT ${page}
  COMMAND ${CMAKE_COMMAND} -DWASM=${wasm_build}/lightcal.wasm -DOUT=${page}
          "-DGENERATOR=lightcal ${PROJECT_VERSION}" -P ${wasm}/page/assemble.cmake
  DEPENDS lightcal_wasm_module ${wasm_build}/lightcal.wasm ${page_parts}
  VERBATIM)
add_custom_target(lightcal_page ALL DEPENDS ${page})
install(FILES ${page} DESTINATION ${CMAKE_INSTALL_DATADIR}/lightcal OPTIONAL)
