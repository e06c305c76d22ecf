#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs every command of cornerd and cornerctl that README.md shows.

    readme_commands.py BIN

A command on files runs on recordings that are simulated here under the names that README.md uses. Of one that
needs a daemon, a device or a terminal, --help runs: it names the command and its options.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
NEEDS_MORE = {"monitor", "watch", "status", "doctor", "set-pose", "relocalize", "record"}
WORDS = {"FILE": "drive.ndjson", "MAP": "flat.json", "X,Y,THETA": "1.65,2.6,0"}


def commands():
    """All that stand in backquotes or in an indented block."""
    with open(os.path.join(SOURCE, "README.md"), encoding="utf-8") as file:
        text = file.read()
    spans = re.findall(r"`([^`\n]+)`", text) + re.findall(r"^    (?:\$ )?(.+)$", text, re.M)
    # The next words after a command in the same span, or in the same row of the table, are commands too.
    rows = re.findall(r"^\| (`corner[^|]*(?:\\\|[^|]*)*)\|", text, re.M)
    for row in rows:
        tool = "cornerctl"
        for span in re.findall(r"`([^`]+)`", row):
            span = span if span.startswith("corner") else tool + " " + span
            if not re.match(r"(cornerd|cornerctl)( |$)", span):
                continue
            choices = re.search(r"(\S+(?:\\\|\S+)+)", span)
            for word in choices.group(1).split("\\|") if choices else [""]:
                yield span.replace(choices.group(1), word) if choices else span
    for span in spans:
        span = re.sub(r"\s+(#|<|\().*$", "", span)
        span = re.sub(r"^(map|survey|calibrate) (?=.* -o )", r"cornerctl \1 ", span)
        if re.match(r"(cornerd|cornerctl) ", span) and "\\|" not in span:
            yield span


def runnable(words):
    """The words of the command on the files of this test, or its --help."""
    words = [WORDS.get(word.strip("[]"), word.strip("[]")) for word in words]
    if words[0] == "cornerd":
        return ["cornerd", "--config", "cornerd.json", "--check"]
    is_bare = len(words) < 3 or words[1] in NEEDS_MORE or (words[1] in ("map", "calibrate") and len(words) < 4)
    return words + ["--help"] if is_bare else words


def prepare(tools):
    flat = os.path.join(SOURCE, "config", "maps", "flat-7.json")
    with open(flat, encoding="utf-8") as file, open("flat.json", "w", encoding="utf-8") as out:
        text = file.read()
        out.write(text)
    with open("plan.json", "w", encoding="utf-8") as out:
        out.write(text)
    shutil.copy(os.path.join(SOURCE, "tests", "unit", "plan", "samples", "flat.svg"), "plan.svg")
    with open("cornerd.json", "w", encoding="utf-8") as out:
        out.write('{ "map": "flat.json" }')
    simulate = [os.path.join(tools, "cornerctl"), "simulate", "--map", "flat.json"]
    subprocess.run(simulate + ["--pose", "1.65,2.6,0", "--scans", "60", "-o", "still.bin"], check=True)
    subprocess.run(simulate + ["--scenario", "circuit-1", "--odometry", "--scans", "120", "-o",
                               "drive.ndjson"], check=True)
    subprocess.run([os.path.join(tools, "cornerctl"), "map", "export", "flat.json", "-o", "map.yaml"],
                   check=True)


def main():
    tools = os.path.abspath(sys.argv[1])
    failed = 0
    seen = []
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        prepare(tools)
        for command in commands():
            if command in seen:
                continue
            seen.append(command)
            words = runnable(command.split())
            result = subprocess.run([os.path.join(tools, words[0])] + words[1:], stdin=subprocess.DEVNULL,
                                    stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, check=False)
            print("%s: %s: exit code %d" % (command, " ".join(words), result.returncode))
            if result.returncode != 0:
                print(result.stderr.decode())
                failed += 1
        os.chdir("/")
    print("%d commands, %d failed" % (len(seen), failed))
    return 1 if failed or len(seen) < 10 else 0


if __name__ == "__main__":
    sys.exit(main())
