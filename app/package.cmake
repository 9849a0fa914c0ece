# What lightcal_<version>_<architecture>.deb holds beside what each room installs: what the shell
# completes, the manual page, sessions to try. app/make_deb builds it.
set(shell ${PROJECT_BINARY_DIR}/app/shell)
file(MAKE_DIRECTORY ${shell})
function(lightcal_says words file)  # a file that holds what `lightcal <words>` prints
  add_custom_command(OUTPUT ${shell}/${file} DEPENDS lightcal VERBATIM
    COMMAND sh -c "ASAN_OPTIONS=detect_leaks=0 \"$<TARGET_FILE:lightcal>\" ${words} > \"${shell}/${file}\"")
endfunction()
lightcal_says("completion bash" lightcal)
lightcal_says("completion zsh" _lightcal)
lightcal_says("completion fish" lightcal.fish)
lightcal_says("man" lightcal.1)
add_custom_target(lightcal_shell_files ALL
  DEPENDS ${shell}/lightcal ${shell}/_lightcal ${shell}/lightcal.fish ${shell}/lightcal.1)

install(FILES ${shell}/lightcal DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${shell}/_lightcal DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
install(FILES ${shell}/lightcal.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
install(FILES ${shell}/lightcal.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES app/debian/copyright README.md app/PICTURES.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
# A session holds every file that it names.
install(DIRECTORY sample_data/sessions sample_data/tapes DESTINATION ${CMAKE_INSTALL_DATADIR}/lightcal
  PATTERN out EXCLUDE)

# Everything `cmake --install` needs, without the tests.
get_property(rooms GLOBAL PROPERTY LIGHTCAL_ROOMS)
get_property(modules GLOBAL PROPERTY LIGHTCAL_MODULES)
add_custom_target(lightcal_installed
  DEPENDS ${rooms} ${modules} lightcal lightcal_shell_files)
foreach(optional IN ITEMS lightcal_python lightcal_page)  # where their packages are
  if(TARGET ${optional})
    add_dependencies(lightcal_installed ${optional})
  endif()
endforeach()

set(CPACK_GENERATOR DEB)
# Two packages of one build: lightcal, and python3-lightcal where Python's headers and pybind11 are.
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL Unspecified)
set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_NAME lightcal)
set(CPACK_COMPONENT_UNSPECIFIED_DESCRIPTION ${PROJECT_DESCRIPTION})
if(TARGET lightcal_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-lightcal)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "lightcal (= ${PROJECT_VERSION}), ${LIGHTCAL_PYTHON_DEPENDS}")
endif()
set(CPACK_PACKAGE_CONTACT "The lightcal authors <lightcal@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_PACKAGE_DESCRIPTION "lightcal takes readings of lux meters, spectrometers and cameras, fits
the lamp with the uncertainty of each number, and writes light presets for engines: glTF, Godot,
Unreal, Unity, USD, Blender, three.js, Filament, Mitsuba, pbrt, IES and EULUMDAT. The package holds
the program, its library with headers, udev rules for meters, a manual page and sessions to try.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE zstd)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Opened while running, so that dpkg-shlibdeps does not see them: PNG pictures, HID meters.
set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_DEPENDS "librsvg2-2, libhidapi-hidraw0, libhidapi-libusb0")
# spotread; then what find_package(lightcal) finds its own dependencies in.
set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_SUGGESTS "argyll, libexpected-dev, libceres-dev, libopencv-dev, \
libopencv-contrib-dev, nlohmann-json3-dev, libtomlplusplus-dev, libarchive-dev, libpugixml-dev, \
libopenexr-dev")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_CONTROL_EXTRA
  ${PROJECT_SOURCE_DIR}/app/debian/postinst ${PROJECT_SOURCE_DIR}/app/debian/postrm)
include(CPack)
