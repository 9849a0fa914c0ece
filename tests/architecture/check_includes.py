#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads every #include of the house and fails on an arrow that lib/README.md does not draw.

    check_includes.py [ROOT]        exit 1 and one line an offence
    check_includes.py --self-test   plants one offence of each sort and expects it to be found
"""
import pathlib
import re
import sys
import tempfile

LAWS = ["photometry", "colorimetry", "light"]
BELOW = {
    "core": set(),
    "photometry": {"core"},
    "colorimetry": {"core", "photometry"},
    "light": {"core", "photometry", "colorimetry"},
    "records": {"core", *LAWS},
}
VERBS = ["fit", "presets", "report", "imaging", "tradeoff", "match"]
for verb in VERBS:
    BELOW[verb] = {"core", *LAWS, "records"}
BELOW["calibrate"] = {"core", *LAWS, "records", *VERBS}
DEVICE_ROOMS_SEE = {"core", *LAWS, "records"}

# Third-party headers and the only places that may open them.
DOORS = [
    (r"ceres/(tiny_solver|jet)\.h",  # header-only
     r"lib/lightcal/fit/|imaging/(scene/board_camera|panorama/(solve_aims|aim_bundle))\.cc$"),
    (r"ceres/(?!(tiny_solver|jet)\.h)", r"lib/lightcal/fit/"),
    (r"Eigen/",  # of imaging's headers one, which is not installed
     r"lib/lightcal/(fit|imaging)/.*\.cc$|lib/lightcal/fit/|imaging/panorama/aim_bundle\.h$|imaging/bracket/code_pairs\.h$|^app/wasm/overlay/ceres/"),
    (r"OpenImageIO/|libraw/|OpenEXR/", r"devices/lightcal_devices/captures/"),
    (r"opencv2/", r"lib/lightcal/imaging/"),
    (r"nlohmann/", r"(_codec\.cc$)|(lib/lightcal/presets/.*\.cc$)|(^app/)"),
    (r"toml\+\+/", r"_codec\.cc$|^app/"),
    (r"pugixml", r"devices/lightcal_devices/files/.*\.cc$|lib/lightcal/presets/.*\.cc$"),
    (r"^archive(_entry)?\.h", r"devices/lightcal_devices/files/archive_reading\.cc$"),
    (r"gphoto2/", r"devices/lightcal_devices/captures/gphoto_module\.cc$"),
    (r"hidapi|libusb", r"devices/lightcal_devices/transport/.*\.cc$"),
    (r"CLI/", r"^app/"),
    (r"pybind11/|Python\.h", r"^app/python/"),
    (r"nettle/", r"devices/lightcal_devices/disk_sources\.cc$"),
    (r"librsvg/|cairo(-pdf)?\.h", r"^app/picture_file\.cc$"),
]
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.M)


def room_of(path):
    """('lib', 'fit') for lib/lightcal/fit/..., ('devices', None), ('app', None)."""
    parts = path.split("/")
    if parts[0] == "lib" and len(parts) > 3:
        return "lib", parts[2]
    return parts[0], None


def offence_of(path, header):
    house, room = room_of(path)
    own = re.match(r"lightcal/([a-z_]+)/", header)
    if house == "lib":
        if header.startswith("lightcal_devices/"):
            return "lib may not include devices"
        if own and own.group(1) != room and own.group(1) not in BELOW.get(room, set()):
            return f"{room} may not include {own.group(1)}"
        if header in ("command.h", "console.h", "commands.h") or header.startswith("app/"):
            return "nothing but app may include app"
    if house == "devices":
        if own and own.group(1) not in DEVICE_ROOMS_SEE:
            return f"devices may not include {own.group(1)}"
        if header in ("command.h", "console.h", "commands.h") or header.startswith("app/"):
            return "nothing but app may include app"
    for pattern, door in DOORS:
        if re.match(pattern, header) and not re.search(door, path):
            return f"{header} has one door, and this is not it ({door})"
    if path.endswith(".h") and house in ("lib", "devices") and re.match(
            r"ceres/|nlohmann/|toml\+\+|pugi|libusb|hidapi|opencv2|CLI/", header):
        if "/fit/costs/" not in path and "/fit/" not in path:
            return f"{header} in a public header"
    return None


def offences(root):
    found = []
    for house in ("lib", "devices", "app"):
        for path in sorted((root / house).rglob("*")):
            if path.suffix not in (".h", ".cc"):
                continue
            name = path.relative_to(root).as_posix()
            for header in INCLUDE.findall(path.read_text(encoding="utf-8")):
                reason = offence_of(name, header)
                if reason:
                    found.append(f"{name}: #include {header}: {reason}")
    return found


PLANTED = [
    ("lib/lightcal/photometry/a.h", "lightcal/colorimetry/cct.h"),
    ("lib/lightcal/light/a.h", "lightcal/records/session.h"),
    ("lib/lightcal/fit/a.cc", "lightcal/presets/preset.h"),
    ("lib/lightcal/records/a.cc", "lightcal_devices/files/import_file.h"),
    ("lib/lightcal/report/a.cc", "console.h"),
    ("lib/lightcal/fit/a.cc", "lightcal/calibrate/session.h"),
    ("lib/lightcal/calibrate/a.cc", "lightcal_devices/disk_sources.h"),
    ("devices/lightcal_devices/files/a.cc", "lightcal/fit/fit_light.h"),
    ("lib/lightcal/records/a.cc", "ceres/ceres.h"),
    ("lib/lightcal/records/a.h", "nlohmann/json.hpp"),
    ("lib/lightcal/core/a.cc", "toml++/toml.h"),
    ("devices/lightcal_devices/meters/sekonic/meter.cc", "libusb-1.0/libusb.h"),
]


def self_test():
    for name, header in PLANTED:
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / name
            path.parent.mkdir(parents=True)
            path.write_text(f"#include <{header}>\n", encoding="utf-8")
            if len(offences(pathlib.Path(folder))) != 1:
                sys.exit(f"not found: {name} includes {header}")


def main():
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        return
    root = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parents[2]
    found = offences(root.resolve())
    if found:
        sys.exit("\n".join(found))


if __name__ == "__main__":
    main()
