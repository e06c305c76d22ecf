#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Boots the board, installs the package, plugs an A1 in and takes away what it needs; reports.

    steps.py --image FOLDER --package FILE.deb --cornerctl PROGRAM --work FOLDER
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys
import time

from guest import Failed, Guest, Lidar

# How much longer than on a quiet machine each wait may take: an emulator starves beside a compiler.
PATIENCE = 5
TRUTH = {"x": 0.95, "y": 0.6, "theta": 1.57}
WATCH = "timeout {seconds} cornerctl watch --classes {classes}"


class Report:
    """Each step with what it took."""

    def __init__(self):
        self.began = time.monotonic()

    def step(self, what, act):
        began = time.monotonic()
        said = act()
        now = time.monotonic()
        print(f"{now - self.began:7.1f} s  {now - began:7.1f} s  {what}"
              + (f": {said}" if isinstance(said, str) and said and "\n" not in said else ""),
              flush=True)
        return said


class Board:
    """What the steps ask of the guest."""

    def __init__(self, guest):
        self.guest = guest

    def property(self, name):
        return self.guest.run(f"systemctl show cornerd -p {name} --value")

    def wait_for(self, what, command, seconds=60):
        seconds *= PATIENCE
        until = time.monotonic() + seconds
        while True:
            try:
                return self.guest.run(command, seconds)
            except Failed:
                if time.monotonic() > until:
                    raise Failed(f"not within {seconds} s: {what}") from None
                time.sleep(0.2)

    def wait_for_pose(self, seconds=60):
        watch = WATCH.format(seconds=PATIENCE * seconds, classes="POSE")
        line = self.wait_for("pose", f"grep -m1 '\"state\":\"\\(fix\\|tracking\\)\"' < <({watch})",
                             seconds)
        pose = json.loads(line)
        off_m = math.hypot(pose["x"] - TRUTH["x"], pose["y"] - TRUTH["y"])
        if off_m > 0.01:
            raise Failed(f"a pose that is off by {off_m:.3f} m: {line}")
        return f"{pose['state']}, {1000 * off_m:.1f} mm off"

    def wait_for_no_lidar(self):
        watch = WATCH.format(seconds=PATIENCE * 20, classes="STATUS")
        self.wait_for("no lidar", "grep -m1 '\"state\":\"\\(absent\\|opening\\|backoff\\)\"' "
                      f"< <({watch})", 20)

    def wait_for_restart(self, count):
        self.wait_for("restart", f"test $(systemctl show cornerd -p NRestarts --value) -eq {count}")
        return self.property("Result")

    def install(self):
        self.guest.run("mkdir -p /root/files && tar -C /root/files -xf /dev/disk/by-id/virtio-files")
        self.guest.run("dpkg -i /root/files/cornerd.deb", 60 * PATIENCE)
        return self.guest.run("dpkg-query -W -f '${Version} ${Architecture}' cornerd")

    def memory(self):
        pid = self.property("MainPID")
        kib = int(self.guest.run(f"awk '/^VmRSS/ {{ print $2 }}' /proc/{pid}/status"))
        if kib > 16 * 1024:
            raise Failed(f"{kib} KiB are resident")
        return f"{kib} KiB resident"

    def lock_memory(self):
        drop_in = "/etc/systemd/system/cornerd.service.d"
        self.guest.run(f"mkdir -p {drop_in} && cp /usr/share/doc/cornerd/realtime.conf {drop_in}/ "
                       "2>/dev/null || cp /root/files/realtime.conf " + drop_in)
        self.guest.run("systemctl daemon-reload && systemctl restart cornerd", 20 * PATIENCE)
        return self.wait_for_pose()

    def count_poses(self, seconds):
        watch = WATCH.format(seconds=seconds, classes="POSE")
        lines = self.guest.run(f"{watch} || test $? = 124", seconds + 20 * PATIENCE).splitlines()
        states = [json.loads(line)["state"] for line in lines if '"POSE"' in line]
        bad = [state for state in states if state not in ("fix", "tracking")]
        if bad or len(states) < 5 * seconds:
            raise Failed(f"{len(states)} poses in {seconds} s, of them {bad}")
        return f"{len(states)} poses in {seconds} s"

    def reboot(self):
        self.guest.run("systemctl --no-block reboot")
        time.sleep(5)
        self.guest.wait_for_shell(200 * PATIENCE)
        return self.property("ActiveState")

    def purge(self):
        self.guest.run("dpkg --purge cornerd", 60 * PATIENCE)
        left = self.guest.run("find / -xdev -name '*cornerd*' -not -path '/proc/*' "
                              "-not -path '/root/files/*' -not -path '/var/lib/dpkg/*' "
                              "-not -path '/var/log/*' -not -path '/sys/*' "
                              "-not -path '/etc/systemd/system/cornerd.service.d*'; "
                              "getent passwd cornerd || true")
        if left:
            raise Failed(f"left behind: {left}")
        return "nothing is left"


