# Run by CTest: install, configure, build, run; any failure fails the test. What the library answers must
# be what the installed command answers, byte for byte.
function(step)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${WORK} RESULT_VARIABLE code
    OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${ARGN}\n${text}")
  endif()
  set(text "${text}" PARENT_SCOPE)
endfunction()
function(same a b)
  execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files ${WORK}/${a} ${WORK}/${b} RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${a} and ${b} differ")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK}/session/captures ${WORK}/presets)
step(${CMAKE_COMMAND} --install ${HOUSE} --prefix ${WORK}/prefix)
set(configure ${CMAKE_COMMAND} -G Ninja -S ${SOURCE} -DCMAKE_CXX_COMPILER=${CXX}
  -DCMAKE_PREFIX_PATH=${WORK}/prefix -DCMAKE_BUILD_TYPE=Release)

# Who fits readings needs none of these.
step(${configure} -B fit_alone -DFIT_ALONE=ON -DCMAKE_DISABLE_FIND_PACKAGE_OpenCV=ON
  -DCMAKE_DISABLE_FIND_PACKAGE_OpenEXR=ON -DCMAKE_DISABLE_FIND_PACKAGE_LibArchive=ON
  -DCMAKE_DISABLE_FIND_PACKAGE_pugixml=ON)
step(${CMAKE_COMMAND} --build fit_alone)
step(fit_alone/one_reading)
if(NOT text MATCHES "48 cd")
  message(FATAL_ERROR "the consumer printed: ${text}")
endif()

# Everything at once: typed readings, a dimmer, a spectrum, an IES file, a capture.
set(lightcal ${WORK}/prefix/bin/lightcal)
file(GLOB frames ${SAMPLES}/sessions/grey_card_dng/captures/*.dng)
file(COPY ${frames} DESTINATION ${WORK}/session/captures)
file(COPY_FILE "${SAMPLES}/spectra/uprtek_cv600/Osram Osconiq 3000K.xls" ${WORK}/session/lamp.xls)
step(${lightcal} photometric ${SAMPLES}/photometric/sample2.ldt --to ies -o session/lamp.ies)
file(WRITE ${WORK}/session/session.toml [=[
lightcal = 1
[[light]]
name = "key"
kind = "point"
[[light]]
name = "downlight"
kind = "photometric"
distribution = "lamp.ies"
[[light]]
name = "card_lamp"
kind = "point"
[[light]]
name = "panel"
kind = "point"
[[reading]]
light = "panel"
distance_m = 1.0
illuminance_lx = 800.0
state = { dimmer = 100 }
[[reading]]
light = "panel"
distance_m = 1.0
illuminance_lx = 410.0
state = { dimmer = 50 }
[[reading]]
light = "key"
distance_m = 0.5
illuminance_lx = 192.0
[[reading]]
light = "key"
distance_m = 1.0
illuminance_lx = 52.0
spectrum = "lamp.xls"
[[reading]]
light = "downlight"
distance_m = 2.0
illuminance_lx = 60.0
[[capture]]
light = "card_lamp"
frames = "captures/*.dng"
use = "card"
reflectance = 0.18
distance_m = 0.8
]=])
step(${lightcal} run session -o by_command --to gltf,unreal)
step(${lightcal} merge ${frames} -o merged.exr)
step(${configure} -B build)
step(${CMAKE_COMMAND} --build build)
step(build/whole_session session light.json presets merged.exr ${frames})
if(NOT text MATCHES "the same luminance")
  message(FATAL_ERROR "the consumer printed: ${text}")
endif()
same(light.json by_command/light.json)
file(GLOB presets RELATIVE ${WORK}/presets ${WORK}/presets/*)
list(LENGTH presets count)
if(count LESS 3)
  message(FATAL_ERROR "the consumer wrote the presets ${presets}")
endif()
foreach(preset IN LISTS presets)
  same(presets/${preset} by_command/${preset})
endforeach()
