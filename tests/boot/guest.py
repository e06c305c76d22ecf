# SPDX-License-Identifier: MIT
"""An emulated board: its machine, a shell in it, and an A1 that can be plugged in."""
import os
import pathlib
import select
import socket
import subprocess
import threading
import time
import tty


def connect(path, seconds=20):
    """Whoever listens at path may take a while to."""
    until = time.monotonic() + seconds
    while True:
        link = socket.socket(socket.AF_UNIX)
        try:
            link.connect(str(path))
            return link
        except OSError:
            link.close()
            if time.monotonic() > until:
                raise
            time.sleep(0.05)


class Failed(Exception):
    """A step that did not come out as it should."""


class Guest:
    """QEMU's `virt` board with a Cortex-A15, the nearest that both Debian's kernel and QEMU know."""

    def __init__(self, image, work, disk_of_files):
        self.work = pathlib.Path(work)
        self.console = self.work / "console.log"
        self.process = subprocess.Popen(
            ["qemu-system-arm", "-M", "virt,highmem=off", "-cpu", "cortex-a15",
             "-m", "512", "-kernel", f"{image}/vmlinuz", "-initrd", f"{image}/initrd",
             "-append", "console=ttyAMA0 rw panic=-1 quiet "
             "systemd.journald.forward_to_console=1",
             "-drive", f"file={image}/disk.ext4,if=none,id=disk,format=raw,snapshot=on",
             "-device", "virtio-blk-device,drive=disk",
             "-drive", f"file={disk_of_files},if=none,id=files,format=raw,readonly=on",
             "-device", "virtio-blk-device,drive=files,serial=files",
             "-device", "virtio-serial-device",
             "-chardev", f"socket,id=shell,path={self.work}/shell.sock,server=on,wait=off",
             "-device", "virtserialport,chardev=shell,name=shell",
             "-device", "qemu-xhci",
             "-chardev", f"socket,id=lidar,path={self.work}/lidar.sock,server=on,wait=off",
             "-device", "usb-serial,chardev=lidar",
             "-nodefaults", "-nographic", "-monitor", "none", "-serial", f"file:{self.console}"],
            stdout=open(self.work / "qemu.log", "w"), stderr=subprocess.STDOUT)
        self.shell = connect(self.work / "shell.sock")
        self.received = b""

    def end(self):
        self.process.terminate()
        self.process.wait(10)

    def wait_for_shell(self, seconds):
        """The port drops what is sent before somebody inside has opened it."""
        until = time.monotonic() + seconds
        while True:
            try:
                return self.run("true", 2)
            except Failed:
                if time.monotonic() > until or self.process.poll() is not None:
                    raise Failed(f"no shell within {seconds} s; see {self.console}") from None

    def run(self, command, seconds=300, check=True):
        """What a command says, in the guest."""
        mark = f"@@{time.monotonic_ns()}"
        self.shell.sendall(f"{{ {command}\n}} 2>&1 </dev/null; echo {mark} $?\n".encode())
        until = time.monotonic() + seconds
        while True:
            text, found, rest = self.received.partition(f"{mark} ".encode())
            if found and b"\n" in rest:
                break
            left = until - time.monotonic()
            if left <= 0 or not select.select([self.shell], [], [], left)[0]:
                raise Failed(f"{command}: no end within {seconds} s")
            self.received += self.shell.recv(65536)
        status, _, self.received = rest.partition(b"\n")
        said = text.decode(errors="replace").strip()
        if check and int(status) != 0:
            raise Failed(f"{command}: exit code {int(status)}\n{said}")
        return said


class Lidar:
    """The project's emulated A1 on a port of its own, and the cable from there to the guest."""

    def __init__(self, cornerctl, guest, arguments):
        self.guest = guest
        self.port = guest.work / "lidar"
        self.process = subprocess.Popen([cornerctl, "emulate", "--link", str(self.port)] + arguments,
                                        stdout=subprocess.DEVNULL)
        self.cable = None
        self.carrier = None

    def plug(self):
        """QEMU's adapter is plugged in while somebody holds its socket."""
        until = time.monotonic() + 10
        while not self.port.exists() and time.monotonic() < until:
            time.sleep(0.05)
        terminal = os.open(self.port, os.O_RDWR | os.O_NOCTTY)
        tty.setraw(terminal)
        self.cable = connect(self.guest.work / "lidar.sock")
        self.carrier = threading.Thread(target=self.carry, args=(self.cable, terminal), daemon=True)
        self.carrier.start()

    @staticmethod
    def carry(cable, terminal):
        ends = {terminal: cable.sendall, cable: lambda data: os.write(terminal, data)}
        try:
            while True:
                for end in select.select(list(ends), [], [])[0]:
                    data = os.read(terminal, 4096) if end is terminal else cable.recv(4096)
                    if not data:
                        return
                    ends[end](data)
        except OSError:
            pass
        finally:
            os.close(terminal)

    def unplug(self):
        self.cable.shutdown(socket.SHUT_RDWR)
        self.carrier.join()
        self.cable.close()

    def end(self):
        self.process.terminate()
        self.process.wait(5)
