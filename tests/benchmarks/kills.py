#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the lidar_upsampling authors
"""Kills all tools at random moments, and looks at what is left: final files whole, as before or not there, and no
temporary ones beside them once the tool has run again. Python's own library is enough for it.

  cmake --build --preset ci --target small_data_sets
  tests/benchmarks/kills.py build/ci [--kills 200] [--seed 1] [--kitti DRIVE] [--argoverse LOG] [--dgp SCENE]"""
import argparse
import json
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SCENARIO = Path(__file__).resolve().parents[2] / "config/scenarios/small.ini"
SIGNALS = (signal.SIGKILL, signal.SIGTERM, signal.SIGKILL, signal.SIGINT, signal.SIGHUP)


def run(command):
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}: {done.stderr}")


def files_in(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def is_whole(name, content, expected):
    if name.endswith(".json"):  # tells of times
        try:
            return isinstance(json.loads(content), dict)
        except ValueError:
            return False
    if name.endswith(".html"):
        return content.rstrip().endswith(b"</html>")
    return content == expected


class Tool:
    """A command whose outputs all lie in a folder of its own."""

    def __init__(self, name, command, work):
        self.name, self.folder = name, work / name.replace(" ", "_")
        self.command = [str(word).replace("OUT", str(self.folder)) for word in command]
        self.clear()
        start = time.monotonic()
        run(self.command)
        self.time_s = time.monotonic() - start
        self.whole = files_in(self.folder)
        self.kills = self.hits = self.left = 0
        self.faults = []

    def clear(self):
        shutil.rmtree(self.folder, ignore_errors=True)
        for folder in (self.folder, self.folder / "many"):
            folder.mkdir()

    def expect(self, good, what):
        if not good:
            self.faults.append(what)

    def kill(self, draw):
        if draw.random() < 0.5:
            self.clear()
        sent = draw.choice(SIGNALS)
        process = subprocess.Popen(self.command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        time.sleep(draw.uniform(0, 1.05) * self.time_s)
        process.send_signal(sent)
        status = process.wait()
        self.kills += 1
        self.hits += status == -sent
        self.expect(status in (0, -sent), f"{sent.name}: status {status}")
        left = files_in(self.folder)
        for name in left.keys() & self.whole.keys():
            self.expect(is_whole(name, left[name], self.whole[name]), f"{sent.name}: {name} is not whole")
        temporary = left.keys() - self.whole.keys()
        self.left += len(temporary)
        if sent != signal.SIGKILL:
            self.expect(not temporary, f"{sent.name}: {sorted(temporary)} stay")
        if temporary:
            self.expect_clean()

    def expect_clean(self):
        run(self.command)
        after = files_in(self.folder)
        self.expect(after.keys() == self.whole.keys(), f"after the next run: {sorted(after.keys() ^ self.whole.keys())}")


def tools_of(options, work):
    tool = {path.name: path for path in (options.build / "bin").iterdir()}
    simulate = [tool["rawlog-simulate"], "--scenario", SCENARIO, "--duration", "0.5", "--overwrite"]
    densify, log, dense = [tool["rawlog-densify"], "--overwrite"], work / "in.rawlog", work / "dense.rawlog"
    run([*map(str, simulate), "-o", str(log), "--truth", str(work / "truth.rawlog")])
    run([*map(str, densify), "-i", str(log), "-o", str(dense)])
    for name in ("a", "b"):
        shutil.copy(log, work / f"{name}.rawlog")
    yield "simulate", [*simulate, "-o", "OUT/x.rawlog", "--truth", "OUT/t.rawlog"]
    yield "densify", [*densify, "-i", log, "-o", "OUT/x.rawlog", "--report", "OUT/x.json"]
    yield "densify pictures", [*densify, "-i", log, "-o", "OUT/x.rawlog", "--pictures", "OUT/p", "--film", "OUT/x.mp4"]
    yield "densify parts", [*densify, "-i", log, "-o", "OUT/x.rawlog", "--jobs", "2", "--warm-up", "0.2"]
    yield "densify several", [*densify, "-i", work / "a.rawlog", work / "b.rawlog", "-o", "OUT/many", "--jobs", "2"]
    yield "decimate", [tool["rawlog-decimate"], "-i", log, "-o", "OUT/x.rawlog", "--label", "LIDAR", "--keep-every",
                       "2", "--overwrite"]
    yield "export", [tool["rawlog-export"], "-i", dense, "-o", "OUT/many", "--overwrite"]
    yield "evaluate", [tool["rawlog-evaluate"], "--reference", work / "truth.rawlog", "-i", dense, "--no-paper",
                       "--json", "OUT/x.json", "--csv", "OUT/x.csv", "--html", "OUT/x.html"]
    yield "map-compare", [tool["rawlog-map-compare"], "--reference", work / "truth.rawlog", "-i", dense]
    run([str(options.build / "tests/benchmarks/small_data_sets"), str(work / "sets")])
    labels = ["--boxes", "OUT/boxes.csv", "--truth-objects", "OUT/x_objects.csv", "--overwrite", "-o", "OUT/x.rawlog"]
    yield "kitti", [tool["kitti2rawlog"], "--drive", options.kitti or work / "sets/kitti/drive", *labels]
    yield "argoverse", [tool["argoverse2rawlog"], "--log", options.argoverse or work / "sets/argoverse", *labels]
    yield "dgp", [tool["dgp2rawlog"], "--scene", options.dgp or work / "sets/dgp", *labels]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path, help="folder of the build")
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    for data_set in ("kitti", "argoverse", "dgp"):
        parser.add_argument(f"--{data_set}", help="to import from, instead of a small one")
    options = parser.parse_args()
    draw = random.Random(options.seed)
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        tools = [Tool(name, list(map(str, command)), work) for name, command in tools_of(options, work)]
        for number in range(options.kills):
            tools[number % len(tools)].kill(draw)
        for tool in tools:
            tool.expect_clean()
    print("tool              kills  while at work  temporaries left by SIGKILL  faults")
    for tool in tools:
        print(f"{tool.name:18}{tool.kills:5}{tool.hits:15}{tool.left:29}{len(tool.faults):8}")
    for tool in tools:
        for fault in tool.faults:
            print(f"{tool.name}: {fault}")
    print(f"{options.kills} kills, {sum(len(tool.faults) for tool in tools)} faults")
    return 1 if any(tool.faults for tool in tools) else 0


if __name__ == "__main__":
    sys.exit(main())
