#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes wrong and right set-ups of a simulated robot, and looks what STATUS says of each, and when.

    wrong_setups.py BIN [--sample] [--table]

BIN: the folder of cornerd and cornerctl. --sample: a few of each kind, for every commit. --table: rows for
src/tool/doctor/README.md. Exit code 1 where a wrong set-up is not named within a minute of driving, or a
right one is.
"""

import argparse
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import time

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
MAPS = os.path.join(SOURCE, "config", "maps")
LIMIT_S = 60


def scaled(*fields, by):
    def change(line):
        for field in fields:
            if field in line:
                line[field] = type(line[field])(line[field] * by)
    return change


def swapped(line):
    line["left"], line["right"] = line["right"], line["left"]


def both(*changes):
    def change(line):
        for one in changes:
            one(line)
    return change


def frozen(*fields):
    return lambda line: line.update({field: 1000 for field in fields})


def tilted(line):
    """The axis of the gyro lies flat: it measures the robot's roll."""
    line["gyro"] = 0.01 * math.sin(7 * line["t"])


def biased(line):
    line["gyro"] += 0.6


def late(line):
    line["t"] += 0.3


def one_encoder(line):
    line["right"] = line["left"]


def stuck(line):
    line["gyro"] = 0.1


MOUNT = {"x": 0.05, "y": -0.02, "theta": 0.3}


def mounted(x=0.0, y=0.0, degrees=0.0):
    """The config is off by this from where the lidar is."""
    return {"/lidar/mount/x": MOUNT["x"] - x, "/lidar/mount/y": MOUNT["y"] - y,
            "/lidar/mount/theta": MOUNT["theta"] - math.radians(degrees)}


# Name, expected faults (any of them is enough, as the data cannot tell them apart), change of the ODOMETRY lines,
# config.
WRONG = [
    ("lidar turned by 180 degrees", {"mount-theta"}, None, mounted(degrees=180)),
    ("lidar turned by 90 degrees", {"mount-theta"}, None, mounted(degrees=90)),
    ("lidar turned by -90 degrees", {"mount-theta"}, None, mounted(degrees=-90)),
    ("lidar turned by 10 degrees", {"mount-theta"}, None, mounted(degrees=10)),
    ("lidar turned by 2 degrees", {"mount-theta"}, None, mounted(degrees=2)),
    ("lidar 5 cm behind", {"mount-position"}, None, mounted(x=0.05)),
    ("lidar 5 cm to the right", {"mount-position"}, None, mounted(y=0.05)),
    ("mount of 5 cm configured as 5 m", {"mount-position"}, None, {"/lidar/mount/x": 5}),
    ("wheels swapped", {"wheels-swapped"}, swapped, {}),
    ("left wheel reversed", {"left-wheel-reversed"}, scaled("left", by=-1), {}),
    ("right wheel reversed", {"right-wheel-reversed"}, scaled("right", by=-1), {}),
    ("both wheels reversed", {"wheels-reversed"}, scaled("left", "right", by=-1), {}),
    ("wheels swapped and reversed", {"wheels-swapped-and-reversed"},
     both(swapped, scaled("left", "right", by=-1)), {}),
    ("left encoder dead", {"left-encoder"}, frozen("left"), {}),
    ("right encoder dead", {"right-encoder"}, frozen("right"), {}),
    ("both encoders dead", {"encoders"}, frozen("left", "right"), {}),
    ("left encoder on both inputs", {"right-encoder"}, one_encoder, {}),
    ("readings 0.3 s late", {"odometry-delay"}, late, {}),
    ("1,440 counts configured as 360", {"counts-per-turn"}, None, {"/odometry/counts_per_turn": 360}),
    ("1,440 counts configured as 5,760", {"counts-per-turn"}, None, {"/odometry/counts_per_turn": 5760}),
    ("1,440 counts configured as 43,200", {"counts-per-turn"}, None, {"/odometry/counts_per_turn": 43200}),
    ("diameter configured as radius", {"counts-per-turn"}, None, {"/odometry/wheel_radius": 0.065}),
    ("track of 0.16 m configured as 0.32 m", {"track"}, None, {"/odometry/track": 0.32}),
    ("track of 0.16 m configured as 10 m", {"track"}, None, {"/odometry/track": 10}),
    ("one wheel of double resolution", {"right-counts"}, scaled("right", by=2), {}),
    ("gyro reversed", {"gyro-reversed"}, scaled("gyro", by=-1), {}),
    ("gyro in degrees", {"gyro-degrees"}, scaled("gyro", by=180 / math.pi), {}),
    ("gyro in raw counts", {"gyro-scale"}, scaled("gyro", by=131 * 180 / math.pi), {}),
    ("gyro in millidegrees", {"gyro-scale"}, scaled("gyro", by=1000 * 180 / math.pi), {}),
    ("gyro of another axis", {"gyro-axis"}, tilted, {}),
    ("gyro that repeats a value", {"gyro-stuck"}, stuck, {}),
    ("gyro biased by 0.6 rad/s", {"gyro-bias"}, biased, {}),
]



