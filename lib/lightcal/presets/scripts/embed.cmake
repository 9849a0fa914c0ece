# SPDX-License-Identifier: Apache-2.0
# Writes the scripts of this folder as a C++ function that gives their text by their names.
#   cmake -DOUT=embedded_scripts.cc -P embed.cmake
set(code "// Written by embed.cmake.\n#include \"lightcal/presets/scripts.h\"\n\n")
string(APPEND code "std::string_view lightcal::Script(std::string_view file) {\n")
foreach(file IN ITEMS LightcalImporter.cs blender.py godot.gd three.js unreal.py
    blender_addon/__init__.py blender_addon/cards.py blender_addon/lamps.py blender_addon/laws.py
    blender_addon/panel.py blender_addon/pictures.py blender_addon/states.py
    blender_addon/blender_manifest.toml)
  file(READ "${CMAKE_CURRENT_LIST_DIR}/${file}" text)
  string(APPEND code "  if (file == \"${file}\") return R\"lightcal(${text})lightcal\";\n")
endforeach()
string(APPEND code "  return {};\n}\n")
file(WRITE "${OUT}" "${code}")
