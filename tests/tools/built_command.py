# SPDX-License-Identifier: Apache-2.0
"""The built program, the first word of a test's command line, run in a folder of its own."""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

LIGHTCAL = str(pathlib.Path(sys.argv[1]).resolve())
HOME = pathlib.Path(tempfile.mkdtemp())


def run(*words, code=0):
    done = subprocess.run([LIGHTCAL, *map(str, words)], capture_output=True, text=True, cwd=HOME,
                          check=False)
    assert code is None or done.returncode == code, f"{words}: exit {done.returncode}, not {code}: {done.stderr}"
    return done


def answer(*words):
    return json.loads(run(*words, "--json").stdout)


def refused(code, *words, says="", status=3):
    """The error of a command that must be refused with that code, in words that match `says`."""
    error = json.loads(run(*words, "--json", code=status).stdout)["error"]
    assert error["code"] == code, error
    assert re.search(says, error["message"]), error
    return error