def plan(change=None, scale=1.0):
    """The flat, with each point changed."""
    def point(p):
        return [scale * value for value in (change(p) if change else p)]
    with open(os.path.join(MAPS, "flat-7.json"), encoding="utf-8") as file:
        text = re.sub(r"^\s*//.*$", "", file.read(), flags=re.M)
    flat = json.loads(text)
    flat.pop("rooms", None)
    flat["thickness"] *= scale
    for wall in flat["walls"]:
        wall["from"], wall["to"] = point(wall["from"]), point(wall["to"])
        if "thickness" in wall:
            wall["thickness"] *= scale
    return flat


# Name, expected faults, map (default: the flat), config. The daemon tries variants of a map in a thread.
WRONG_MAPS = [
    ("mirrored map", {"map-mirrored"}, plan(lambda p: [p[0], -p[1]]), {}),
    ("lidar upside down", {"map-mirrored"}, plan(), {"inverted": True}),
    ("map 3 % too large", {"map-scale"}, plan(scale=1.03), {}),
    ("map 10 % too small", {"map-scale"}, plan(scale=0.9), {}),
    ("map stretched by 7 % along x", {"map-scale"}, plan(lambda p: [1.07 * p[0], p[1]]), {}),
    ("map of another floor, the right one in `maps`", {"map-other"}, "krpai-2019-a.json", {}),
    ("map of another floor", {"map-mismatch"}, "krpai-2019-b.json", {}),
]

# Options of simulate.
RIGHT = [
    ("wheels and track %+d %% off, drive %d" % (percent, seed),
     ["--wheel-errors", "%.3f,%.3f" % (percent / 100, -percent / 200), "--track-error",
      "%.3f" % (percent / 100), "--seed", str(seed)] + more)
    for percent in (0, 2, -2, 4, 6)
    for seed, more in ((1, []), (2, ["--slips", "0.5"]), (3, ["--no-gyro"]), (4, ["--real"]),
                       (5, ["--gyro-error", "0.03", "--gyro-bias", "0.03"]),
                       (6, ["--clutter", "0.1", "--drive-speed", "0.6", "--rotation-speed", "2.5"]))
]


