#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the lidar_upsampling authors
"""What the Snakefile calls: one step of one log, and the summary over all logs. Python's own library is enough for it."""
import argparse
import contextlib
import csv
import ctypes
import fcntl
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

STEPS = ("import", "thin", "densify", "evaluate")
ROWS = ("ours", "hold", "ego", "constant-velocity", "paper")


def locked(path, how):
    file = open(path, "w")
    try:
        fcntl.flock(file, how)
        return file
    except BlockingIOError:
        file.close()
        return None


def free_cores(number):
    """As many as a job may use, and the locks that keep them: tools take as many threads as they have cores."""
    allowed = sorted(os.sched_getaffinity(0))
    folder = Path(tempfile.gettempdir()) / f"lidar_upsampling-fleet-{os.getuid()}"
    folder.mkdir(exist_ok=True)
    cores, locks = [], []
    for core in allowed:
        lock = locked(folder / f"core-{core}", fcntl.LOCK_EX | fcntl.LOCK_NB) if len(cores) < number else None
        if lock:
            cores.append(core)
            locks.append(lock)
    return (cores if len(cores) == number else allowed), locks


def started(command, cores, errors):
    death_signal = ctypes.CDLL(None).prctl

    def prepare():
        death_signal(1, signal.SIGKILL)  # PR_SET_PDEATHSIG: who kills this script does not leave the tool behind
        os.sched_setaffinity(0, cores)

    return subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=errors, preexec_fn=prepare)


def run(command, threads):
    """Why it failed, or None; and whether to try again."""
    with tempfile.TemporaryFile("w+", errors="replace") as errors:
        cores, locks = free_cores(threads)
        try:
            code = started(command, cores, errors).wait()
        finally:
            for lock in locks:
                lock.close()
        errors.seek(0)
        last = ([""] + errors.read().splitlines())[-1]
    if code == 0:
        return None, False
    if code < 0:
        return f"killed by {signal.Signals(-code).name}", True
    tool = Path(command[0]).name  # says why in its last line, but for what a library of its ends by itself
    return last if last.startswith(tool) else f"{tool}: exit status {code}: {last}", False


def step(arguments):
    folder = arguments.status.parent
    folder.mkdir(parents=True, exist_ok=True)
    # One of a workflow that was itself killed may still be at it.
    lock = locked(folder / "in-use.lock", fcntl.LOCK_EX)
    before = json.loads(arguments.after.read_text()) if arguments.after.suffix == ".json" else {}
    status = {"step": arguments.status.stem, "seconds": 0.0, "failed_in": before.get("failed_in"), "why": before.get("why")}
    if not status["failed_in"] and arguments.command:
        began = time.monotonic()
        why, again = run(arguments.command, arguments.threads)
        if again and arguments.attempts_left > 0:
            sys.exit(f"{arguments.status}: {why}")
        status["seconds"] = round(time.monotonic() - began, 2)
        if why:
            status.update(failed_in=status["step"], why=why + (", each time" if again else ""))
    new = arguments.status.with_suffix(".new")
    new.write_text(json.dumps(status, indent=1) + "\n")
    new.rename(arguments.status)
    lock.close()


def figures(path):
    with contextlib.suppress(OSError), open(path, newline="") as file:
        return {(line["row"], line["figure"]): float(line["value"]) for line in csv.DictReader(file)}
    return {}


def result(folder):
    """What a log's folder tells: a mapping of what is known."""
    statuses = []
    for name in STEPS:
        with contextlib.suppress(OSError):
            statuses.append(json.loads((folder / f"{name}.json").read_text()))
    found = {"seconds": sum(status["seconds"] for status in statuses), "rows": {}}
    failed = next((status for status in statuses if status["failed_in"]), None)
    if failed:
        return {**found, "why": f"{failed['failed_in']}: {failed['why']}"}
    if len(statuses) < len(STEPS):
        return {**found, "why": f"{STEPS[len(statuses)]}: not finished"}
    report = json.loads((folder / "report.json").read_text())
    values = figures(folder / "errors.csv")
    found.update(real=report["scans_in"], virtual=report["virtual_scans"])
    found["chamfer"] = values.get(("ours", "chamfer_in_view_m"))
    # The two judge different things, so a log's line has all its figures of one; a mean of no movers is none.
    by_labels = ("ours", "movers") in values
    found["judge"] = "labels" if by_labels else "scans" if values else "-"
    for row in ROWS:
        value = values.get((row, "movers_mean_m" if by_labels else "moving_objects_mean_m"))
        found["rows"][row] = None if by_labels and not values.get((row, "movers")) else value
    return found


def cell(value):
    return "-" if value is None else f"{value:.3f}"


def summary(arguments):
    results = {name: result(arguments.output.parent / name) for name in arguments.logs}
    good = {name: found for name, found in results.items() if "why" not in found}
    bad = {name: found for name, found in results.items() if "why" in found}
    lines = [f"# {len(results)} logs: {len(good)} densified and evaluated, {len(bad)} failed", "",
             "Mean error of moving objects, m, judged by labels where there are any, else by the scans withheld (hold: by these alone); "
             "Chamfer distance in view, m.", "",
             "| log | real scans | virtual scans | judged by | " + " | ".join(f"**{row}**" if row == "ours" else row for row in ROWS)
             + " | Chamfer, ours | wall time, s |", "|---" * (len(ROWS) + 6) + "|"]
    for name, found in good.items():
        numbers = " | ".join(cell(found["rows"][row]) for row in ROWS)
        lines.append(f"| [{name}]({name}/errors.html) | {found['real']} | {found['virtual']} | {found['judge']} | {numbers} | "
                     f"{cell(found['chamfer'])} | {found['seconds']:.1f} |")
    lines.append(f"| sums, means | {sum(f['real'] for f in good.values())} | {sum(f['virtual'] for f in good.values())} | | "
                 + " | ".join(cell(mean([f["rows"][row] for f in good.values()])) for row in ROWS)
                 + f" | {cell(mean([f['chamfer'] for f in good.values()]))} | {sum(f['seconds'] for f in results.values()):.1f} |")
    if bad:
        lines += ["", "| failed | in which step, and why |", "|---|---|"]
        lines += [f"| {name} | {found['why'].replace('|', chr(92) + '|')} |" for name, found in bad.items()]
    arguments.output.parent.mkdir(parents=True, exist_ok=True)
    arguments.output.write_text("\n".join(lines) + "\n")


def mean(values):
    known = [value for value in values if value is not None]
    return sum(known) / len(known) if known else None


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    commands = parser.add_subparsers(required=True)
    one = commands.add_parser("step", help="run a tool unless a step before failed, and tell how it went")
    one.add_argument("--status", type=Path, required=True, help="JSON to write")
    one.add_argument("--after", type=Path, required=True, help="the status before, or the log itself")
    one.add_argument("--threads", type=int, default=1)
    one.add_argument("--attempts-left", type=int, default=0, help="if it is killed; with none left, that is told as its failure")
    one.add_argument("command", nargs="*")
    one.set_defaults(call=step)
    page = commands.add_parser("summary", help="one page over all logs")
    page.add_argument("--output", type=Path, required=True)
    page.add_argument("logs", nargs="+")
    page.set_defaults(call=summary)
    arguments = parser.parse_args()
    arguments.call(arguments)


if __name__ == "__main__":
    main()
