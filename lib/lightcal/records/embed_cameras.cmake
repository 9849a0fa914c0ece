# SPDX-License-Identifier: Apache-2.0
# Writes the cameras' files, without line breaks and indents, as a C++ table.
#   cmake -DOUT=embedded_cameras.cc -DFROM=sample_data/camera_sensitivities -P embed_cameras.cmake
file(GLOB files "${FROM}/*.json")
list(SORT files)
set(code "// Written by embed_cameras.cmake.\n#include \"lightcal/records/embedded_cameras.h\"\n\n")
string(APPEND code "namespace {\nconstexpr lightcal::records::EmbeddedCamera kTexts[] = {\n")
foreach(file IN LISTS files)
  file(READ "${file}" text)
  string(REGEX REPLACE "[\r\n]+[ \t]*" "" text "${text}")
  get_filename_component(name "${file}" NAME)
  string(APPEND code "    {\"${name}\", R\"lightcal(${text})lightcal\"},\n")
endforeach()
string(APPEND code "};\n}  // namespace\n\nstd::span<const lightcal::records::EmbeddedCamera> ")
string(APPEND code "lightcal::records::EmbeddedCameras() {\n  return kTexts;\n}\n")
file(WRITE "${OUT}" "${code}")
