#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the lidar_upsampling authors
"""The most memory of all tools on a log of a minute and on a long one of the same street, which is to be the same but
for a tenth. The street is a short one, simulated, again and again. Python's own library is enough for it, and MRPT's
rawlog-grabber for the live sensor, which plays the log as fast as the work is done. An hour takes 15 GB in the folder
for temporary files (TMPDIR).

  cmake --build --preset ci --target repeat_log
  tests/benchmarks/soak.py build/ci [--minutes 60] [--only densify,report]"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
SCENARIO = """[scenario]
duration_s = 4
seed = 3
[ego]
y_m = -5.1
speed_mps = 8
[lidar]
rings = 12
columns = 200
[camera.CAM0]
width = 160
height = 80
rate_hz = 20
[static]
pedestrians = 0
parked_cars = 0.1
trees = 0.1
poles = 0.1
[vehicle.lead]
x_m = 12
y_m = -5.1
speed_mps = 10
[vehicle.oncoming]
x_m = 25
y_m = 1.7
yaw_deg = 180
speed_mps = 9
"""


def run(command):
    """Seconds and MB. The pipe that it reads from stays open: rawlog-grabber stops at its end."""
    start = time.monotonic()
    process = subprocess.Popen([str(word) for word in command], stdin=subprocess.PIPE, stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True)
    errors = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = status
    if status != 0:
        sys.exit(f"{' '.join(map(str, command))}: {errors}")
    return time.monotonic() - start, usage.ru_maxrss / 1024


def play(build, log, work):
    """Settings by which the live sensor plays a log."""
    settings = (PROJECT / "config/rawlog-grabber-play.ini").read_text()
    for name, value in (("rawlog_prefix", work / "x_live"), ("rawlog", log), ("speed", 0)):
        settings = re.sub(rf"(?m)^{name} = .*", f"{name} = {value}", settings)
    file = work / f"{log.stem}_live.ini"
    file.write_text(settings)
    return [shutil.which("rawlog-grabber") or "rawlog-grabber", "-p",
            build.resolve() / "mrpt_plugin/plugin/mrpt_lidar_upsampling.so", file]


def densified(log):
    return log.with_name(f"{log.stem}_dense.rawlog")


def tools_of(build, log, work):
    tools, dense = build / "bin", densified(log)
    densify = [tools / "rawlog-densify", "--overwrite", "-i", log, "-o"]
    evaluate = [tools / "rawlog-evaluate", "--reference", log, "-i", dense, "--no-chamfer"]
    return {
        "densify": [*densify, dense],
        "report": [*densify, dense, "--report", work / "x.json"],
        "offline": [*densify, work / "x.rawlog", "--set", "mode=offline"],
        "parts": [*densify, work / "x.rawlog", "--jobs", "2"],
        "pictures": [*densify, work / "x.rawlog", "--pictures", work / "x_pictures"],
        "film": [*densify, work / "x.rawlog", "--film", work / "x.mp4"],
        "decimate": [tools / "rawlog-decimate", "--overwrite", "-i", log, "-o", work / "x.rawlog", "--label", "LIDAR",
                     "--keep-every", "2"],
        "check": [tools / "rawlog-densify", "--check", "-i", log],
        "evaluate": [*evaluate, "--no-paper", "--json", work / "x.json"],
        "evaluate paper": evaluate,
        "live": play(build, log, work),
    }


def clear(work):
    """Of what runs have written: an hour takes gigabytes."""
    for path in work.glob("x*"):
        shutil.rmtree(path) if path.is_dir() else path.unlink()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path, help="folder of the build")
    parser.add_argument("--minutes", type=float, default=60)
    parser.add_argument("--only", help="names of runs, with commas between")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        (work / "street.ini").write_text(SCENARIO)
        run([options.build / "bin/rawlog-simulate", "--scenario", work / "street.ini", "-o", work / "street.rawlog"])
        logs = {60: work / "minute.rawlog", 60 * options.minutes: work / "long.rawlog"}
        for seconds, log in logs.items():
            run([options.build / "tests/benchmarks/repeat_log", "--input", work / "street.rawlog", "--output", log,
                 "--seconds", seconds])
        print(f"{'':16}{'1 min':>8}{f'{options.minutes:g} min':>10}{'more':>8}{'time, s':>10}", flush=True)
        short, long = (tools_of(options.build, log, work) for log in logs.values())
        for name in options.only.split(",") if options.only else short:
            for tools, log in zip((short, long), logs.values()):
                if name.startswith("evaluate") and not densified(log).exists():
                    run(tools["densify"])
            _, first_mb = run(short[name])
            time_s, mb = run(long[name])
            print(f"{name:16}{first_mb:5.0f} MB{mb:7.0f} MB{100 * (mb / first_mb - 1):6.0f} %{time_s:10.0f}", flush=True)
            clear(work)


if __name__ == "__main__":
    main()
