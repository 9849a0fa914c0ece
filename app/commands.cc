// SPDX-License-Identifier: Apache-2.0
// The whole command line on one page. A new command is one file in commands/ and one line here.
#include "commands.h"

namespace lightcal::app {
namespace {

// clang-format off
constexpr CommandRow kCommands[] = {
    {"quick", "One lamp from what you typed: lux at a distance, or a data sheet's figures",
     "  lightcal quick 192lx@0.5m --cct 2900K\n"
     "  lightcal quick 203lx@0.5m 58lx@1m 20lx@2m,card=8lx --fixture bulb --meter hobby\n"
     "  lightcal quick 192lx@0.5m 48lx@1m --room dark --at 3m\n"
     "  lightcal quick 17.8fc@20in --to gltf -o presets\n"
     "  lightcal quick 192lx@0.5m --cct 3200K --gel \"half ctb\"\n"
     "  lightcal quick --table lamps.csv -o answers.csv\n"
     "  lightcal quick --plan --reach 3m --minutes move=5\n"
     "  lightcal quick --lumens 806 --beam 36 --field 60", BuildQuick},
    {"new", "Begin a session: asks about the lamp and the meter, writes session.toml",
     "  lightcal new my_lamp --kind spot --box \"35W 36deg\" --to gltf,blender --yes\n"
     "  lightcal new my_lamp --force --yes", BuildNew},
    {"run", "The main job: fit a session, write light.json, every preset and report.html",
     "  lightcal run sample_data/sessions/three_real_lights\n"
     "  lightcal run my_lamp -o calibrated --to gltf\n"
     "  lightcal run sample_data/sessions -o calibrated --jobs 2 --resume --summary summary.json",
     BuildRun},
    {"devices", "Meters and cameras found, whether they may be used, how each was verified",
     "  lightcal devices\n"
     "  lightcal devices --json", BuildDevices},
    {"read", "Live or typed readings of a lamp into a session's journal",
     "  lightcal read -s my_lamp --guided\n"
     "  lightcal read -s my_lamp --light key --distance 0.5m\n"
     "  lightcal read -s my_lamp --light key --distance 0.5m --shadow-card --lux 3.1\n"
     "  lightcal read --device sekonic --once --json\n"
     "  lightcal read --replay sample_data/tapes/sekonic_c800_407lx_4995K.tape --once", BuildRead},
    {"sweep", "A fixture's states one after another, set and read, into a session's journal",
     "  lightcal sweep -s sample_data/sessions/dimmed_panels --light m9 --over dial=9,7,5,3,1,0\n"
     "  lightcal sweep -s sample_data/sessions/dimmed_panels --light panel --over dimmer=100,50,25 "
     "--over cct_K=3000,4000,5500 --typed\n"
     "  lightcal sweep -s sample_data/sessions/dimmed_panels --light module "
     "--over dimmer=100,80,60,40,30,20 --until 3%\n"
     "  lightcal sweep -s sample_data/sessions/dimmed_panels --light panel --distance 1m "
     "--over dimmer=100,50,25 --over cct_K=4000 --sacn 1@127.0.0.1 --map map.toml --device sekonic",
     BuildSweep},
    {"watch", "A meter's readings as they come: colour, steadiness, the lamp's intensity",
     "  lightcal watch --device sekonic --for 10s\n"
     "  lightcal watch -s my_lamp --light key --distance 0.5m\n"
     "  lightcal watch --replay sample_data/tapes/line_192lx.tape", BuildWatch},
    {"shoot", "A bracket from a camera on a cable or in the network, into a session",
     "  lightcal shoot -s my_lamp --light key --bracket ±4EV/1EV --use card --distance 0.8m "
     "--reflectance 0.18\n"
     "  lightcal shoot -s my_lamp --light key --bracket 6EV/2EV --center 1/60 --mains 50 --dry-run\n"
     "  lightcal shoot -s my_lamp --resume\n"
     "  lightcal shoot -s my_lamp --light key --bracket 4EV/1EV --device gphoto2:ptpip:192.168.1.5",
     BuildShoot},
    {"import", "Meter and spectrometer exports, CSV and logs into a session's journal",
     "  lightcal import lamp.xls -s my_lamp --light key --distance 0.5m --meter cv600\n"
     "  lightcal import tape_measure.csv -s my_lamp --light key\n"
     "  lightcal import sweep.csv -s my_lamp --light key --column 560nm --color-only", BuildImport},
    {"camera", "What a camera needs to measure: its scale, noise, black, lens, filters, colours",
     "  lightcal camera my_camera -o camera.json\n"
     "  lightcal merge bracket/*.dng -o lum.exr --camera camera.json", BuildCamera},
    {"plan", "The next readings that lower the uncertainty most; the board for a lit wall",
     "  lightcal plan sample_data/sessions/amaran_200x_s_bare --light 5600K\n"
     "  lightcal plan sample_data/sessions/grey_card_exr --reach 3m --plot minutes.svg\n"
     "  lightcal plan --board board.pdf\n"
     "  lightcal plan --board board.svg --paper a3 --square 40mm", BuildPlan},
    {"merge", "A bracket of frames into absolute luminance with a sigma for every pixel",
     "  lightcal merge bracket/*.dng -o lum.exr --sigma sigma.exr\n"
     "  lightcal merge bracket/*.dng -o lum.exr --anchor 280,180,40,40=312\n"
     "  lightcal merge a.png b.png c.png -o street.exr --exposures 1/50,1/13,0.4 --f-number 8 --iso 800\n"
     "  lightcal merge bracket/*.dng -o rgb.exr --space acescg --white 3200K", BuildMerge},
    {"dome", "A panorama in cd/m2 by one lux reading; its sun and lamps taken out as lights",
     "  lightcal dome lobby.hdr --lux 420 --extract 3 -o lobby_dome\n"
     "  lightcal dome sky.exr --lux 98klx --extract 1 --plate-exposure f/8,1/60,100 -o sky_dome\n"
     "  lightcal dome sky.hdr --lux 98klx --lux-shaded 15klx --extract 1 -o sky_dome\n"
     "  lightcal dome ball.exr --projection mirrorball --ball 36,36,228,228 --fov 25 "
     "--plate plate.exr --grey-ball 36,36,228,228 -o set_dome\n"
     "  lightcal dome hall/*.exr --aim auto --fov 75 -o hall_dome", BuildDome},
    {"inspect", "Luminance statistics of a picture or panorama; the illuminance it gives",
     "  lightcal inspect lobby.hdr --projection latlong\n"
     "  lightcal inspect lum.exr --rect 280,180,40,40 --json\n"
     "  lightcal inspect sky.exr --projection equisolid --fov 180\n"
     "  lightcal inspect window.hdr --glare -o sources.png -o sources.csv\n"
     "  lightcal inspect IMG_0042.CR2 --rect 100,100,50,50", BuildInspect},
    {"fit", "The estimate of a session's lamps, as light.json",
     "  lightcal fit sample_data/sessions/amaran_200x_s_bare -o light.json\n"
     "  lightcal fit my_lamp --tol 0.5% --json", BuildFit},
    {"explain", "Which effects this scene calls for, what each contributes and costs",
     "  lightcal explain sample_data/sessions/amaran_200x_s_bare --tol 1%", BuildExplain},
    {"simulate", "The illuminance fitted lights will give, at points or over a plane",
     "  lightcal simulate sample_data/sessions/amaran_200x_s_bare --lights 5600K --position 0,0,2.5 "
     "--at 0,0,0 1,0,0\n"
     "  lightcal simulate out/light.json --lights 5600K --position 0,0,2.5 --plane floor --grid 512 "
     "-o floor.png -o floor.exr\n"
     "  lightcal simulate out/light.json --lights 5600K --position 0,0,2.5 --plane z=0.8 --size 4x3m "
     "--border 0.5m --target 500lx,U0=0.6\n"
     "  lightcal simulate my_lamp --plane z=0.8 --size 6x4m --tol 0.5% -o desk.csv",
     BuildSimulate},
    {"ratio", "Key to fill in ratio and stops; what one meter's error has in common cancels",
     "  lightcal ratio 800lx 200lx\n"
     "  lightcal ratio 17.8fc 5fc --meter 3%\n"
     "  lightcal ratio out/light.json --at 0,0,0 --key 5600K --fill 3200K --position 5600K=-1,0,2 "
     "--position 3200K=1,0,3", BuildRatio},
    {"state", "A lamp at a state of its controls, read or between: labels are not light",
     "  lightcal state sample_data/sessions/dimmed_panels\n"
     "  lightcal state sample_data/sessions/dimmed_panels --light panel --at dimmer=37,cct_K=4000\n"
     "  lightcal state sample_data/sessions/dimmed_panels --light module --at dimmer=40 --json\n"
     "  lightcal state sample_data/sessions/mixing_panel --at dimmer=33,cct_K=3600 --spectrum a.csv",
     BuildState},
    {"tradeoff", "What accuracy costs in time on this session, and the setting to take",
     "  lightcal tradeoff sample_data/sessions/three_real_lights --tol 1% -o tradeoff\n"
     "  lightcal tradeoff my_lamp --budget 50ms\n"
     "  lightcal tradeoff my_lamp --knobs frames,pixels,solver --json\n"
     "  lightcal tradeoff my_lamp --knobs readings,rejection --synthetic",
     BuildTradeoff},
    {"export", "Engine presets of fitted lights, for the scene that is there; --rig for one of its own",
     "  lightcal export out/light.json --to gltf,json -o presets\n"
     "  lightcal export out/light.json --to blender --rig -o presets --force\n"
     "  lightcal export out/light.json --to blender,json --rig --rig-at 20 --rig-at 20/90 -o rigs\n"
     "  lightcal export out/light.json --to unreal,blender --into map.csv -o into", BuildExport},
    {"engine", "What a renderer makes of each kind of light, learnt from its own pictures",
     "  lightcal engine rig --to usd -o learn\n"
     "  lightcal engine learn learn --to usd --pixels exposed -o mine.json\n"
     "  lightcal export out/light.json --to usd --engine mine.json -o presets", BuildEngine},
    {"check", "A preset against the readings, or an engine's picture of the rig against the meter",
     "  lightcal check presets/light.gltf --session sample_data/sessions/amaran_200x_s_bare\n"
     "  lightcal check --render beauty.exr --rig presets/light.preset.json --engine blender",
     BuildCheck},
    {"report", "One self-contained page: figures, plots, how sure and why, provenance",
     "  lightcal report sample_data/sessions/amaran_200x_s_bare -o report.html\n"
     "  lightcal report out/light.json -o report.html\n"
     "  lightcal report sample_data/sessions/lit_wall --plot polar=polar.svg,luminance=wall.png",
     BuildReport},
    {"page", "One file that calculates in a browser: on a phone, without a network",
     "  lightcal page -o lightcal.html\n"
     "  lightcal page out/light.json -o hall.html", BuildPage},
    {"diff", "Whether lamps changed between two calibrations, beyond what both are unsure of",
     "  lightcal diff sample_data/lights/desk_lamp_march.json sample_data/lights/desk_lamp_june.json\n"
     "  lightcal diff sample_data/lights/desk_lamp_march.json sample_data/lights/desk_lamp_june.json "
     "--correlation 0.5 --json",
     BuildDiff},
    {"lights", "A library of fitted lights: add, list those that fit, compare on one sheet",
     "  lightcal lights add sample_data/lights/desk_lamp_june.json\n"
     "  lightcal lights list desk --cct 2500..3500 --cd 10..\n"
     "  lightcal lights --library sample_data/lights sheet -o sheet.html", BuildLights},
    {"validate", "Whether files are whole: sessions, lights, presets, tapes, IES, spectra ...",
     "  lightcal validate sample_data/sessions sample_data/photometric/sample2.ldt\n"
     "  lightcal validate out/light.json --json", BuildValidate},
    {"color", "CCT, Duv, XYZ and linear RGB of a chromaticity, a temperature or a spectrum",
     "  lightcal color 0.4476,0.4074\n"
     "  lightcal color 3200K --duv -0.003 --json\n"
     "  lightcal color --spectrum \"sample_data/spectra/uprtek_cv600/Nichia 80 CRI.xls\"\n"
     "  lightcal color --spectrum illuminant:A --through \"full ctb\"", BuildColor},
    {"match", "Gels and dimming that bring one lamp to another, as eye and camera see it",
     "  lightcal match illuminant:LED-B3 --to 3200K\n"
     "  lightcal match \"sample_data/spectra/uprtek_cv600/Yuji 5000K.xls\" --to illuminant:A --camera \"5d mark iv\"\n"
     "  lightcal match lamp.xls --to illuminant:D55 --gels gels.csv -n 3 --plot sheet.png --json\n"
     "  lightcal match lamp.xls --with \"sample_data/spectra/uprtek_cv600/Philips Warm Glow 2200K.xls\" --to 4000K",
     BuildMatch},
    {"photometric", "Flux, peak, beam and field of an IES or EULUMDAT file; conversion, polar plot",
     "  lightcal photometric sample_data/photometric/sample2.ldt\n"
     "  lightcal photometric lamp.ldt --to ies -o lamp.ies\n"
     "  lightcal photometric lamp.ies --plot lamp.png --json", BuildPhotometric},
    {"convert", "One value of a lamp into all the others: lm, cd, lx, nits, W with lm/W",
     "  lightcal convert 60W --efficacy 10lm/W --kind point --distance 0.5m --reflectance 0.9\n"
     "  lightcal convert 806lm --kind spot --inner 20 --outer 35 --distance 2m\n"
     "  lightcal convert 1500nits --kind rect --size 120x60cm --distance 3m --json\n"
     "  lightcal convert 100klx --kind directional --angular-diameter 0.53", BuildConvert},
    {"exposure", "Camera settings into EV, EV100, L_max, exposure, pre-exposed light values",
     "  lightcal exposure --aperture f/2.8 --shutter 1/60 --iso 100\n"
     "  lightcal exposure --t-stop T2.9 --angle 180 --fps 24 --iso 800\n"
     "  lightcal exposure --aperture f/16 --shutter 1/64 --iso 100 --light 2e9nits 100klx",
     BuildExposure},
    {"reference", "Typical luminous flux, illuminance, luminance, efficacy, with source",
     "  lightcal reference\n"
     "  lightcal reference full moon\n"
     "  lightcal reference efficacy --json", BuildReference},
    {"completion", "What the Tab key completes in bash, zsh or fish, as a script for that shell",
     "  . <(lightcal completion bash)\n"
     "  lightcal completion zsh > _lightcal\n"
     "  lightcal completion fish > lightcal.fish", BuildCompletion},
    {"man", "This manual, as a page for man",
     "  lightcal man | man -l -", BuildMan},
};
// clang-format on

}  // namespace

std::span<const CommandRow> Commands() { return kCommands; }

}  // namespace lightcal::app