class Bench:
    def __init__(self, tools, folder):
        self.tool = os.path.join(tools, "cornerctl")
        self.daemon = os.path.join(tools, "cornerd")
        self.folder = folder

    def drive(self, name, options):
        """A minute in the flat: a recording."""
        file = os.path.join(self.folder, name + ".ndjson")
        defaults = {"--drive-speed": "0.3", "--acceleration": "1", "--rotation-acceleration": "6",
                 "--scans": "430"}
        command = [self.tool, "simulate", "--map", os.path.join(MAPS, "flat-7.json"), "--scenario",
                   "circuit-1", "--loop", "--odometry", "-o", file]
        command += [word for pair in defaults.items() if pair[0] not in options for word in pair]
        command += [word for key, value in MOUNT.items()
                    for word in ("--set", "/lidar/mount/%s=%s" % (key, value))]
        subprocess.run(command + options, check=True, stderr=subprocess.DEVNULL)
        return file

    def changed(self, file, change):
        if change is None:
            return file
        result = os.path.join(self.folder, "changed.ndjson")
        with open(file, encoding="utf-8") as lines, open(result, "w", encoding="utf-8") as out:
            for text in lines:
                if '"ODOMETRY"' in text:
                    line = json.loads(text)
                    change(line)
                    text = json.dumps(line) + "\n"
                out.write(text)
        return result

    def said(self, file, config):
        """Faults, hint and time of the first STATUS with a fault."""
        values = {"/odometry/source": "socket", **mounted(), **config}
        command = [self.tool, "replay", file, "--map", os.path.join(MAPS, "flat-7.json"),
                   "--classes", "STATUS"]
        for key, value in values.items():
            command += ["--set", "%s=%s" % (key, value)]
        output = subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout
        first = None
        last = None
        for text in output.splitlines():
            status = json.loads(text)
            faults = status.get("faults")
            if faults and faults != (last or {}).get("faults"):
                first = status["t"]
            last = status if faults else None
        return (last["faults"], last["hint"], first) if last else ([], "", None)


    def said_live(self, file, the_map, mount, odometry):
        """The same of a daemon that replays as fast as the lidar was."""
        map_file = os.path.join(self.folder, "map.json")
        if isinstance(the_map, str):
            map_file = os.path.join(MAPS, the_map)
        else:
            with open(map_file, "w", encoding="utf-8") as out:
                json.dump(the_map, out)
        sockets = {name: os.path.join(self.folder, name + ".sock") for name in ("pose", "control")}
        config = {"map": map_file, "lidar": {"driver": "replay", "file": file, "speed": 1,
                                             "mount": {**MOUNT, **mount}}, "socket": sockets,
                  "odometry": {"source": odometry}}
        if the_map == "krpai-2019-a.json":
            config["maps"] = [{"name": "krpai-2019-a", "file": map_file},
                              {"name": "home", "file": os.path.join(MAPS, "flat-7.json")}]
            config["map"] = "krpai-2019-a"
        config_file = os.path.join(self.folder, "config.json")
        with open(config_file, "w", encoding="utf-8") as out:
            json.dump(config, out)
        faults, hint, t_s = [], "", None
        first_said = {"map-mismatch", "odometry-unhealthy"}
        with subprocess.Popen([self.daemon, "--config", config_file],
                              stderr=subprocess.DEVNULL) as daemon:
            while not os.path.exists(sockets["pose"]) and daemon.poll() is None:
                time.sleep(0.05)
            with subprocess.Popen([self.tool, "watch", "--config", config_file, "--classes", "STATUS"],
                                  stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as watch:
                for text in watch.stdout:
                    status = json.loads(text)
                    if status["class"] != "STATUS":
                        continue
                    if status.get("faults"):
                        if status["faults"] != faults:
                            t_s = status["t"]
                        faults, hint = status["faults"], status["hint"]
                    # Said before the map's variants have been tried.
                    if status["t"] > LIMIT_S - 2 or (faults and faults[0] not in first_said):
                        break
                watch.terminate()
            daemon.terminate()
        return faults, hint, t_s


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("tools", metavar="BIN")
    parser.add_argument("--sample", action="store_true")
    parser.add_argument("--table", action="store_true")
    options = parser.parse_args()
    failed = 0
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(options.tools, folder)
        base = bench.drive("base", [])
        cases = [(name, expected, lambda change=change, config=config:
                  bench.said(bench.changed(base, change), config))
                 for name, expected, change, config in (WRONG[::6] if options.sample else WRONG)]
        # Odometry carries a pose across the scans that fit nowhere.
        cases += [(name + (", with odometry" if odometry == "socket" else ""), expected,
                   lambda the_map=the_map, mount=mount, odometry=odometry:
                   bench.said_live(base, the_map, mount, odometry))
                  for name, expected, the_map, mount in (WRONG_MAPS[:1] if options.sample else WRONG_MAPS)
                  for odometry in ("none", "socket")]
        for name, expected, say in cases:
            faults, hint, t_s = say()
            is_named = bool(expected & set(faults)) and t_s <= LIMIT_S
            failed += not is_named
            if options.table:
                print("| %s | %s | %s | %.0f s |" % (name, ", ".join("`%s`" % one for one in faults), hint, t_s or -1))
            elif not is_named:
                print("%s: named %s after %s s, not %s" % (name, faults, t_s, expected))
        for name, more in RIGHT[::6] if options.sample else RIGHT:
            faults, hint, t_s = bench.said(bench.drive("right", more), {})
            failed += bool(faults)
            if faults:
                print("%s: named %s: %s" % (name, faults, hint))
    print("%d set-ups failed" % failed)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
