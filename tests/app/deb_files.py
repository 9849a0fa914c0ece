#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The .deb, unpacked: it holds what a person needs where the system looks for it, names what it is
linked with and what it opens while running, and the program in it works.

    deb_files.py BUILD_FOLDER

tests/bench/deb_in_clean_root installs and removes it with apt.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

BUILD = pathlib.Path(sys.argv[1]).resolve()
FILES = """
usr/bin/lightcal
usr/lib/lightcal/lightcal_archive.so
usr/lib/lightcal/lightcal_frames.so
usr/lib/lightcal/lightcal_pictures.so
usr/lib/lightcal/lightcal_tether.so
usr/lib/lightcal/lightcal_board.so
usr/lib/liblightcal_core.a
usr/lib/liblightcal_fit.a
usr/lib/cmake/lightcal/lightcalConfig.cmake
usr/include/lightcal/fit/fit_light.h
usr/include/lightcal_devices/files/import_file.h
usr/lib/udev/rules.d/70-lightcal.rules
usr/share/bash-completion/completions/lightcal
usr/share/zsh/vendor-completions/_lightcal
usr/share/fish/vendor_completions.d/lightcal.fish
usr/share/man/man1/lightcal.1
usr/share/doc/lightcal/copyright
usr/share/lightcal/sessions/three_real_lights/session.toml
usr/share/lightcal/sessions/three_real_lights/captures/LICENSE.MIT
""".split()
# By dpkg-shlibdeps (program and modules), and those opened by name.
DEPENDS = ["libc6", "libusb-1.0-0", "libraw20", "libopenimageio2.4", "libgphoto2-6", "libopencv-core406",
           "librsvg2-2", "libhidapi-hidraw0", "libhidapi-libusb0"]


def run(*words, **more):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False,
                          **more)
    if done.returncode != 0:
        sys.exit(f"{words}: exit {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def of_python(module, root):
    """The Python package of the same build, unpacked beside the program's: it answers, and finds the
    modules that pictures are read by."""
    problems = []
    run("dpkg-deb", "-x", module, root)
    depends = run("dpkg-deb", "-f", module, "Depends")
    problems += [f"{module.name} does not depend on {name}"
                 for name in ("lightcal (= ", "python3 (<< ", "python3-numpy", "libusb-1.0-0")
                 if name not in depends]
    listed = run("dpkg-deb", "-c", module)
    problems += [f"{line} is not Python's" for line in listed.splitlines()
                 if not line.endswith("/") and "/python3/dist-packages/lightcal/" not in line]
    said = run("/usr/bin/python3", "-c",
               "import sys; sys.path.insert(0, sys.argv[1]); import lightcal; "
               "print(lightcal.run(sys.argv[2])['lights'][0]['name'], lightcal.__version__)",
               root / "usr/lib/python3/dist-packages",
               root / "usr/share/lightcal/sessions/grey_card_exr")
    print(f"{module.name}: {module.stat().st_size / 1e6:.1f} MB; {said.strip()}")
    return problems


def main():
    problems = []
    with tempfile.TemporaryDirectory() as folder:
        home = pathlib.Path(folder)
        run("cpack", "-G", "DEB", "-B", home, cwd=BUILD)
        package = next(home.glob("lightcal_*.deb"))
        root = home / "root"
        run("dpkg-deb", "-x", package, root)
        problems += [f"{name} is missing" for name in FILES if not (root / name).is_file()]
        listed = run("dpkg-deb", "-c", package)
        problems += [f"not root's: {line}" for line in listed.splitlines() if " root/root " not in line]
        problems += [f"{line} is not for it" for line in listed.splitlines()
                     if re.search(r"/out/|/usr/local|/tests?/|gtest", line)]

        fields = run("dpkg-deb", "-f", package, "Depends")
        depends = [name.split()[0] for name in fields.split(", ")]
        problems += [f"does not depend on {name}" for name in DEPENDS if name not in depends]
        problems += [f"depends on {name}" for name in depends if name.endswith("-dev")]
        run("dpkg-deb", "-e", package, home / "control")
        for script in ("postinst", "postrm"):
            run("sh", "-n", home / "control" / script)

        for module in home.glob("python3-lightcal_*.deb"):
            problems += of_python(module, root)

        lightcal = root / "usr/bin/lightcal"
        if not run(lightcal, "--version").startswith("lightcal "):
            problems.append("--version")
        # Pictures are read by the module below lib, found from the program's own place.
        run(lightcal, "run", root / "usr/share/lightcal/sessions/grey_card_exr", "-o", home / "out")
        run(lightcal, "plan", "--board", home / "board.svg")
        print(f"{package.name}: {package.stat().st_size / 1e6:.1f} MB, "
              f"{len(listed.splitlines())} names, {len(depends)} dependencies")
    if problems:
        sys.exit("\n".join(problems))


if __name__ == "__main__":
    main()
