#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Streams chromaticities through `lightcal color --batch -`: every line is answered, and twenty times
the lines take no more memory.

usage: batch_memory.py LIGHTCAL [LINES]    prints the throughput of LINES (2 million unless told)
"""
import resource
import subprocess
import sys
import threading
import time

ALLOWED_GROWTH_KIB = 4096
BLOCK = "".join(f"{0.25 + 0.00025 * i:.5f},{0.26 + 0.00015 * i:.5f}\n" for i in range(1000)).encode()


def peak_kib():
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss


def run(binary, lines):
    """Seconds, and the lines that came back."""
    process = subprocess.Popen([binary, "color", "--batch", "-"], stdin=subprocess.PIPE,
                               stdout=subprocess.PIPE)

    def feed():
        for _ in range(lines // 1000):
            process.stdin.write(BLOCK)
        process.stdin.close()

    start = time.monotonic()
    feeder = threading.Thread(target=feed)
    feeder.start()
    answered = 0
    while piece := process.stdout.read(1 << 20):
        answered += piece.count(b"\n")
    feeder.join()
    if process.wait() != 0:
        sys.exit("lightcal failed")
    return time.monotonic() - start, answered


def main():
    binary = sys.argv[1]
    lines = int(sys.argv[2]) if len(sys.argv) > 2 else 2_000_000
    run(binary, lines // 20)
    few = peak_kib()
    seconds, answered = run(binary, lines)
    many = peak_kib()
    print(f"{lines} lines in {seconds:.2f} s, {lines / seconds / 1e6:.2f} million a second; "
          f"peak memory {few / 1024:.1f} MiB for a twentieth, {many / 1024:.1f} MiB for all")
    if answered != lines:
        sys.exit(f"{lines} lines, but {answered} answers")
    if many - few > ALLOWED_GROWTH_KIB:
        sys.exit("memory grows with the input")


if __name__ == "__main__":
    main()