def run_steps(report, board, lidar, guest):
    """All that a robot's board goes through."""
    report.step("boot: systemd, a shell", lambda: guest.wait_for_shell(200 * PATIENCE))
    print(guest.run("uname -srm; . /etc/os-release; echo $PRETTY_NAME"))
    report.step("install the package", board.install)
    guest.run("sed -i 's#/dev/rplidar#/dev/ttyUSB0#' /etc/cornerd/cornerd.json")
    guest.run("systemctl restart cornerd", 20 * PATIENCE)
    report.step("the service without a lidar", lambda: board.property("StatusText"))
    lidar.plug()
    report.step("first pose after the lidar is plugged in", board.wait_for_pose)
    print(guest.run("ls -l /dev/ttyUSB0; cat /sys/class/tty/ttyUSB0/device/driver/module/version "
                    "2>/dev/null; readlink /sys/class/tty/ttyUSB0/device/driver"))
    report.step("poses go on", lambda: board.count_poses(10))
    print(guest.run("systemctl status --no-pager --lines=5 cornerd; true"))
    report.step("memory", board.memory)

    lidar.unplug()
    report.step("unplugged: the daemon says so", board.wait_for_no_lidar)
    lidar.plug()
    report.step("pose after it is plugged in again", board.wait_for_pose)

    guest.run(f"kill -9 {board.property('MainPID')}")
    report.step("kill -9: restarted", lambda: board.wait_for_restart(1))
    report.step("pose after that", board.wait_for_pose)
    guest.run(f"kill -STOP {board.property('MainPID')}")
    report.step("hang: restarted by the watchdog", lambda: board.wait_for_restart(2))
    report.step("pose after that", board.wait_for_pose)

    report.step("real-time rights: priority, locked memory", board.lock_memory)
    report.step("memory, locked", board.memory)
    print(guest.run("journalctl --no-pager -o short-monotonic -u cornerd | tail -n 40"))

    report.step("reboot: systemd, a shell", board.reboot)
    report.step("pose without a hand's touch", board.wait_for_pose)
    report.step("purge the package", board.purge)


def main():
    parser = argparse.ArgumentParser()
    for name in ("image", "package", "cornerctl", "work"):
        parser.add_argument(f"--{name}", required=True, type=pathlib.Path)
    options = parser.parse_args()
    options.work.mkdir(parents=True, exist_ok=True)
    for stale in options.work.glob("*.sock"):
        stale.unlink()

    # A disk that is a tar archive: no file system to make.
    files = options.work / "files.tar"
    tree = pathlib.Path(__file__).resolve().parents[2]
    subprocess.run(["tar", "-cf", files, "--transform", "s#.*\\.deb$#cornerd.deb#",
                    "-C", options.package.resolve().parent, options.package.name,
                    "-C", tree / "systemd", "realtime.conf"], check=True)

    print("  since the start, of the step", flush=True)
    guest = Guest(options.image, options.work, files)
    lidar = Lidar(options.cornerctl, guest,
                  ["--map", str(tree / "config/maps/krpai-2019-a.json"),
                   "--pose", f"{TRUTH['x']},{TRUTH['y']},{TRUTH['theta']}"])
    try:
        run_steps(Report(), Board(guest), lidar, guest)
    except Failed as failure:
        print(f"FAILED: {failure}")
        try:
            print(guest.run("systemctl status --no-pager --lines=30 cornerd; true", 20))
        except (Failed, OSError):
            print(f"and no word from the guest; its console: {guest.console}")
        return 1
    finally:
        lidar.end()
        guest.end()
    print("all steps passed")
    return 0


if __name__ == "__main__":
    sys.exit(main())
